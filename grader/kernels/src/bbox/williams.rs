//! The order of the two planes is taken from the sign of `1/d`, so that -0 is handled correctly,
//! too. The test returns as soon as the ray leaves one slab before it enters the next.
//!
//! A. Williams, S. Barrus, R. K. Morley, P. Shirley, "An Efficient and Robust Ray-Box Intersection
//! Algorithm", Journal of Graphics Tools 10(1), 2005.

use super::test::{BoxTest, Interval};
use crate::kernel::KernelInfo;
use crate::shapes::{Aabb, Ray};
use lanes::Scalar;

pub(crate) struct Williams;

impl BoxTest for Williams {
    const INFO: KernelInfo = KernelInfo::new("Williams", "Williams et al. 2005");

    #[inline(always)]
    fn intersect<R: Scalar>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>> {
        let (mut near, mut far) = (ray.min_t, ray.max_t);
        for axis in 0..3 {
            let (min, max) = (b.min.component(axis), b.max.component(axis));
            let (enters, leaves) = slab(min, max, ray.o.component(axis), ray.d.component(axis));
            // A NaN compares false, so it does not change the interval.
            if enters > far || leaves < near {
                return None;
            }
            near = enters.larger(near);
            far = leaves.smaller(far);
        }
        Some(Interval { near, far })
    }
}

/// Returns the `t` at which the ray enters and leaves the slab from `min` to `max`, on one axis.
#[inline(always)]
pub(super) fn slab<R: Scalar>(min: R, max: R, o: R, d: R) -> (R, R) {
    let inv_d = R::from_f64(1.0) / d;
    let (at_min, at_max) = ((min - o) * inv_d, (max - o) * inv_d);
    if inv_d < R::from_f64(0.0) {
        (at_max, at_min)
    } else {
        (at_min, at_max)
    }
}
