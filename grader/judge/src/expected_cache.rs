//! What is right about each call of a case. The exact oracle takes its time, and many versions of
//! the code are judged by the same: so it is asked once, by whoever comes first.

use super::expected::Expected;
use super::scene;
use crate::Tier;
use crate::cases::Spec;
use crate::tasks;
use oracle::closest::Closest;
use std::sync::OnceLock;
use wire::work::{Ray, SceneSource};

/// What the oracle has said about a case.
#[derive(Debug, Default)]
pub(crate) struct ExpectedCache {
    scene: OnceLock<Vec<Closest>>,
    core: OnceLock<Vec<Expected>>,
    robust: OnceLock<Vec<Expected>>,
}

impl ExpectedCache {
    /// What each ray truly hits in a whole scene.
    pub(super) fn of_scene(&self, source: &SceneSource, rays: &[Ray]) -> &[Closest] {
        self.scene.get_or_init(|| scene::closest_hits(source, rays))
    }

    /// What scores on each probe or ray of `spec`, whose truths these are; nothing if it has no
    /// single shapes and no list of shapes.
    pub(super) fn of_shapes(&self, spec: &Spec, tier: Tier) -> &[Expected] {
        let known = match tier {
            Tier::Core => &self.core,
            Tier::Robust => &self.robust,
        };
        known.get_or_init(|| expected(spec, tier))
    }
}

/// What scores on each probe or ray of a case about single shapes or a list of them; nothing for
/// other cases.
pub fn expected(spec: &Spec, tier: Tier) -> Vec<Expected> {
    tasks::check_of(&spec.work).expected(tier, spec.enclosed)
}
