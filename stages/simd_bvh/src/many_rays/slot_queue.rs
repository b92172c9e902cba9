//! Which rays of a group need a node, a block of triangles or a block of spheres next.

use crate::layout::node::Child;

/// The number of rays that are traced together. Their slots fit into the first-level cache; twice
/// as many take longer.
pub(crate) const GROUP_SIZE: usize = 64;

/// The numbers of slots, each at most once.
pub(crate) struct SlotQueue {
    count: usize,
    slots: [u16; GROUP_SIZE],
}

impl SlotQueue {
    const EMPTY: SlotQueue = SlotQueue {
        count: 0,
        slots: [0; GROUP_SIZE],
    };

    /// Removes all slots and returns how many there were. [`SlotQueue::get`] still returns them.
    ///
    /// They may be pushed again while they are read, as long as at most `i + 1` of them have been
    /// pushed when number `i` has been read.
    #[inline(always)]
    pub(crate) fn take(&mut self) -> usize {
        std::mem::take(&mut self.count)
    }

    /// Slot number `i` of those that were in the queue before [`SlotQueue::take`].
    #[inline(always)]
    pub(crate) fn get(&self, i: usize) -> usize {
        usize::from(self.slots[i % GROUP_SIZE]) % GROUP_SIZE
    }

    /// Adds `slot` if `is_next`. A branch would be mispredicted.
    #[inline(always)]
    pub(crate) fn push(&mut self, slot: usize, is_next: bool) {
        self.slots[self.count % GROUP_SIZE] = slot as u16;
        self.count += usize::from(is_next);
    }

    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }
}

/// The slots that need a child of each kind next.
pub(crate) struct SlotQueues {
    pub(crate) nodes: SlotQueue,
    pub(crate) triangles: SlotQueue,
    pub(crate) spheres: SlotQueue,
}

impl SlotQueues {
    pub(crate) const EMPTY: SlotQueues = SlotQueues {
        nodes: SlotQueue::EMPTY,
        triangles: SlotQueue::EMPTY,
        spheres: SlotQueue::EMPTY,
    };

    /// Adds `slot` to the queue of `next`, the child that it needs; to none for [`Child::NONE`].
    #[inline(always)]
    pub(crate) fn push(&mut self, slot: usize, next: Child) {
        self.nodes.push(slot, next.is_node());
        self.triangles.push(slot, next.is_triangles());
        self.spheres.push(slot, next.is_spheres());
    }
}
