//! The primitives: triangles and spheres.

use crate::{Aabb, Vec3};

/// A triangle in world space with a normal at each vertex.
///
/// The assignment calls the vertices `p1 p2 p3` and their normals `n1 n2 n3`. Here they count from
/// 0, like the barycentric weights.
///
/// ```
/// use kit::{Triangle, Vec3};
/// let triangle = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
/// assert_eq!(triangle.n0, Vec3::Z);
/// assert_eq!(triangle.bounds().max, Vec3::new(1.0, 1.0, 0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// First vertex, with barycentric weight `1 - b1 - b2`.
    pub p0: Vec3,
    /// Second vertex, with barycentric weight `b1`.
    pub p1: Vec3,
    /// Third vertex, with barycentric weight `b2`.
    pub p2: Vec3,
    /// Unit normal at `p0`.
    pub n0: Vec3,
    /// Unit normal at `p1`.
    pub n1: Vec3,
    /// Unit normal at `p2`.
    pub n2: Vec3,
}

impl Triangle {
    /// The flat triangle `p0 p1 p2`: all vertex normals are its geometric normal (zero if it has no
    /// area).
    pub fn flat(p0: Vec3, p1: Vec3, p2: Vec3) -> Triangle {
        let n = (p1 - p0).cross(p2 - p0).normalize_or_zero();
        Triangle::smooth([p0, p1, p2], [n; 3])
    }

    /// The triangle with these vertices, and at each the unit normal of the same number.
    pub fn smooth([p0, p1, p2]: [Vec3; 3], [n0, n1, n2]: [Vec3; 3]) -> Triangle {
        Triangle {
            p0,
            p1,
            p2,
            n0,
            n1,
            n2,
        }
    }

    /// The bounding box; empty if a coordinate is NaN.
    pub fn bounds(&self) -> Aabb {
        if self.p0.is_nan() || self.p1.is_nan() || self.p2.is_nan() {
            return Aabb::EMPTY;
        }
        Aabb::of([self.p0, self.p1, self.p2])
    }
}

/// A sphere in world space.
///
/// ```
/// use kit::{Sphere, Vec3};
/// let sphere = Sphere {
///     center: Vec3::ZERO,
///     radius: 2.0,
/// };
/// assert_eq!(sphere.bounds().min, Vec3::splat(-2.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub center: Vec3,
    /// Radius, `>= 0`. A scene file with a negative radius is an error.
    pub radius: f64,
}

impl Sphere {
    /// The bounding box; empty if a number is NaN or the radius is negative.
    pub fn bounds(&self) -> Aabb {
        Aabb {
            min: self.center - self.radius,
            max: self.center + self.radius,
        }
    }
}
