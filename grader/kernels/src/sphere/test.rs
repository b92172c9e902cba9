//! What a ray/sphere test computes, and how it becomes a kernel.

use crate::kernel::{Hit, HitF64, KernelInfo, Test};
use crate::shapes::{Ray, Sphere};
use lanes::Scalar;
use std::marker::PhantomData;

/// A ray/sphere test that returns `t`.
pub(super) trait SphereTest: 'static {
    const INFO: KernelInfo;
    /// The info of the variant that projects its hit point back onto the sphere.
    const REPROJECTED: KernelInfo;

    fn intersect<R: Scalar>(s: &Sphere<R>, ray: &Ray<R>) -> Option<R>;
}

/// Returns the first of two ordered roots that is in the range.
#[inline(always)]
pub(super) fn first_in_range<R: Scalar>(ray: &Ray<R>, near: R, far: R) -> Option<R> {
    if ray.in_range(near) {
        Some(near)
    } else {
        ray.in_range(far).then_some(far)
    }
}

/// The hit point is `o + t·d`, with the error of `t`.
pub(super) struct PointOnRay<K>(PhantomData<K>);

impl<K: SphereTest> Test for PointOnRay<K> {
    type Shape = kit::Sphere;
    type Prepared<R: Scalar> = Sphere<R>;
    type Answer<R: Scalar> = Hit<R>;
    type AnswerF64 = HitF64;

    const INFO: KernelInfo = K::INFO;

    fn prepare<R: Scalar>(s: &Sphere<R>) -> Sphere<R> {
        *s
    }

    #[inline(always)]
    fn test<R: Scalar>(s: &Sphere<R>, ray: &Ray<R>) -> Option<Hit<R>> {
        let t = K::intersect(s, ray)?;
        Some(Hit { t, p: ray.at(t) })
    }
}

/// The hit point is `o + t·d`, projected back onto the sphere along the line to its centre (PBRT
/// §6.8.5): it is on the surface, but may be moved within it.
pub(super) struct ReprojectedPoint<K>(PhantomData<K>);

impl<K: SphereTest> Test for ReprojectedPoint<K> {
    type Shape = kit::Sphere;
    type Prepared<R: Scalar> = Sphere<R>;
    type Answer<R: Scalar> = Hit<R>;
    type AnswerF64 = HitF64;

    const INFO: KernelInfo = K::REPROJECTED;

    fn prepare<R: Scalar>(s: &Sphere<R>) -> Sphere<R> {
        *s
    }

    #[inline(always)]
    fn test<R: Scalar>(s: &Sphere<R>, ray: &Ray<R>) -> Option<Hit<R>> {
        let t = K::intersect(s, ray)?;
        let from_center = ray.at(t) - s.center;
        let stretch = s.radius / from_center.dot(from_center).sqrt();
        Some(Hit {
            t,
            p: s.center + from_center * stretch,
        })
    }
}
