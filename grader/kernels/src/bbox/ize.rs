// BEGIN SOLUTION(part2.task2)
//! Williams's slabs with the exit 2 units in the last place later, which is more than an entry and an exit can be rounded
//! past each other: it may hit by a hair too much, and never misses. Nothing is left early: no branch to guess wrong.
//!
//! T. Ize, "Robust BVH Ray Traversal", Journal of Computer Graphics Techniques 2(2), 2013.

use super::williams::slab;
use super::{BoxTest, Interval};
use crate::kernel::About;
use crate::real::Real;
use crate::shapes::{Aabb, Ray};

pub(crate) struct Ize;

impl BoxTest for Ize {
    const ABOUT: About = About {
        name: "Ize, 2 ulp",
        paper: "Ize 2013",
        culls: false,
    };

    #[inline(always)]
    fn meet<R: Real>(b: &Aabb<R>, ray: &Ray<R>) -> Option<Interval<R>> {
        let x = slab(b.min.x, b.max.x, ray.o.x, ray.d.x);
        let y = slab(b.min.y, b.max.y, ray.o.y, ray.d.y);
        let z = slab(b.min.z, b.max.z, ray.o.z, ray.d.z);
        let widening = R::of(1.0 + 2.0 * R::PRECISION.epsilon());
        let near = z.0.or_larger(y.0.or_larger(x.0.or_larger(ray.min_t)));
        let leaves =
            z.1.or_smaller(y.1.or_smaller(x.1.or_smaller(R::of(f64::INFINITY))));
        let far = (leaves * widening).or_smaller(ray.max_t);
        (near <= far).then_some(Interval { near, far })
    }
}
// END SOLUTION(part2.task2)
