//! Results of intersection tests.

use crate::{Vec2, Vec3};

/// Index of a primitive in its scene: triangles first, then spheres.
///
/// ```
/// let first_sphere = kit::PrimId(12); // of a scene with 12 triangles
/// assert!(kit::PrimId(11) < first_sphere);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PrimId(pub u32);

/// A ray/triangle hit without shading data: the distance along the ray and the barycentric weights.
///
/// ```
/// use kit::{TriangleHit, Vec3};
/// let [p0, p1, p2] = [Vec3::ZERO, 4.0 * Vec3::X, 4.0 * Vec3::Y];
/// let hit = TriangleHit { t: 2.0, b1: 0.25, b2: 0.5 };
/// let p = (1.0 - hit.b1 - hit.b2) * p0 + hit.b1 * p1 + hit.b2 * p2;
/// assert_eq!(p, Vec3::new(1.0, 2.0, 0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Distance along the ray, in multiples of the length of `ray.d`.
    pub t: f64,
    /// Barycentric weight of vertex `p1`, in [0, 1].
    pub b1: f64,
    /// Barycentric weight of vertex `p2`, in [0, 1]. The weight of `p0` is `1 - b1 - b2`.
    pub b2: f64,
}

/// A hit with the data that shading needs, in world space.
///
/// ```
/// use kit::{Hit, PrimId, Ray, Vec2, Vec3};
/// // A ball of radius 1 around the origin, from above.
/// let ray = Ray::new(3.0 * Vec3::Z, -Vec3::Z);
/// let (t, p) = (2.0, Vec3::Z);
/// let hit = Hit { t, p, n: p, ng: p, uv: Vec2::ZERO, prim: PrimId(0) };
/// assert_eq!(ray.at(hit.t), hit.p);
/// assert!(hit.ng.dot(ray.d) < 0.0, "it is hit from outside");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, in multiples of the length of `ray.d`.
    pub t: f64,
    /// Hit point, on the surface.
    pub p: Vec3,
    /// Shading normal: unit, interpolated from the vertices, never flipped towards the ray.
    pub n: Vec3,
    /// Geometric normal: unit, never flipped. For a triangle it points along `(p1-p0) x (p2-p0)`.
    pub ng: Vec3,
    /// Surface parameters. For a triangle `(b1, b2)`, the weights of `p1` and `p2`; for a sphere
    /// (0, 0).
    pub uv: Vec2,
    /// The primitive that was hit.
    pub prim: PrimId,
}

/// A closed interval of `t` along a ray, `min <= max`.
///
/// ```
/// let inside = kit::Interval { min: 1.0, max: 1.0 };
/// assert!((inside.min..=inside.max).contains(&1.0), "both ends count");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Start of the interval.
    pub min: f64,
    /// End of the interval.
    pub max: f64,
}
