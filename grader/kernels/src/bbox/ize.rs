//! Williams's slabs with the far end moved by 2 units in the last place. This is more than the
//! rounding errors of an entry and an exit: the test may hit although the ray misses closely, and
//! never misses a hit. There is no early exit, so there are no mispredicted branches.
//!
//! T. Ize, "Robust BVH Ray Traversal", Journal of Computer Graphics Techniques 2(2), 2013.

use super::test::{BoxTest, Interval};
use super::williams::slab;
use crate::kernel::KernelInfo;
use crate::shapes::{Aabb, Ray};
use lanes::Scalar;

pub(crate) struct Ize;

impl BoxTest for Ize {
    const INFO: KernelInfo = KernelInfo::new("Ize, 2 ulp", "Ize 2013");

    #[inline(always)]
    fn intersect<R: Scalar>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>> {
        let x = slab(b.min.x, b.max.x, ray.o.x, ray.d.x);
        let y = slab(b.min.y, b.max.y, ray.o.y, ray.d.y);
        let z = slab(b.min.z, b.max.z, ray.o.z, ray.d.z);
        let widening = R::from_f64(1.0 + 2.0 * R::PRECISION.epsilon());
        let near = z.0.larger(y.0.larger(x.0.larger(ray.min_t)));
        let leaves =
            z.1.smaller(y.1.smaller(x.1.smaller(R::from_f64(f64::INFINITY))));
        let far = (leaves * widening).smaller(ray.max_t);
        (near <= far).then_some(Interval { near, far })
    }
}
