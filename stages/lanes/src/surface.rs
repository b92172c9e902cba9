//! The step off a surface at which a ray starts, as [`kit::Surface`] takes it.

use crate::real::{Mask, Real};
use crate::shapes::Sphere;
use crate::vec3::Vec3;
use kit::surface::{LEAST_STEP, POSITION_ERROR, SHADOW_GAP, SHADOW_ROUNDINGS};

/// A point on a surface that rays leave.
///
/// ```
/// use lanes::{Sphere, Vec3, surface::Departure};
/// let up = Vec3 { x: 0.0, y: 0.0, z: 1.0 };
/// let ball = Sphere { center: up * 0.0, radius: 1.0_f64 };
/// let departure = Departure::from_sphere(up, up, &ball);
/// assert!(departure.origin(up).z > 1.0 && departure.origin(-up).z < 1.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Departure<R> {
    /// The point.
    pub p: Vec3<R>,
    /// Geometric normal: unit, on the side of the vertex normals (outwards for a sphere).
    pub ng: Vec3<R>,
    /// How far along `ng` the origins of rays are moved off the surface.
    pub distance: R,
}

impl<R: Real> Departure<R> {
    /// The point `p` of a triangle with this geometric normal and these vertices and vertex
    /// normals.
    #[inline(always)]
    pub fn from_triangle(
        p: Vec3<R>,
        normal: Vec3<R>,
        vertices: [Vec3<R>; 3],
        n: [Vec3<R>; 3],
    ) -> Departure<R> {
        let side = normal.dot(n[0] + n[1] + n[2]);
        let behind = side.less(side.constant(0.0));
        let [p0, p1, p2] = vertices;
        let largest = p0.abs().larger(p1.abs()).larger(p2.abs());
        Departure::new(p, (-normal).masked_or(behind, normal), largest)
    }

    /// The point `p` of a sphere with the outward normal `n`.
    #[inline(always)]
    pub fn from_sphere(p: Vec3<R>, n: Vec3<R>, sphere: &Sphere<R>) -> Departure<R> {
        let radius = Vec3 {
            x: sphere.radius,
            y: sphere.radius,
            z: sphere.radius,
        };
        Departure::new(p, n, sphere.center.abs() + radius)
    }

    /// `largest` is the largest size of each coordinate on the primitive.
    #[inline(always)]
    fn new(p: Vec3<R>, ng: Vec3<R>, largest: Vec3<R>) -> Departure<R> {
        let error = largest * p.x.constant(POSITION_ERROR);
        let least = error.x.max(error.y).max(error.z) * p.x.constant(LEAST_STEP);
        Departure {
            p,
            ng,
            distance: error.dot(ng.abs()).max(least),
        }
    }

    /// The origin of a ray that leaves along `w`, as [`kit::Surface::leave`] moves it.
    #[inline(always)]
    pub fn origin(&self, w: Vec3<R>) -> Vec3<R> {
        let behind = w.dot(self.ng).less(self.distance.constant(0.0));
        let distance = behind.choose(-self.distance, self.distance);
        self.p + self.ng * distance
    }

    /// The end of the range of a shadow ray to a light at `distance`, as
    /// [`kit::Surface::shadow_ray`].
    #[inline(always)]
    pub fn shadow_end(&self, distance: R) -> R {
        let number = |x: f64| distance.constant(x);
        let p = self.p.abs();
        let error = number(POSITION_ERROR) * p.x.max(p.y).max(p.z) + self.distance;
        (distance * number(SHADOW_GAP)).less(error).choose(
            (distance - number(SHADOW_ROUNDINGS) * error).max(number(0.0)),
            distance * number(1.0 - SHADOW_GAP),
        )
    }

    /// `self` in the lanes of `mask`, `other` elsewhere.
    #[inline(always)]
    pub fn masked_or(self, mask: R::Mask, other: Departure<R>) -> Departure<R> {
        Departure {
            p: self.p.masked_or(mask, other.p),
            ng: self.ng.masked_or(mask, other.ng),
            distance: mask.choose(self.distance, other.distance),
        }
    }
}
