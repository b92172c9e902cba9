// BEGIN SOLUTION(part1.task3)
//! The textbook's test: Cramer's rule, with two cross products.
//!
//! T. Möller, B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of Graphics Tools 2(1), 1997.

use super::{Meeting, TriangleTest};
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Ray, Triangle};

const PAPER: &str = "Möller, Trumbore 1997";

/// As most write it today: only a determinant of 0 is turned away.
pub(super) struct MollerTrumbore;

impl TriangleTest for MollerTrumbore {
    const ABOUT: About = About {
        name: "Möller-Trumbore",
        paper: PAPER,
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Meeting<R>> {
        solve(tri, ray, |det| det == R::of(0.0))
    }
}

/// With the paper's epsilon: whatever is this close to parallel, or this small, is missed. It is an absolute number, in
/// units of volume.
pub(super) struct UsualEpsilon;

/// The paper's.
const EPSILON: f64 = 1e-6;

impl TriangleTest for UsualEpsilon {
    const ABOUT: About = About {
        name: "Möller-Trumbore ε",
        paper: PAPER,
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Meeting<R>> {
        solve(tri, ray, |det| det.abs() < R::of(EPSILON))
    }
}

/// The paper's solution for `det != 0` of either sign: edges and vertices count.
#[inline(always)]
fn solve<R: Real>(
    tri: &Triangle<R>,
    ray: &Ray<R>,
    is_parallel: impl Fn(R) -> bool,
) -> Option<Meeting<R>> {
    let (zero, one) = (R::of(0.0), R::of(1.0));
    let (edge1, edge2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
    let pvec = ray.d.cross(edge2);
    let det = edge1.dot(pvec);
    if is_parallel(det) {
        return None;
    }
    let inv_det = one / det;
    let tvec = ray.o - tri.p0;
    let u = tvec.dot(pvec) * inv_det;
    if u < zero || u > one {
        return None;
    }
    let qvec = tvec.cross(edge1);
    let v = ray.d.dot(qvec) * inv_det;
    if v < zero || u + v > one {
        return None;
    }
    let t = edge2.dot(qvec) * inv_det;
    ray.in_range(t).then_some(Meeting { t, b1: u, b2: v })
}

/// The paper's other branch: triangles seen from behind are missed, and nothing is divided before the hit is certain.
pub(super) struct Culling;

impl TriangleTest for Culling {
    const ABOUT: About = About {
        name: "Möller-Trumbore cull",
        paper: PAPER,
        culls: true,
    };

    #[inline(always)]
    fn meet<R: Real>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Meeting<R>> {
        let zero = R::of(0.0);
        let (edge1, edge2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
        let pvec = ray.d.cross(edge2);
        let det = edge1.dot(pvec);
        if det < R::of(EPSILON) {
            return None;
        }
        let tvec = ray.o - tri.p0;
        let u = tvec.dot(pvec);
        if u < zero || u > det {
            return None;
        }
        let qvec = tvec.cross(edge1);
        let v = ray.d.dot(qvec);
        if v < zero || u + v > det {
            return None;
        }
        let inv_det = R::of(1.0) / det;
        let t = edge2.dot(qvec) * inv_det;
        ray.in_range(t).then_some(Meeting {
            t,
            b1: u * inv_det,
            b2: v * inv_det,
        })
    }
}
// END SOLUTION(part1.task3)
