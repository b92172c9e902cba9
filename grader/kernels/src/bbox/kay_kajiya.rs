//! Slab by slab: divide, sort the two values, intersect the interval.
//!
//! T. Kay, J. Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986. A ray that starts on a plane and
//! is parallel to it computes 0/0, a NaN, for which every comparison is false.

use super::test::{BoxTest, Interval};
use crate::kernel::KernelInfo;
use crate::shapes::{Aabb, Ray};
use lanes::Scalar;

pub(crate) struct KayKajiya;

impl BoxTest for KayKajiya {
    const INFO: KernelInfo = KernelInfo::new("naive slabs", "Kay, Kajiya 1986");

    #[inline(always)]
    fn intersect<R: Scalar>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>> {
        let (mut near, mut far) = (ray.min_t, ray.max_t);
        for axis in 0..3 {
            let (o, d) = (ray.o.component(axis), ray.d.component(axis));
            let mut t0 = (b.min.component(axis) - o) / d;
            let mut t1 = (b.max.component(axis) - o) / d;
            if t0 > t1 {
                (t0, t1) = (t1, t0);
            }
            near = t0.larger(near);
            far = t1.smaller(far);
        }
        (near <= far).then_some(Interval { near, far })
    }
}
