//! What is known to be right, in the form in which answers are judged.

use kit::{Vec2, Vec3};

/// What a ray and a shape have to do with each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// Hit, miss, or too close to call in `f64`.
    pub decision: Decision,
    /// The hit, unless it is a plain miss.
    pub hit: Option<ExpectedHit>,
}

/// The verdict on hit or miss.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Decision {
    /// Only a hit is right.
    Hit,
    /// Only a miss is right.
    Miss,
    /// Rounding errors of sound `f64` code decide: either is right.
    Either,
}

/// A hit and how far an answer may be from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpectedHit {
    /// Distance along the ray, rounded to the nearest float.
    pub t: f64,
    /// How far `t` may be off.
    pub t_bound: f64,
    /// Hit point.
    pub p: Vec3,
    /// How far the hit point may be off, in world units.
    pub p_bound: f64,
    /// Barycentric weights of `p1` and `p2`, and how far they may be off; for triangles.
    pub uv: Option<(Vec2, f64)>,
    /// Unit shading normal; `None` where any unit vector is right (the vertex normals cancel).
    pub n: Option<Vec3>,
    /// Unit geometric normal.
    pub ng: Vec3,
    /// How far a component of a normal may be off.
    pub n_bound: f64,
}
