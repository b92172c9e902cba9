//! What a ray/triangle test computes, and how it becomes a kernel.

use crate::kernel::{Hit, HitF64, KernelInfo, Test};
use crate::shapes::{Ray, Triangle};
use lanes::Scalar;
use std::marker::PhantomData;

/// The hit of a ray with a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TriangleHit<R> {
    /// Distance along the ray in lengths of its direction.
    pub(crate) t: R,
    /// Barycentric weights of `p1` and `p2`.
    pub(super) b1: R,
    pub(super) b2: R,
}

/// A test that needs only the vertices.
pub(crate) trait TriangleTest: 'static {
    const INFO: KernelInfo;

    fn intersect<R: Scalar>(tri: &Triangle<R>, ray: &Ray<R>) -> Option<TriangleHit<R>>;
}

/// The hit point is `o + t·d`, with the error of `t`.
pub(super) struct PointOnRay<K>(PhantomData<K>);

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
pub(super) struct PointFromWeights<K>(PhantomData<K>);

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
pub(super) fn sum_if_same_sign<R: Scalar>([u, v, w]: [R; 3]) -> Option<R> {
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
