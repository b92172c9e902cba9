// BEGIN SOLUTION(part2.task2)
//! Which plane comes first is read off the sign of `1/d`, so that -0 is on the right side, too; and a ray that has left
//! one slab before it enters the next is let go at once.
//!
//! A. Williams, S. Barrus, R. K. Morley, P. Shirley, "An Efficient and Robust Ray-Box Intersection Algorithm", Journal
//! of Graphics Tools 10(1), 2005.

use super::{BoxTest, Interval};
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Aabb, Ray};

pub(super) struct Williams;

impl BoxTest for Williams {
    const ABOUT: About = About {
        name: "Williams",
        paper: "Williams et al. 2005",
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>> {
        let (mut near, mut far) = (ray.min_t, ray.max_t);
        for axis in 0..3 {
            let (min, max) = (b.min.on(axis), b.max.on(axis));
            let (enters, leaves) = slab(min, max, ray.o.on(axis), ray.d.on(axis));
            // A NaN compares false, and cuts nothing.
            if enters > far || leaves < near {
                return None;
            }
            near = enters.or_larger(near);
            far = leaves.or_smaller(far);
        }
        Some(Interval { near, far })
    }
}

/// Where the ray enters and leaves the slab from `min` to `max`, on one axis.
#[inline(always)]
pub(super) fn slab<R: Real>(min: R, max: R, o: R, d: R) -> (R, R) {
    let inv_d = R::of(1.0) / d;
    let (at_min, at_max) = ((min - o) * inv_d, (max - o) * inv_d);
    if inv_d < R::of(0.0) {
        (at_max, at_min)
    } else {
        (at_min, at_max)
    }
}
// END SOLUTION(part2.task2)
