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
            let [enters, leaves] = slab(b, ray, axis);
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

/// Where the ray enters and leaves a slab.
#[inline(always)]
pub(super) fn slab<R: Real>(b: &Aabb<R>, ray: &Ray<R>, axis: usize) -> [R; 2] {
    let inv_d = R::of(1.0) / ray.d.on(axis);
    let (min, max) = (b.min.on(axis), b.max.on(axis));
    let planes = if inv_d < R::of(0.0) {
        [max, min]
    } else {
        [min, max]
    };
    planes.map(|plane| (plane - ray.o.on(axis)) * inv_d)
}
// END SOLUTION(part2.task2)
