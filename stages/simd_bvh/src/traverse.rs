//! Walking: the closest hit and any hit, the same that asking every primitive would give.

// BEGIN SOLUTION(part6.task1)
use crate::search::Search;
use fearless_simd::dispatch;
// END SOLUTION(part6.task1)

use crate::wide::WideBvh;
use kit::{PrimId, Ray, TriangleHit};

/// What a walk took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Boxes tested: the children of every node on the way.
    pub box_tests: u64,
    /// Triangles and spheres tested.
    pub prim_tests: u64,
}

impl WideBvh {
    /// The closest hit in the ray's range: of which primitive, and where. Of hits at equal `t` the one with the lowest id.
    ///
    /// `left` is passed over. `exact` is the plain kernel: a ray's hit with a primitive in the ray's range (a sphere's with
    /// weights of 0). It is asked about spheres, and about triangles where the lanes are not sure. The answer is that of asking
    /// it about every primitive, bit for bit.
    #[inline]
    pub fn closest(
        &self,
        ray: &Ray,
        left: Option<PrimId>,
        exact: &mut impl FnMut(PrimId, &Ray) -> Option<TriangleHit>,
        work: &mut Work,
    ) -> Option<(PrimId, TriangleHit)> {
        // BEGIN SOLUTION(part6.task1)
        dispatch!(self.level, simd => {
            let mut search = Search::<_, _, false>::new(simd, self, ray, left, exact);
            search.run(work);
            search.found
        })
        // STUB: kit::hole!("part6.task1", self, ray, left, exact, work)
        // END SOLUTION(part6.task1)
    }

    /// Whether anything but `left` is in the ray's range. Stops at the first that is found. `exact` as for
    /// [`WideBvh::closest`].
    #[inline]
    pub fn occluded(
        &self,
        ray: &Ray,
        left: Option<PrimId>,
        exact: &mut impl FnMut(PrimId, &Ray) -> Option<TriangleHit>,
        work: &mut Work,
    ) -> bool {
        // BEGIN SOLUTION(part6.task1)
        dispatch!(self.level, simd => {
            let mut search = Search::<_, _, true>::new(simd, self, ray, left, exact);
            search.run(work);
            search.found.is_some()
        })
        // STUB: kit::hole!("part6.task1", self, ray, left, exact, work)
        // END SOLUTION(part6.task1)
    }
}
