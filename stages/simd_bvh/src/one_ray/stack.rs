//! The stack of children that a traversal has still to visit.

use crate::kernels::simd_box_test::Key;
use crate::layout::LANES;
use crate::layout::node::Child;
use fearless_simd::{Simd, prelude::*, u32x8};

/// The memory of a stack of children and their keys. The last entries are in arrays; few trees are
/// deep enough to need more.
///
/// The number of entries in the arrays is the caller's: next to arrays with variable indices it
/// would be loaded and stored at every step.
#[repr(C, align(64))]
pub(crate) struct StackMemory {
    /// Eight more than [`StackMemory::INLINE`], so that every index below it has space for eight.
    keys: [Key; StackMemory::INLINE + LANES],
    /// Between the arrays, so that each is set to 0 by itself: for both at once the compiler calls
    /// a function.
    overflow: Vec<(Key, u32)>,
    children: [u32; StackMemory::INLINE + LANES],
}

impl StackMemory {
    /// The number of entries that need no heap memory.
    const INLINE: usize = 64;

    #[inline(always)]
    pub(crate) fn new() -> StackMemory {
        StackMemory {
            keys: [0; StackMemory::INLINE + LANES],
            children: [0; StackMemory::INLINE + LANES],
            overflow: Vec::new(),
        }
    }

    /// Makes space for two nodes' entries above `len`. Returns the new `len`.
    ///
    /// To be called before the entries are computed: a call in between would spill all registers.
    #[inline(always)]
    pub(crate) fn reserve(&mut self, len: usize) -> usize {
        if len + 2 * LANES <= StackMemory::INLINE {
            return len;
        }
        self.move_to_heap(len);
        0
    }

    /// Writes eight entries above `len`, after [`StackMemory::reserve`]. Those that count are the
    /// first ones, the last of them on top; a branch for each would be mispredicted.
    #[inline(always)]
    pub(crate) fn write<S: Simd>(&mut self, len: usize, keys: u32x8<S>, children: u32x8<S>) {
        let len = len % StackMemory::INLINE;
        keys.store_slice(&mut self.keys[len..len + LANES]);
        children.store_slice(&mut self.children[len..len + LANES]);
    }

    /// Pushes one entry with the least key. Returns the new `len`.
    #[inline(always)]
    pub(crate) fn push(&mut self, len: usize, child: Child) -> usize {
        let len = self.reserve(len) % StackMemory::INLINE;
        self.keys[len] = 0;
        self.children[len] = child.0;
        len + 1
    }

    /// The entry below `len`, if there is one, and the new `len`.
    #[inline(always)]
    pub(crate) fn pop(&mut self, len: usize) -> Option<(usize, Key, Child)> {
        if len > 0 {
            let (key, child) = self.peek(len);
            return Some((len - 1, key, child));
        }
        if self.overflow.is_empty() {
            return None;
        }
        let (key, child) = self.pop_from_heap();
        Some((0, key, child))
    }

    /// The entry below `len`, which stays where it is.
    #[inline(always)]
    pub(crate) fn peek(&self, len: usize) -> (Key, Child) {
        let slot = len.wrapping_sub(1) % StackMemory::INLINE;
        (self.keys[slot], Child(self.children[slot]))
    }

    /// The last entry on the heap, which is not empty.
    #[cold]
    #[inline(never)]
    fn pop_from_heap(&mut self) -> (Key, Child) {
        let (key, child) = self.overflow.pop().unwrap_or_default();
        (key, Child(child))
    }

    #[cold]
    #[inline(never)]
    fn move_to_heap(&mut self, len: usize) {
        let entries = self.keys.into_iter().zip(self.children);
        self.overflow.extend(entries.take(len));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::Level;
    use lanes::dispatch;

    #[test]
    fn entries_come_back_in_reverse_however_many_there_are() {
        let mut stack = StackMemory::new();
        let mut len = 0;
        let mut expected = Vec::new();
        for first in 0..100 {
            let count = first as usize % LANES + 1;
            let entries: [u32; LANES] = std::array::from_fn(|i| 8 * first + i as u32);
            len = stack.reserve(len);
            dispatch!(Level::new(), simd => {
                let lanes = u32x8::load_array(simd, entries);
                stack.write(len, lanes, lanes);
            });
            len += count;
            expected.extend(&entries[..count]);
        }
        while let Some(entry) = expected.pop() {
            let (below, key, child) = stack.pop(len).expect("an entry");
            assert_eq!((key, child), (entry, Child(entry)));
            len = below;
        }
        assert_eq!(stack.pop(len), None);
    }
}
