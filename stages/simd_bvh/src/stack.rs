// BEGIN SOLUTION(part6.task1)
//! What is still to be visited.

use crate::node::Child;
use crate::probe::Probe;

/// A child to visit later: where the ray enters it in the upper half, so that numbers are in that order, and which it is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Later(u64);

impl Later {
    /// Before all others.
    pub(crate) const NONE: Later = Later(0);

    #[inline(always)]
    pub(crate) fn new(entry: u32, child: Child) -> Later {
        Later(u64::from(entry) << 32 | u64::from(child.0))
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

/// Children to visit later, last in first out. Few trees are so deep that more than the array is needed.
pub(crate) struct Stack {
    first: [Later; Stack::NEAR],
    len: usize,
    beyond: Vec<Later>,
}

impl Stack {
    /// Places that need no heap.
    const NEAR: usize = 32;

    #[inline(always)]
    pub(crate) fn new() -> Stack {
        Stack {
            first: [Later::NONE; Stack::NEAR],
            len: 0,
            beyond: Vec::new(),
        }
    }

    #[inline(always)]
    pub(crate) fn push(&mut self, later: Later) {
        match self.first.get_mut(self.len) {
            Some(place) => {
                *place = later;
                self.len += 1;
            }
            None => self.beyond.push(later),
        }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<Later> {
        if self.len == Stack::NEAR
            && let Some(later) = self.beyond.pop()
        {
            return Some(later);
        }
        self.len = self.len.checked_sub(1)?;
        Some(self.first[self.len])
    }

    /// Takes children off until one is still within the range.
    #[inline(always)]
    pub(crate) fn pop_within(&mut self, probe: &impl Probe) -> Option<Child> {
        while let Some(later) = self.pop() {
            if probe.is_within(later.entry()) {
                return Some(later.child());
            }
        }
        None
    }
}
// END SOLUTION(part6.task1)
