// BEGIN SOLUTION(part2.task2)
//! Rays and boxes: the interval of the ray between the last entry and the first exit of three slabs.

pub(crate) mod ize;
mod kay_kajiya;
mod nan_safe;
mod williams;

use crate::kernel::{About, Kernel, Test, Widen};
use crate::real::Real;
use crate::shapes::{Aabb, Ray};
use std::marker::PhantomData;

/// Where a ray is inside a box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval<R> {
    pub(crate) near: R,
    pub(crate) far: R,
}

impl<R: Real> Widen for Interval<R> {
    type Wide = kit::Interval;

    fn wide(self) -> kit::Interval {
        kit::Interval {
            min: self.near.wide(),
            max: self.far.wide(),
        }
    }
}

/// A box test.
pub(crate) trait BoxTest: 'static {
    const ABOUT: About;

    fn meet<R: Real>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>>;
}

/// Boxes need nothing done beforehand.
struct Plain<K>(PhantomData<K>);

impl<K: BoxTest> Test for Plain<K> {
    type Shape = kit::Aabb;
    type Prepared<R: Real> = Aabb<R>;
    type Answer<R: Real> = Interval<R>;
    type Wide = kit::Interval;

    const ABOUT: About = K::ABOUT;

    fn prepare<R: Real>(b: &Aabb<R>) -> Aabb<R> {
        *b
    }

    #[inline(always)]
    fn test<R: Real>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>> {
        K::meet(b, ray)
    }
}

/// All of them, the textbook's first.
pub(crate) fn kernels() -> Vec<Kernel<kit::Aabb, kit::Interval>> {
    use ize::Ize;
    use kay_kajiya::KayKajiya;
    use nan_safe::NanSafe;
    use williams::Williams;
    vec![
        Kernel::of::<Plain<KayKajiya>, f64>(),
        Kernel::of::<Plain<KayKajiya>, f32>(),
        Kernel::of::<Plain<NanSafe>, f64>(),
        Kernel::of::<Plain<NanSafe>, f32>(),
        Kernel::of::<Plain<Williams>, f64>(),
        Kernel::of::<Plain<Williams>, f32>(),
        Kernel::of::<Plain<Ize>, f64>(),
        Kernel::of::<Plain<Ize>, f32>(),
    ]
}
// END SOLUTION(part2.task2)
