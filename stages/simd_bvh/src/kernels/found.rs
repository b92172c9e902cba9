//! The closest hit that a traversal has found.

use crate::intersect::ExactTest;
use kit::{PrimId, Ray, TriangleHit};

/// The closest hit of the scalar kernel so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Found {
    pub(crate) closest: Option<(PrimId, TriangleHit)>,
}

impl Found {
    /// Tests primitive `id` with the scalar kernel, in the range of `ray` up to the closest hit.
    /// Returns the `t` of a hit.
    #[inline(always)]
    pub(crate) fn test(&mut self, id: PrimId, ray: &Ray, exact: &mut ExactTest) -> Option<f64> {
        let hit = match self.closest {
            None => exact(id, ray)?,
            Some((_, TriangleHit { t: max_t, .. })) => exact(id, &Ray { max_t, ..*ray })?,
        };
        self.accept(id, hit);
        Some(hit.t)
    }

    /// Accepts a hit if it is closer than the others. Of hits at equal `t` the one with the lowest
    /// id stays.
    #[inline(always)]
    pub(crate) fn accept(&mut self, id: PrimId, hit: TriangleHit) {
        let is_closer = |(best_id, best): (PrimId, TriangleHit)| (hit.t, id) < (best.t, best_id);
        if self.closest.is_none_or(is_closer) {
            self.closest = Some((id, hit));
        }
    }
}
