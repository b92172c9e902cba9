// BEGIN SOLUTION(part1.task3)
//! Ray/triangle tests. Edges, vertices and both ends of the ray's range count; both faces are hit.
//!
//! With the vertices relative to the ray's origin, `A = p0 - o` and so on, the ray's line passes
//! through the triangle if `d·(B×C)`, `d·(C×A)` and `d·(A×B)` do not differ in sign. All of these
//! kernels are based on this test. They differ in the values that they round on the way, and in the
//! values that they do not compute.

mod baldwin_weber;
mod filtered;
pub(crate) mod moller_trumbore;
mod plane;
pub(crate) mod plucker;
pub(crate) mod woop;
mod woop_fused;

use crate::kernel::{Hit, HitF64, Kernel, KernelInfo, Test};
use crate::shapes::{Ray, Triangle};
use lanes::Scalar;
use std::marker::PhantomData;

/// The hit of a ray with a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleHit<R> {
    /// Distance along the ray in lengths of its direction.
    pub(crate) t: R,
    /// Barycentric weights of `p1` and `p2`.
    b1: R,
    b2: R,
}

/// A test that needs only the vertices.
pub(crate) trait TriangleTest: 'static {
    const INFO: KernelInfo;

    fn intersect<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<TriangleHit<R>>;
}

/// The hit point is `o + t·d`, with the error of `t`.
struct PointOnRay<K>(PhantomData<K>);

impl<K: TriangleTest> Test for PointOnRay<K> {
    type Shape = kit::Triangle;
    type Prepared<R: Scalar> = Triangle<R>;
    type Answer<R: Scalar> = Hit<R>;
    type AnswerF64 = HitF64;

    const INFO: KernelInfo = K::INFO;

    fn prepare<R: Scalar>(tri: &Triangle<R>) -> Triangle<R> {
        *tri
    }

    #[inline(always)]
    fn test<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Hit<R>> {
        let TriangleHit { t, .. } = K::intersect(tri, ray)?;
        Some(Hit { t, p: ray.at(t) })
    }
}

/// The hit point is interpolated from the vertices: it is on the plane, however far away the ray
/// starts (PBRT §6.5.3).
struct PointFromWeights<K>(PhantomData<K>);

impl<K: TriangleTest> Test for PointFromWeights<K> {
    type Shape = kit::Triangle;
    type Prepared<R: Scalar> = Triangle<R>;
    type Answer<R: Scalar> = Hit<R>;
    type AnswerF64 = HitF64;

    const INFO: KernelInfo = K::INFO;

    fn prepare<R: Scalar>(tri: &Triangle<R>) -> Triangle<R> {
        *tri
    }

    #[inline(always)]
    fn test<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<Hit<R>> {
        let TriangleHit { t, b1, b2 } = K::intersect(tri, ray)?;
        let p = tri.p0 + (tri.p1 - tri.p0) * b1 + (tri.p2 - tri.p0) * b2;
        Some(Hit { t, p })
    }
}

/// Returns the sum of three edge functions if they have the same sign; the line then passes through
/// the triangle.
#[inline(always)]
fn sum_if_same_sign<R: Scalar>([u, v, w]: [R; 3]) -> Option<R> {
    let zero = R::from_f64(0.0);
    // Without a branch per comparison: which of the three differs cannot be predicted.
    let (is_below, is_above) = (
        (u < zero) | (v < zero) | (w < zero),
        (u > zero) | (v > zero) | (w > zero),
    );
    if is_below & is_above {
        return None;
    }
    let det = u + v + w;
    (det != zero).then_some(det)
}

/// Returns all kernels, the textbook's first.
pub(crate) fn kernels() -> Vec<Kernel<kit::Triangle, HitF64>> {
    use baldwin_weber::BaldwinWeber;
    use filtered::Filtered;
    use moller_trumbore::{Culling, MollerTrumbore, UsualEpsilon};
    use plane::PlaneThenSides;
    use plucker::Plucker;
    use woop::Woop;
    use woop_fused::{Fused, FusedAtZero};
    vec![
        Kernel::new::<PointOnRay<MollerTrumbore>, f64>(),
        Kernel::new::<PointOnRay<MollerTrumbore>, f32>(),
        Kernel::new::<PointOnRay<UsualEpsilon>, f64>(),
        Kernel::new::<PointOnRay<UsualEpsilon>, f32>(),
        Kernel::new::<PointOnRay<Culling>, f64>(),
        Kernel::new::<PointOnRay<Culling>, f32>(),
        Kernel::new::<PointOnRay<PlaneThenSides>, f64>(),
        Kernel::new::<PointOnRay<PlaneThenSides>, f32>(),
        Kernel::new::<BaldwinWeber, f64>(),
        Kernel::new::<BaldwinWeber, f32>(),
        Kernel::new::<PointOnRay<Plucker>, f64>(),
        Kernel::new::<PointOnRay<Plucker>, f32>(),
        Kernel::new::<PointFromWeights<Woop>, f64>(),
        Kernel::new::<PointFromWeights<Woop>, f32>(),
        Kernel::new_f32_in_f64::<PointFromWeights<Woop>>(),
        Kernel::new::<PointFromWeights<FusedAtZero>, f64>(),
        Kernel::new::<PointFromWeights<Fused>, f64>(),
        Kernel::new::<PointFromWeights<Filtered>, f64>(),
    ]
}
// END SOLUTION(part1.task3)
