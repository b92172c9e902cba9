//! Branchless slabs, with comparisons ordered so that a NaN is ignored: a ray in the plane of a
//! face is inside that slab.
//!
//! T. Barnes, "Fast, Branchless Ray/Bounding Box Intersections, Part 3: Boundaries", 2022,
//! <https://tavianator.com/2022/ray_box_boundary.html>.

use super::test::{BoxTest, Interval};
use crate::kernel::KernelInfo;
use crate::shapes::{Aabb, Ray};
use lanes::Scalar;

pub(super) struct NanSafe;

impl BoxTest for NanSafe {
    const INFO: KernelInfo = KernelInfo::new("NaN-safe slabs", "Barnes 2022");

    #[inline(always)]
    fn intersect<R: Scalar>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>> {
        let (mut near, mut far) = (ray.min_t, ray.max_t);
        for axis in 0..3 {
            let inv_d = R::from_f64(1.0) / ray.d.component(axis);
            let t0 = (b.min.component(axis) - ray.o.component(axis)) * inv_d;
            let t1 = (b.max.component(axis) - ray.o.component(axis)) * inv_d;
            let (before, after) = (near, far);
            near = t0.larger(before).smaller(t1.larger(before));
            far = t0.smaller(after).larger(t1.smaller(after));
        }
        (near <= far).then_some(Interval { near, far })
    }
}
