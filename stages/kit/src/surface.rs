//! The shading point: the surface data at a hit, and the rays that start there.

use crate::{Frame, Hit, LightSample, Material, PrimId, Primitive, Ray, Spectrum, Vec3};

/// The surface at a hit, with the data that shading needs. In world space unless stated otherwise.
///
/// ```
/// use kit::{Hit, Material, PrimId, Primitive, Spectrum, Sphere, Surface, Vec2, Vec3};
/// let sphere = Sphere { center: Vec3::ZERO, radius: 1.0 };
/// let top = Vec3::Y;
/// let hit = Hit { t: 1.0, p: top, n: top, ng: top, uv: Vec2::ZERO, prim: PrimId(0) };
/// let lamp = Material::Emission { radiance: Spectrum::WHITE };
/// let surface = Surface::new(&hit, Primitive::Sphere(&sphere), &lamp);
/// assert_eq!(surface.emitted(Vec3::Y), Spectrum::WHITE);
/// assert!(surface.emitted(-Vec3::Y).is_black());
/// assert!(surface.leave(Vec3::Y).o.y > 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface<'a> {
    /// The hit point.
    pub p: Vec3,
    /// The frame of the shading normal: the local space in which BSDFs are evaluated.
    pub frame: Frame,
    /// Geometric normal: unit, on the side of the vertex normals (outwards for a sphere).
    pub ng: Vec3,
    /// Bound on the rounding error of each coordinate of `p`.
    pub error: Vec3,
    /// The material of the surface.
    pub material: &'a Material,
    /// The primitive that the surface belongs to.
    pub prim: PrimId,
}

/// Bound on the error of the coordinates of a hit point, relative to the largest coordinate of its
/// primitive.
///
/// A barycentric combination `b0·p0 + b1·p1 + b2·p2` has 7 roundings, and a point projected onto a
/// sphere about as many, so `7·2⁻⁵³` would suffice (Higham's γ₇; PBRT 4th ed., section 6.8). Nine
/// times as much also covers the rounding of [`Surface::leave`] and kernels that are less accurate
/// than the reference.
pub const POSITION_ERROR: f64 = 64.0 * (0.5 * f64::EPSILON);

/// Rays start at least this part of the largest coordinate's error away from a surface: sixteen
/// roundings of it, a few times what the distance to a triangle is off.
pub const LEAST_STEP: f64 = 0.25;

/// Relative length by which a shadow ray is shortened, so that the light does not block itself.
///
/// It is well above the rounding error of any `t` (about 1e-15) and well below any gap in a scene:
/// one billionth of a unit at a distance of ten units. Where it is less than the error of the ray's
/// origin, which is known to so many digits only, [`SHADOW_ROUNDINGS`] gives a longer gap.
pub const SHADOW_GAP: f64 = 1e-10;

/// The longer gap of a shadow ray is this many times the error of its origin. The ray meets a
/// light at a grazing angle later or earlier by the error divided by the cosine of the angle to the
/// normal: so many times, the cosine is so small that little light arrives.
pub const SHADOW_ROUNDINGS: f64 = 64.0;

impl<'a> Surface<'a> {
    /// The surface at `hit`, on `primitive`, made of `material`.
    #[inline]
    pub fn new(hit: &Hit, primitive: Primitive<'_>, material: &'a Material) -> Surface<'a> {
        let (largest, side) = match primitive {
            Primitive::Triangle(t) => (
                t.p0.abs().max(t.p1.abs()).max(t.p2.abs()),
                t.n0 + t.n1 + t.n2,
            ),
            Primitive::Sphere(s) => (s.center.abs() + s.radius, hit.n),
        };
        Surface {
            p: hit.p,
            frame: Frame::around(hit.n),
            ng: if hit.ng.dot(side) < 0.0 {
                -hit.ng
            } else {
                hit.ng
            },
            error: POSITION_ERROR * largest,
            material,
            prim: hit.prim,
        }
    }

    /// The radiance that the surface emits along the world direction `wo`: the emission of its
    /// material on the front side (the side of `ng`), black behind it and in its plane.
    #[inline]
    pub fn emitted(&self, wo: Vec3) -> Spectrum {
        match self.material {
            Material::Emission { radiance } if wo.dot(self.ng) > 0.0 => *radiance,
            _ => Spectrum::BLACK,
        }
    }

    /// A ray that leaves the surface along the unit world direction `w`.
    ///
    /// Its origin is moved off the surface, to the side that `w` points to, just far enough to be
    /// on that side whatever the rounding error of `p` (Wächter and Binder, "A fast and robust
    /// method for avoiding self-intersection", Ray Tracing Gems, 2019, chapter 6; here with PBRT's
    /// error bound). Unlike a fixed epsilon this works for scenes of any size.
    #[inline]
    pub fn leave(&self, w: Vec3) -> Ray {
        let distance = self.step();
        let offset = if w.dot(self.ng) < 0.0 {
            -distance * self.ng
        } else {
            distance * self.ng
        };
        // The rounding error of the sum is at most 1/64 of the offset: see POSITION_ERROR.
        Ray::new(self.p + offset, w)
    }

    /// How far rays start from the surface: at least a part of the largest error. In a plane such
    /// as `y = 0` the point has no error, but a test of another triangle in this plane has.
    #[inline]
    fn step(&self) -> f64 {
        let least = LEAST_STEP * self.error.max_element();
        self.error.dot(self.ng.abs()).max(least)
    }

    /// The ray from this point to a sampled point of a light. Its range ends just before the light,
    /// so any hit in the range means that the light is blocked.
    #[inline]
    pub fn shadow_ray(&self, light: &LightSample) -> Ray {
        let distance = light.distance;
        let error = POSITION_ERROR * self.p.abs().max_element() + self.step();
        Ray {
            max_t: if distance * SHADOW_GAP < error {
                (distance - SHADOW_ROUNDINGS * error).max(0.0)
            } else {
                distance * (1.0 - SHADOW_GAP)
            },
            ..self.leave(light.wi)
        }
    }
}
