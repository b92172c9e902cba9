//! Heat maps: the tests that each pixel of the picture took.

use super::Session;
use crate::scene_data::SceneData;
use crate::task::Task;
use pathtracer::replay::{HeatMap, heat_map};
use pathtracer::{Counters, Job, LightSettings};
use std::sync::Arc;
use std::time::Duration;

/// What a heat map counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeatKind {
    /// Box tests.
    Boxes,
    /// Primitive tests.
    Primitives,
}

impl HeatKind {
    /// The number that the map shows.
    pub fn of(self, counters: &Counters) -> u64 {
        match self {
            HeatKind::Boxes => counters.box_tests,
            HeatKind::Primitives => counters.prim_tests,
        }
    }
}

/// The heat map of the picture.
#[derive(Default)]
pub struct Heat {
    /// What it shows; `None` if the picture is shown.
    pub kind: Option<HeatKind>,
    /// The counts, and what they are of.
    map: Option<(Arc<SceneData>, Job, LightSettings, HeatMap)>,
    counting: Option<(Arc<SceneData>, Job, LightSettings, Task<HeatMap>)>,
    goes_to_costliest: bool,
}

impl Heat {
    /// The counts of the newest picture that was counted.
    pub fn map(&self) -> Option<&HeatMap> {
        self.map.as_ref().map(|(_, _, _, map)| map)
    }

    /// Whether it is counting.
    pub fn is_counting(&self) -> bool {
        self.counting.is_some()
    }
}

impl Session {
    pub(super) fn next_heat(&mut self) {
        if self.comparison.is_some() {
            return self.say("A and B are shown: end the comparison to see the heat map");
        }
        self.heat.kind = match self.heat.kind {
            None => Some(HeatKind::Boxes),
            Some(HeatKind::Boxes) => Some(HeatKind::Primitives),
            Some(HeatKind::Primitives) => None,
        };
        self.count_heat();
    }

    pub(super) fn go_to_costliest(&mut self) {
        self.heat.goes_to_costliest = true;
        self.heat.kind = self.heat.kind.or(Some(HeatKind::Boxes));
        self.count_heat();
    }

    /// Starts to count, unless the counts are there.
    fn count_heat(&mut self) {
        let Some((scene, job, settings, _)) = self.inspected_job() else {
            return;
        };
        let is_same = |s: &Arc<SceneData>, j: &Job, l: &LightSettings| {
            Arc::ptr_eq(s, &scene) && (*j, *l) == (job, settings)
        };
        let is_there = self
            .heat
            .map
            .as_ref()
            .is_some_and(|(s, j, l, _)| is_same(s, j, l));
        let is_coming = self
            .heat
            .counting
            .as_ref()
            .is_some_and(|(s, j, l, _)| is_same(s, j, l));
        if self.heat.kind.is_none() || is_there || is_coming {
            return;
        }
        let data = Arc::clone(&scene);
        let task = Task::spawn(Arc::clone(&self.wake), move |stop| {
            let prepared = &data.prepared;
            heat_map(
                &prepared.picture,
                &prepared.textures,
                &data.tree,
                &job,
                &settings,
                stop,
            )
        });
        self.heat.counting = Some((scene, job, settings, task));
    }

    pub(super) fn update_heat(&mut self, wait: Duration) {
        let counted = self
            .heat
            .counting
            .as_ref()
            .and_then(|(.., task)| task.wait(wait));
        if let Some(counted) = counted
            && let Some((scene, job, settings, _)) = self.heat.counting.take()
        {
            match counted {
                Ok(map) => self.heat.map = Some((scene, job, settings, map)),
                Err(failure) => {
                    self.heat.kind = None;
                    self.heat.goes_to_costliest = false;
                    self.say(format!("Nothing was counted: {failure}"));
                }
            }
        }
        if let (true, None, Some(kind), Some(map)) = (
            self.heat.goes_to_costliest,
            &self.heat.counting,
            self.heat.kind,
            self.heat.map(),
        ) {
            let costliest = map.costliest(|counters| kind.of(counters));
            self.heat.goes_to_costliest = false;
            if let Some((x, y)) = costliest {
                self.inspect(x, y);
            }
        }
    }
}
