//! What a ray/box test computes, and how it becomes a kernel.

use crate::kernel::{KernelInfo, Test, ToF64};
use crate::shapes::{Aabb, Ray};
use lanes::Scalar;
use std::marker::PhantomData;

/// The interval of a ray inside a box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval<R> {
    pub(crate) near: R,
    pub(crate) far: R,
}

impl<R: Scalar> ToF64 for Interval<R> {
    type Output = kit::Interval;

    fn to_f64(self) -> kit::Interval {
        kit::Interval {
            min: self.near.to_f64(),
            max: self.far.to_f64(),
        }
    }
}

/// A ray/box test.
pub(crate) trait BoxTest: 'static {
    const INFO: KernelInfo;

    fn intersect<R: Scalar>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>>;
}

/// A box test without precomputation.
pub(super) struct WithoutPrecomputation<K>(PhantomData<K>);

impl<K: BoxTest> Test for WithoutPrecomputation<K> {
    type Shape = kit::Aabb;
    type Prepared<R: Scalar> = Aabb<R>;
    type Answer<R: Scalar> = Interval<R>;
    type AnswerF64 = kit::Interval;

    const INFO: KernelInfo = K::INFO;

    fn prepare<R: Scalar>(b: &Aabb<R>) -> Aabb<R> {
        *b
    }

    #[inline(always)]
    fn test<R: Scalar>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>> {
        K::intersect(b, ray)
    }
}
