// BEGIN SOLUTION(part6.task1)
//! The stack of children that a traversal has still to visit.

use crate::box_test::Key;
use crate::node::Child;

/// A child and the key of its box, in one integer: two stores and a load of both would wait for
/// each other.
#[derive(Clone, Copy)]
pub(crate) struct StackEntry(u64);

impl StackEntry {
    #[inline(always)]
    pub(crate) fn new(key: Key, child: Child) -> StackEntry {
        StackEntry(u64::from(key) << 32 | u64::from(child.0))
    }

    #[inline(always)]
    pub(crate) fn key(self) -> Key {
        (self.0 >> 32) as Key
    }

    #[inline(always)]
    pub(crate) fn child(self) -> Child {
        Child(self.0 as u32)
    }
}

/// A stack with its first entries in an array. Few trees are deep enough to need more.
pub(crate) struct Stack {
    inline: [StackEntry; Stack::INLINE],
    len: usize,
    overflow: Vec<StackEntry>,
}

impl Stack {
    /// The number of entries that need no heap memory.
    const INLINE: usize = 32;

    #[inline(always)]
    pub(crate) fn new() -> Stack {
        Stack {
            inline: [StackEntry(0); Stack::INLINE],
            len: 0,
            overflow: Vec::new(),
        }
    }

    #[inline(always)]
    pub(crate) fn push(&mut self, entry: StackEntry) {
        match self.inline.get_mut(self.len) {
            Some(slot) => {
                *slot = entry;
                self.len += 1;
            }
            None => self.overflow.push(entry),
        }
    }

    /// Pushes the first `count` of three entries. All are written, because a branch for each would
    /// be mispredicted.
    #[inline(always)]
    pub(crate) fn push_up_to_3(&mut self, entries: [StackEntry; 3], count: usize) {
        if let Some([a, b, c]) = self.inline.get_mut(self.len..self.len + 3) {
            *a = entries[0];
            *b = entries[1];
            *c = entries[2];
            self.len += count;
        } else {
            for &entry in &entries[..count] {
                self.push(entry);
            }
        }
    }

    #[inline(always)]
    pub(crate) fn pop(&mut self) -> Option<StackEntry> {
        if self.len == Stack::INLINE
            && let Some(entry) = self.overflow.pop()
        {
            return Some(entry);
        }
        self.len = self.len.checked_sub(1)?;
        Some(self.inline[self.len % Stack::INLINE])
    }
}
// END SOLUTION(part6.task1)
