// BEGIN SOLUTION(part2.task2)
//! Slabs without a branch, in an order of comparisons that passes over NaN: a ray along a plane that it starts on is
//! inside that slab.
//!
//! T. Barnes, "Fast, Branchless Ray/Bounding Box Intersections, Part 3: Boundaries", 2022,
//! <https://tavianator.com/2022/ray_box_boundary.html>.

use super::{BoxTest, Interval};
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Aabb, Ray};

pub(super) struct NanSafe;

impl BoxTest for NanSafe {
    const ABOUT: About = About {
        name: "NaN-safe slabs",
        paper: "Barnes 2022",
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>> {
        let (mut near, mut far) = (ray.min_t, ray.max_t);
        for axis in 0..3 {
            let inv_d = R::of(1.0) / ray.d.on(axis);
            let t0 = (b.min.on(axis) - ray.o.on(axis)) * inv_d;
            let t1 = (b.max.on(axis) - ray.o.on(axis)) * inv_d;
            let (before, after) = (near, far);
            near = t0.or_larger(before).or_smaller(t1.or_larger(before));
            far = t0.or_smaller(after).or_larger(t1.or_smaller(after));
        }
        (near <= far).then_some(Interval { near, far })
    }
}
// END SOLUTION(part2.task2)
