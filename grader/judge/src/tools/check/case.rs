//! What a check knows of the case of its question.

use super::expected_cache::ExpectedCache;
use crate::tools::Tier;
use crate::tools::truth::expected::Expected;

/// The case of a question that is judged.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CaseContext<'a> {
    /// Its name in its task.
    pub(crate) name: &'a str,
    /// Whether the shapes enclose the origin of every ray, so that a miss is never right.
    pub(crate) enclosed: bool,
    /// The exact results, as far as they have been computed.
    pub(crate) cache: &'a ExpectedCache,
}

impl<'a> CaseContext<'a> {
    /// The results that score at `tier`; `compute` computes them at first use.
    pub(crate) fn expected(
        &self,
        tier: Tier,
        compute: impl FnOnce() -> Vec<Expected>,
    ) -> &'a [Expected] {
        self.cache.of_tier(tier, compute)
    }
}
