// BEGIN SOLUTION(part6.task1)
//! The triangle test in double precision, for the few triangles that pass the filter.

use kit::{Ray, TriangleHit, Vec3};

/// The vertices of a triangle in world space.
pub(crate) type Vertices = [[f64; 3]; 3];

/// What [`test`] found.
pub(crate) enum Decision {
    Miss,
    Hit(TriangleHit),
    /// Rounding errors may be too large: the scalar kernel has to decide.
    Undecided,
}

/// A determinant below this share of its terms has lost too many digits by cancellation.
const CANCELLATION: f64 = 1.0 / 1024.0;

/// Below this, a factor of a product may have underflowed.
const SMALLEST: f64 = 1e-290;

/// Tests a triangle for a hit in the range of `ray`, where `axes` become x, y and z; `z` is the
/// axis of the largest component of the direction.
///
/// Repeats the arithmetic of `intersect::test_triangle` operation by operation (Woop, Benthin, Wald,
/// "Watertight Ray/Triangle Intersection", JCGT 2013); where that switches to its careful variant,
/// the triangle is undecided.
#[inline(always)]
pub(crate) fn test(vertices: &Vertices, ray: &Ray, axes: [usize; 3]) -> Decision {
    let permuted = |v: [f64; 3]| Vec3::new(v[axes[0]], v[axes[1]], v[axes[2]]);
    let (o, d) = (permuted(ray.o.to_array()), permuted(ray.d.to_array()));
    let a = permuted(vertices[0]) - o;
    let b = permuted(vertices[1]) - o;
    let c = permuted(vertices[2]) - o;
    let (a_x, a_y) = (a.x * d.z - d.x * a.z, a.y * d.z - d.y * a.z);
    let (b_x, b_y) = (b.x * d.z - d.x * b.z, b.y * d.z - d.y * b.z);
    let (c_x, c_y) = (c.x * d.z - d.x * c.z, c.y * d.z - d.y * c.z);
    let (cb, ac, ba) = (c_x * b_y, a_x * c_y, b_x * a_y);
    let (u, v, w) = (cb - c_y * b_x, ac - a_y * c_x, ba - b_y * a_x);
    // Positive if the signs agree and the product does not underflow.
    let agreement = u.min(v).min(w) * u.max(v).max(w);
    let det = u + v + w;
    let numerator = u * a.z + v * b.z + w * c.z;
    let denominator = det * d.z;
    let is_sound = (agreement > 0.0)
        & (det.abs() > CANCELLATION * (cb.abs() + ac.abs() + ba.abs()))
        & is_ordinary(numerator)
        & is_ordinary(denominator);
    if !is_sound {
        return Decision::Undecided;
    }
    let t = numerator / denominator;
    if !ray.in_range(t) {
        return Decision::Miss;
    }
    Decision::Hit(TriangleHit {
        t,
        b1: v / det,
        b2: w / det,
    })
}

/// Whether a product of several factors has neither underflowed nor overflowed.
#[inline(always)]
fn is_ordinary(x: f64) -> bool {
    let size = x.abs();
    SMALLEST < size && size < f64::INFINITY
}
// END SOLUTION(part6.task1)
