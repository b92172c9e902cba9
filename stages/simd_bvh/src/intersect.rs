//! The closest hit and any hit of a ray, equal to those of brute force.

// BEGIN SOLUTION(part6.task1)
use crate::kernels::ray_in_tree::RayInTree;
use crate::many_rays::region;
use crate::one_ray::traversal::Traversal;
use crate::one_ray::unusual_ray;
use lanes::dispatch;
// END SOLUTION(part6.task1)

use crate::wide::{Subset, WideBvh};
use kit::{PrimId, Ray, TriangleHit, Vec3};

/// The number of tests of a traversal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TestCounts {
    /// Ray/box tests: the children of every visited node.
    pub box_tests: u64,
    /// Ray/primitive tests.
    pub prim_tests: u64,
}

/// A scalar kernel: intersects a ray with a primitive in the ray's range.
///
/// It is seldom called. Because it is a `dyn`, the traversal is compiled once, and not again in
/// each crate that calls it.
pub type ExactTest<'a> = dyn FnMut(PrimId, &Ray) -> Option<TriangleHit> + 'a;

impl WideBvh {
    /// The closest hit in the ray's range with any primitive but `skip`; at equal `t` the one with
    /// the lowest id.
    ///
    /// `exact` returns weights of 0 for spheres. It is called for spheres, and for triangles that
    /// the lanes cannot decide. The result equals that of calling it for every primitive, bit for
    /// bit. Adds to `counts`.
    pub fn closest(
        &self,
        ray: &Ray,
        skip: Option<PrimId>,
        exact: &mut ExactTest,
        counts: &mut TestCounts,
    ) -> Option<(PrimId, TriangleHit)> {
        // BEGIN SOLUTION(part6.task1)
        dispatch!(self.level, simd => match RayInTree::new(ray, &self.space) {
            Some(in_tree) => {
                Traversal::<_, false>::new(simd, self, ray, in_tree, skip, exact).closest(counts)
            }
            None => unusual_ray::closest(self, ray, skip, false, exact, counts),
        })
        // STUB: kit::hole!("part6.task1", self, ray, skip, exact, counts)
        // END SOLUTION(part6.task1)
    }

    /// Whether any primitive but `skip` is hit in the ray's range. Stops at the first hit. `exact`
    /// and `counts` are those of [`WideBvh::closest`].
    pub fn occluded(
        &self,
        ray: &Ray,
        skip: Option<PrimId>,
        exact: &mut ExactTest,
        counts: &mut TestCounts,
    ) -> bool {
        // BEGIN SOLUTION(part6.task1)
        dispatch!(self.level, simd => match RayInTree::new(ray, &self.space) {
            Some(in_tree) => {
                Traversal::<_, true>::new(simd, self, ray, in_tree, skip, exact).any(counts)
            }
            None => unusual_ray::closest(self, ray, skip, true, exact, counts).is_some(),
        })
        // STUB: kit::hole!("part6.task1", self, ray, skip, exact, counts)
        // END SOLUTION(part6.task1)
    }

    /// Adds all primitives of `subset` of which a part is in `region` to `ids`, and others that are
    /// near; in no order, and some perhaps twice. For many rays that are close to each other: what
    /// they hit is among them.
    ///
    /// The region is where `n·p <= c` for each of the pairs `(n, c)`; `c` may be infinite. Returns
    /// false if it is not small: if it has about `most` primitives or more. Then `ids` has no
    /// meaning. Adds the boxes to `counts`.
    pub fn primitives_in(
        &self,
        subset: Subset,
        region: &[(Vec3, f64)],
        most: usize,
        ids: &mut Vec<PrimId>,
        counts: &mut TestCounts,
    ) -> bool {
        // BEGIN SOLUTION(part6.task1)
        dispatch!(self.level, simd => region::find(simd, self, most, region, subset, counts, ids))
        // STUB: kit::hole!("part6.task1", self, subset, region, most, ids, counts)
        // END SOLUTION(part6.task1)
    }
}
