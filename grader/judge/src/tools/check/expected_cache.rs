//! Stores the exact results of a case. The exact oracle is slow and many versions of the code are
//! judged by the same results, so they are computed once, at first use.

use crate::tools::Tier;
use crate::tools::truth::expected::Expected;
use crate::tools::truth::scene;
use crate::tools::truth::tree_tests::NeededTests;
use oracle::closest::Closest;
use std::sync::OnceLock;
use wire::work::{Ray, SceneSource};

/// The exact results of a case, as far as they have been computed.
#[derive(Debug, Default)]
pub(crate) struct ExpectedCache {
    scene: OnceLock<Vec<Closest>>,
    core: OnceLock<Vec<Expected>>,
    robust: OnceLock<Vec<Expected>>,
    tests: OnceLock<NeededTests>,
}

impl ExpectedCache {
    /// The exact closest hit of each ray in a whole scene.
    pub(crate) fn of_scene(&self, source: &SceneSource, rays: &[Ray]) -> &[Closest] {
        self.scene.get_or_init(|| scene::closest_hits(source, rays))
    }

    /// The tests that rays through a whole scene need; `compute` computes them at first use.
    pub(crate) fn tests(&self, compute: impl FnOnce() -> NeededTests) -> NeededTests {
        *self.tests.get_or_init(compute)
    }

    /// The results that score at `tier`; `compute` computes them at first use.
    pub(crate) fn of_tier(
        &self,
        tier: Tier,
        compute: impl FnOnce() -> Vec<Expected>,
    ) -> &[Expected] {
        let results = match tier {
            Tier::Core => &self.core,
            Tier::Robust => &self.robust,
        };
        results.get_or_init(compute)
    }
}
