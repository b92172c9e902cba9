//! What an intersection test answers.

use crate::{Vec2, Vec3};

/// Number of a primitive in its scene: triangles first, then spheres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PrimId(pub u32);

/// A ray/triangle hit before any shading: where on the ray, where on the triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Distance along the ray in lengths of `ray.d`.
    pub t: f64,
    /// Barycentric weight of vertex `p1`, in [0, 1].
    pub b1: f64,
    /// Barycentric weight of vertex `p2`, in [0, 1]. `p0` has the rest, `1 - b1 - b2`.
    pub b2: f64,
}

/// A hit with all that shading asks for, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray in lengths of `ray.d`.
    pub t: f64,
    /// Hit point, on the surface.
    pub p: Vec3,
    /// Shading normal: unit, interpolated from the vertices, never flipped towards the ray.
    pub n: Vec3,
    /// Geometric normal: unit, never flipped. Of a triangle along `(p1-p0) x (p2-p0)`.
    pub ng: Vec3,
    /// Surface parameters. Of a triangle `(b1, b2)`, the weights of `p1` and `p2`; of a sphere (0, 0).
    pub uv: Vec2,
    /// Which primitive was hit.
    pub prim: PrimId,
}

/// A closed interval of `t` along a ray, `min <= max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Where it starts.
    pub min: f64,
    /// Where it ends.
    pub max: f64,
}
