// BEGIN SOLUTION(part6.task1)
//! The stack of children that a traversal has still to visit.

use crate::box_test::BoxTest;
use crate::node::Child;

/// A child and the entry of the ray into its box, which is in the upper half, so that entries are
/// ordered by it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct StackEntry(u64);

impl StackEntry {
    /// Less than all others.
    pub(crate) const NONE: StackEntry = StackEntry(0);

    #[inline(always)]
    pub(crate) fn new(entry: u32, child: Child) -> StackEntry {
        StackEntry(u64::from(entry) << 32 | u64::from(child.0))
    }

    #[inline(always)]
    pub(crate) fn child(self) -> Child {
        Child(self.0 as u32)
    }

    #[inline(always)]
    fn entry(self) -> u32 {
        (self.0 >> 32) as u32
    }
}

/// A entry with its first entries in an array. Few trees are deep enough to need more.
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
            inline: [StackEntry::NONE; Stack::INLINE],
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

    #[inline(always)]
    fn pop(&mut self) -> Option<StackEntry> {
        if self.len == Stack::INLINE
            && let Some(entry) = self.overflow.pop()
        {
            return Some(entry);
        }
        self.len = self.len.checked_sub(1)?;
        Some(self.inline[self.len])
    }

    /// Pops entries until one is still in the range.
    #[inline(always)]
    pub(crate) fn pop_within(&mut self, box_test: &impl BoxTest) -> Option<Child> {
        while let Some(entry) = self.pop() {
            if box_test.is_within(entry.entry()) {
                return Some(entry.child());
            }
        }
        None
    }
}
// END SOLUTION(part6.task1)
