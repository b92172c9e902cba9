// BEGIN SOLUTION(part6.task1)
//! Triangles that a ray hits for certain, to be computed at the end of its traversal: by then
//! nearly all but the nearest one are out of its range.

use kit::PrimId;

/// A few triangles, each with a number that is at most the `t` of its hit in the tree's space.
#[derive(Default)]
pub(crate) struct Candidates {
    ids: [u32; Candidates::MOST],
    nearest: [f32; Candidates::MOST],
    len: usize,
}

impl Candidates {
    const MOST: usize = 8;

    #[inline(always)]
    pub(crate) fn is_full(&self) -> bool {
        self.len == Candidates::MOST
    }

    /// Adds a triangle if there is space.
    #[inline(always)]
    pub(crate) fn push(&mut self, id: PrimId, nearest: f32) {
        if !self.is_full() {
            self.ids[self.len] = id.0;
            self.nearest[self.len] = nearest;
            self.len += 1;
        }
    }

    /// Removes the triangle that was added last.
    #[inline(always)]
    pub(crate) fn pop(&mut self) -> Option<(PrimId, f32)> {
        self.len = self.len.checked_sub(1)?;
        let last = self.len % Candidates::MOST;
        Some((PrimId(self.ids[last]), self.nearest[last]))
    }
}
// END SOLUTION(part6.task1)
