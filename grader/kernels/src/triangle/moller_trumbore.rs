//! The textbook test: Cramer's rule, with two cross products.
//!
//! T. Möller, B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", Journal of Graphics
//! Tools 2(1), 1997.

use super::test::{TriangleHit, TriangleTest};
use crate::kernel::KernelInfo;
use crate::shapes::{Ray, Triangle};
use lanes::Scalar;

const PAPER: &str = "Möller, Trumbore 1997";

/// The common form today: only a determinant of 0 is rejected.
pub(crate) struct MollerTrumbore;

impl TriangleTest for MollerTrumbore {
    const INFO: KernelInfo = KernelInfo::new("Möller-Trumbore", PAPER);

    #[inline(always)]
    fn intersect<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<TriangleHit<R>> {
        solve(tri, ray, |det| det == R::from_f64(0.0))
    }
}

/// With the paper's epsilon: triangles this close to parallel to the ray, or this small, are
/// missed. The epsilon is an absolute number, a volume.
pub(super) struct UsualEpsilon;

/// The paper's epsilon.
const EPSILON: f64 = 1e-6;

impl TriangleTest for UsualEpsilon {
    const INFO: KernelInfo = KernelInfo::new("Möller-Trumbore ε", PAPER);

    #[inline(always)]
    fn intersect<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<TriangleHit<R>> {
        solve(tri, ray, |det| det.abs() < R::from_f64(EPSILON))
    }
}

/// The paper's solution for `det != 0` of either sign; edges and vertices count.
#[inline(always)]
fn solve<R: Scalar>(
    tri: &Triangle<R>,
    ray: &Ray<R>,
    is_parallel: impl Fn(R) -> bool,
) -> Option<TriangleHit<R>> {
    let (zero, one) = (R::from_f64(0.0), R::from_f64(1.0));
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
    ray.in_range(t).then_some(TriangleHit { t, b1: u, b2: v })
}

/// The paper's culling branch: triangles seen from behind are missed, and the division is done only
/// for a hit.
pub(super) struct Culling;

impl TriangleTest for Culling {
    const INFO: KernelInfo = KernelInfo::new("Möller-Trumbore cull", PAPER).culling();

    #[inline(always)]
    fn intersect<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<TriangleHit<R>> {
        let zero = R::from_f64(0.0);
        let (edge1, edge2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
        let pvec = ray.d.cross(edge2);
        let det = edge1.dot(pvec);
        if det < R::from_f64(EPSILON) {
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
        let inv_det = R::from_f64(1.0) / det;
        let t = edge2.dot(qvec) * inv_det;
        ray.in_range(t).then_some(TriangleHit {
            t,
            b1: u * inv_det,
            b2: v * inv_det,
        })
    }
}
