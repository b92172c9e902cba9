//! Results of intersection tests.

use crate::{Vec2, Vec3};

/// Index of a primitive in its scene: triangles first, then spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PrimId(pub u32);

/// A ray/triangle hit without shading data: the distance along the ray and the barycentric weights.
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Start of the interval.
    pub min: f64,
    /// End of the interval.
    pub max: f64,
}
