//! A point on a surface as shading sees it, and how rays leave it.

use crate::{Frame, Hit, LightSample, Material, PrimId, Primitive, Ray, Spectrum, Vec3};

/// Where a ray hit, with all that shading asks for. World space unless it says otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface<'a> {
    /// The point.
    pub p: Vec3,
    /// The shading normal and two tangents: the space in which scattering is written.
    pub frame: Frame,
    /// Geometric normal: unit, on the side of the vertex normals (of a sphere: outwards).
    pub ng: Vec3,
    /// No coordinate of `p` is farther than this from the true surface.
    pub error: Vec3,
    /// What the surface is made of.
    pub material: &'a Material,
    /// The primitive it is part of.
    pub prim: PrimId,
}

/// How far the coordinates of a hit point may be off, in units of the largest coordinate of its primitive.
///
/// A barycentric combination `b0·p0 + b1·p1 + b2·p2` rounds 7 times, and a point put back on a sphere about as
/// often, so `7·2⁻⁵³` would do (Higham's γ₇; PBRT 4th ed., section 6.8). Nine times as much leaves room for
/// the rounding of [`Surface::leave`] itself and for kernels that are less careful than the reference.
pub const POSITION_ERROR: f64 = 64.0 * (0.5 * f64::EPSILON);

/// A shadow ray ends this share of its length before the light, so that the light does not block itself.
///
/// Well above the rounding error of any `t` (about 1e-15) and well below any gap that a scene has: ten units
/// away it is one billionth of a unit.
pub const SHADOW_GAP: f64 = 1e-10;

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

    /// The radiance that the surface itself sends along the world direction `wo`: its emission on the front
    /// side (the side of `ng`), black behind and edge-on.
    #[inline]
    pub fn emitted(&self, wo: Vec3) -> Spectrum {
        match self.material {
            Material::Emission { radiance } if wo.dot(self.ng) > 0.0 => *radiance,
            _ => Spectrum::BLACK,
        }
    }

    /// The ray that leaves along the unit world direction `w`.
    ///
    /// Its origin is moved off the surface, to the side that `w` points to, just far enough that it is on that
    /// side for sure whatever the rounding of `p` (Wächter and Binder, "A fast and robust method for avoiding
    /// self-intersection", Ray Tracing Gems, 2019, chapter 6; here with PBRT's error bound). No scene is too small
    /// or too large for it, as it is for a fixed epsilon.
    #[inline]
    pub fn leave(&self, w: Vec3) -> Ray {
        let distance = self.error.dot(self.ng.abs());
        let offset = if w.dot(self.ng) < 0.0 {
            -distance * self.ng
        } else {
            distance * self.ng
        };
        // The sum rounds, too, by a 64th of the offset at most: see POSITION_ERROR.
        Ray::new(self.p + offset, w)
    }

    /// The ray from here to the sampled point of a light. Something lies between if anything is in its range;
    /// the light itself is not.
    #[inline]
    pub fn shadow_ray(&self, light: &LightSample) -> Ray {
        Ray {
            max_t: light.distance * (1.0 - SHADOW_GAP),
            ..self.leave(light.wi)
        }
    }
}
