//! The stack of a ray that is traced together with others.

use crate::kernels::simd_box_test::BoxHits;
use crate::kernels::simd_box_test::Key;
use crate::layout::LANES;
use crate::layout::node::Child;
use fearless_simd::{Simd, mask32x8, prelude::*, u32x8};

/// The children that a ray has still to visit, and where it enters their boxes. The lowest entry is
/// [`Child::NONE`].
///
/// It is small, so that the stacks of many rays are in the first-level cache. Few rays need more
/// entries; they are traced alone.
#[derive(Clone, Debug)]
pub(crate) struct SlotStack {
    len: u32,
    keys: [Key; SlotStack::SIZE],
    children: [u32; SlotStack::SIZE],
}

impl Default for SlotStack {
    fn default() -> SlotStack {
        SlotStack {
            len: 1,
            keys: [0; SlotStack::SIZE],
            children: [Child::NONE.0; SlotStack::SIZE],
        }
    }
}

impl SlotStack {
    const SIZE: usize = 40;

    /// Replaces all entries by `roots`. Returns false if they are too many.
    #[inline(always)]
    pub(crate) fn start(&mut self, roots: &[Child]) -> bool {
        self.len = 1;
        for &root in roots {
            if self.is_full() {
                return false;
            }
            let len = (self.len as usize).min(SlotStack::SIZE - 1);
            self.keys[len] = 0;
            self.children[len] = root.0;
            self.len += 1;
        }
        true
    }

    /// Whether there is no space for the children of a node.
    #[inline(always)]
    pub(crate) fn is_full(&self) -> bool {
        self.len as usize + LANES > SlotStack::SIZE
    }

    /// The child to visit next; [`Child::NONE`] if there is none.
    #[inline(always)]
    pub(crate) fn top(&self) -> Child {
        Child(self.children[(self.len.wrapping_sub(1) as usize).min(SlotStack::SIZE - 1)])
    }

    /// Removes the top, which is a child.
    #[inline(always)]
    pub(crate) fn pop(&mut self) -> Child {
        let top = self.top();
        self.len -= 1;
        top
    }

    /// Adds children of a node, the nearest on top, after [`SlotStack::is_full`] was false.
    ///
    /// Writes eight entries, of which the first count: a branch for each would be mispredicted.
    #[inline(always)]
    pub(crate) fn push<S: Simd>(&mut self, hits: &BoxHits<S>) {
        let start = (self.len as usize).min(SlotStack::SIZE - LANES);
        let end = start + LANES;
        hits.keys.store_slice(&mut self.keys[start..end]);
        hits.children.store_slice(&mut self.children[start..end]);
        self.len += hits.count as u32;
    }

    /// Removes the children that the ray enters after `end`.
    #[inline(always)]
    pub(crate) fn cull<S: Simd>(&mut self, simd: S, end: Key) {
        let mut kept = 0;
        for first in (0..self.len as usize).step_by(LANES) {
            // Entries are read before they are overwritten: `kept` is at most `first`.
            let from = first.min(SlotStack::SIZE - LANES);
            let to = kept.min(SlotStack::SIZE - LANES);
            let keys = u32x8::from_slice(simd, &self.keys[from..from + LANES]);
            let children = u32x8::from_slice(simd, &self.children[from..from + LANES]);
            let here = (1_u64 << (self.len as usize - first).min(LANES)) - 1;
            let stays = keys.simd_le(end).to_bitmask() & here;
            let mask = mask32x8::from_bitmask(simd, stays);
            let (keys, children) = (keys.compress(mask), children.compress(mask));
            keys.store_slice(&mut self.keys[to..to + LANES]);
            children.store_slice(&mut self.children[to..to + LANES]);
            kept += stays.count_ones() as usize;
        }
        self.len = kept as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lanes::dispatch;
    use lanes::instruction_sets;

    /// The entries of a stack from the top, after `count` children with ascending keys were pushed
    /// and those after `end` removed.
    fn entries(count: u32, end: Key) -> Vec<u32> {
        let mut all = Vec::new();
        for level in instruction_sets() {
            let mut stack = SlotStack::default();
            assert!(stack.start(&[Child(1)]));
            dispatch!(level, simd => {
                for first in (2..count).step_by(5) {
                    assert!(!stack.is_full());
                    // Keys go up and down.
                    let entry = |i: u32| first + i * 3 % 5;
                    let keys = std::array::from_fn(|i| entry(i as u32));
                    stack.push(&BoxHits {
                        keys: u32x8::load_array(simd, keys),
                        children: u32x8::load_array(simd, keys),
                        count: 5,
                    });
                }
                stack.cull(simd, end);
            });
            let mut left = Vec::new();
            while stack.top() != Child::NONE {
                left.push(stack.pop().0);
            }
            all.push(left);
        }
        assert!(all.iter().all(|left| *left == all[0]), "{all:?}");
        all.swap_remove(0)
    }

    #[test]
    fn children_before_the_end_stay_in_their_order() {
        for count in [2, 7, 12, 17, 22, 27, 32] {
            let everything = entries(count, Key::MAX);
            assert_eq!(everything.len(), count as usize - 1);
            for end in 0..count + 2 {
                let mut expected = everything.clone();
                expected.retain(|&key| key <= end || key == 1);
                assert_eq!(entries(count, end), expected, "{count} {end}");
            }
        }
    }

    #[test]
    fn too_many_roots_do_not_fit() {
        let mut stack = SlotStack::default();
        assert!(!stack.start(&[Child(1); SlotStack::SIZE]));
    }
}
