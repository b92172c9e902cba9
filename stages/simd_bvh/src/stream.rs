//! The hits of many rays, equal to those of one ray after the other.

// BEGIN SOLUTION(part6.task1)
use crate::many_rays::ray_slot::RaySlot;
use crate::many_rays::slot_queue::GROUP_SIZE;
use crate::many_rays::stream_traversal::StreamTraversal;
use lanes::dispatch;
// END SOLUTION(part6.task1)

use crate::intersect::{ExactTest, TestCounts};
use crate::wide::{Subset, WideBvh};
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
    /// Replaces the contents of `hits` by the closest hit of each of `rays`, in their order: those
    /// of [`WideBvh::closest`], bit for bit, whichever rays are traced together.
    ///
    /// With [`Subset::Inner`], only primitives that are not apart have to be hit; then a hit is
    /// the closest one with those, or the closest one of all. A ray comes with the primitive that
    /// it cannot hit. `exact` is that of [`WideBvh::closest`].
    /// Adds the tests to `counts`: there may be a few more or less than for
    /// [`WideBvh::closest`], which visits some nodes in advance, but they do not depend on which
    /// rays are traced together either.
    pub fn closest_each(
        &self,
        subset: Subset,
        rays: &[(Ray, Option<PrimId>)],
        exact: &mut ExactTest,
        memory: &mut StreamMemory,
        counts: &mut TestCounts,
        hits: &mut Vec<Option<(PrimId, TriangleHit)>>,
    ) {
        // BEGIN SOLUTION(part6.task1)
        hits.clear();
        memory.trace_groups::<false>(self, subset, rays, exact, counts, |slots| {
            hits.extend(slots.iter().map(|slot| slot.found.closest));
        });
        // STUB: kit::hole!("part6.task1", self, subset, rays, exact, memory, counts, hits)
        // END SOLUTION(part6.task1)
    }

    /// Replaces the contents of `occluded` by whether each of `rays` hits anything, in their order:
    /// the results of [`WideBvh::occluded`]. Otherwise like [`WideBvh::closest_each`].
    pub fn occluded_each(
        &self,
        subset: Subset,
        rays: &[(Ray, Option<PrimId>)],
        exact: &mut ExactTest,
        memory: &mut StreamMemory,
        counts: &mut TestCounts,
        occluded: &mut Vec<bool>,
    ) {
        // BEGIN SOLUTION(part6.task1)
        occluded.clear();
        memory.trace_groups::<true>(self, subset, rays, exact, counts, |slots| {
            occluded.extend(slots.iter().map(|slot| slot.is_hit));
        });
        // STUB: kit::hole!("part6.task1", self, subset, rays, exact, memory, counts, occluded)
        // END SOLUTION(part6.task1)
    }
}

// BEGIN SOLUTION(part6.task1)
impl StreamMemory {
    /// Traces `rays` through `tree` group by group, and passes the slots of each group to `add`.
    fn trace_groups<const ANY: bool>(
        &mut self,
        tree: &WideBvh,
        subset: Subset,
        rays: &[(Ray, Option<PrimId>)],
        exact: &mut ExactTest,
        counts: &mut TestCounts,
        mut add: impl FnMut(&[RaySlot]),
    ) {
        let slots = self.slots();
        let roots = tree.roots_of(subset);
        dispatch!(tree.level, simd => {
            for rays in rays.chunks(GROUP_SIZE) {
                StreamTraversal::<_, ANY> {
                    simd, tree, roots, rays, slots, exact, counts,
                }.trace();
                add(&slots[..rays.len()]);
            }
        });
    }

    fn slots(&mut self) -> &mut [RaySlot; GROUP_SIZE] {
        self.slots
            .get_or_insert_with(|| Box::new(std::array::from_fn(|_| RaySlot::default())))
    }
}
// END SOLUTION(part6.task1)
