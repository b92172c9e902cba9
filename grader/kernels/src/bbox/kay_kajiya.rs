// BEGIN SOLUTION(part2.task2)
//! Slab by slab: divide, sort the two, cut the interval.
//!
//! T. Kay, J. Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986. An origin on a plane and a ray along it make 0/0,
//! which is in no order with anything.

use super::{BoxTest, Interval};
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Aabb, Ray};

pub(super) struct KayKajiya;

impl BoxTest for KayKajiya {
    const ABOUT: About = About {
        name: "naive slabs",
        paper: "Kay, Kajiya 1986",
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>> {
        let (mut near, mut far) = (ray.min_t, ray.max_t);
        for axis in 0..3 {
            let (o, d) = (ray.o.on(axis), ray.d.on(axis));
            let mut t0 = (b.min.on(axis) - o) / d;
            let mut t1 = (b.max.on(axis) - o) / d;
            if t0 > t1 {
                (t0, t1) = (t1, t0);
            }
            near = t0.or_larger(near);
            far = t1.or_smaller(far);
        }
        (near <= far).then_some(Interval { near, far })
    }
}
// END SOLUTION(part2.task2)
