//! The hits of many rays, equal to those of one ray after the other.

// BEGIN SOLUTION(part6.task1)
use crate::ray_slot::RaySlot;
use crate::slot_queue::GROUP_SIZE;
use crate::stream_traversal::StreamTraversal;
use fearless_simd::dispatch;
// END SOLUTION(part6.task1)

use crate::intersect::{ExactTest, TestCounts};
use crate::wide::WideBvh;
use kit::{PrimId, Ray, TriangleHit};

/// The memory of [`WideBvh::closest_each`] and [`WideBvh::occluded_each`], which a thread reuses
/// from call to call.
#[derive(Clone, Debug, Default)]
pub struct StreamMemory {
    // BEGIN SOLUTION(part6.task1)
    slots: Option<Box<[RaySlot; GROUP_SIZE]>>,
    // STUB: // Add the fields that you need.
    // END SOLUTION(part6.task1)
}

impl WideBvh {
    /// The closest hit of each of `rays`, in their order, in place of what `hits` holds: those of
    /// [`WideBvh::closest`], bit for bit, whichever rays are traced together.
    ///
    /// A ray comes with the primitive that it cannot hit. `exact` is that of [`WideBvh::closest`].
    /// Adds the tests to `counts`: there may be a few more or less than for
    /// [`WideBvh::closest`], which visits some nodes in advance, but they do not depend on which
    /// rays are traced together either.
    pub fn closest_each(
        &self,
        rays: &[(Ray, Option<PrimId>)],
        exact: &mut ExactTest,
        memory: &mut StreamMemory,
        counts: &mut TestCounts,
        hits: &mut Vec<Option<(PrimId, TriangleHit)>>,
    ) {
        // BEGIN SOLUTION(part6.task1)
        hits.clear();
        let slots = memory.slots();
        dispatch!(self.level, simd => {
            let tree = self;
            for rays in rays.chunks(GROUP_SIZE) {
                StreamTraversal::<_, false> { simd, tree, rays, slots, exact, counts }.trace();
                hits.extend(slots[..rays.len()].iter().map(|slot| slot.found.closest));
            }
        });
        // STUB: kit::hole!("part6.task1", self, rays, exact, memory, counts, hits)
        // END SOLUTION(part6.task1)
    }

    /// Whether each of `rays` hits anything, in their order, in place of what `occluded` holds: the
    /// results of [`WideBvh::occluded`]. Otherwise like [`WideBvh::closest_each`].
    pub fn occluded_each(
        &self,
        rays: &[(Ray, Option<PrimId>)],
        exact: &mut ExactTest,
        memory: &mut StreamMemory,
        counts: &mut TestCounts,
        occluded: &mut Vec<bool>,
    ) {
        // BEGIN SOLUTION(part6.task1)
        occluded.clear();
        let slots = memory.slots();
        dispatch!(self.level, simd => {
            let tree = self;
            for rays in rays.chunks(GROUP_SIZE) {
                StreamTraversal::<_, true> { simd, tree, rays, slots, exact, counts }.trace();
                occluded.extend(slots[..rays.len()].iter().map(|slot| slot.is_hit));
            }
        });
        // STUB: kit::hole!("part6.task1", self, rays, exact, memory, counts, occluded)
        // END SOLUTION(part6.task1)
    }
}

// BEGIN SOLUTION(part6.task1)
impl StreamMemory {
    fn slots(&mut self) -> &mut [RaySlot; GROUP_SIZE] {
        self.slots
            .get_or_insert_with(|| Box::new(std::array::from_fn(|_| RaySlot::default())))
    }
}
// END SOLUTION(part6.task1)
