//! Builds the workers of all stages under test: in one build, if every stage compiles.
//!
//! If some stages do not compile, the compiler's messages name them, and a second build leaves them
//! out. If the errors are in another crate (a changed signature breaks the worker), each stage is
//! built alone.

use crate::build::{
    BuildLimit, BuildOutcome, BuildRoot, CompileErrors, INTERSECTION_STAGES, SCENES_FEATURE,
};
use crate::workers::runner::Worker;
use crate::workers::stage_workers::StageWorkers;
use base::GraderError;
use std::collections::BTreeMap;

/// The name in messages where no single stage is the cause.
const SCENES_WORKER: &str = "the worker for whole scenes";

/// The workers of some stages.
#[derive(Clone, Debug)]
pub struct WorkerSet {
    /// For each stage that compiles, a worker that links it.
    by_stage: BTreeMap<String, Worker>,
    /// A worker that links all intersection stages; the names of those that do not compile, if
    /// there are any.
    pub whole_scene: Result<Worker, String>,
    /// The compiler's messages about stages that do not compile.
    pub compiler: String,
    /// The limit that the compiler exceeded, if it did.
    pub limit: Option<BuildLimit>,
    /// Whether a build failed.
    pub has_failed: bool,
}

impl WorkerSet {
    /// Builds workers for `stages` in `build_root`. `whole_scene` also builds one for whole scenes.
    pub fn build(
        build_root: &BuildRoot,
        stages: &[&str],
        whole_scene: bool,
    ) -> Result<WorkerSet, GraderError> {
        let mut workers = WorkerSet::empty();
        let mut remaining = stages.to_vec();
        let mut whole_scene = whole_scene;
        while !remaining.is_empty() || whole_scene {
            let mut features = remaining.clone();
            features.extend(whole_scene.then_some(SCENES_FEATURE));
            let errors = match build_root.build_worker(&features)? {
                BuildOutcome::Worker(worker) => {
                    workers.add(&remaining, whole_scene, &worker);
                    break;
                }
                BuildOutcome::DoesNotCompile(errors) => errors,
            };
            workers.has_failed = true;
            workers.limit = workers.limit.or(errors.limit);
            let is_stage = |name: &String| {
                let mut known = stages.iter().chain(&INTERSECTION_STAGES);
                known.any(|stage| stage == name)
            };
            if !errors.failed_crates.iter().all(is_stage) {
                if features.len() == 1 && !whole_scene {
                    // It was built alone: its functions do not fit the worker's calls.
                    workers.compiler.push_str(&errors.messages);
                    break;
                }
                return WorkerSet::build_one_by_one(build_root, stages, whole_scene);
            }
            workers.compiler.push_str(&errors.messages);
            remaining.retain(|stage| !errors.failed_crates.contains(*stage));
            if whole_scene && let Some(names) = failed_intersection_stages(&errors) {
                (workers.whole_scene, whole_scene) = (Err(names), false);
            }
        }
        Ok(workers)
    }

    /// Builds a worker for each of `stages` alone.
    fn build_one_by_one(
        build_root: &BuildRoot,
        stages: &[&str],
        whole_scene: bool,
    ) -> Result<WorkerSet, GraderError> {
        let mut workers = WorkerSet {
            has_failed: true,
            ..WorkerSet::empty()
        };
        let mut all_errors = CompileErrors::default();
        let others = INTERSECTION_STAGES
            .iter()
            .filter(|stage| whole_scene && !stages.contains(stage));
        for &stage in stages.iter().chain(others) {
            match build_root.build_worker(&[stage])? {
                BuildOutcome::Worker(worker) => workers.add(&[stage], false, &worker),
                BuildOutcome::DoesNotCompile(errors) => {
                    workers.limit = workers.limit.or(errors.limit);
                    workers.compiler.push_str(&errors.messages);
                    all_errors.failed_crates.insert(stage.to_string());
                }
            }
        }
        if whole_scene {
            let failed = failed_intersection_stages(&all_errors);
            workers.whole_scene = match (failed, build_root.build_worker(&[SCENES_FEATURE])?) {
                (None, BuildOutcome::Worker(worker)) => Ok(worker),
                (names, _) => Err(names.unwrap_or_else(|| SCENES_WORKER.into())),
            };
        }
        Ok(workers)
    }

    /// A set without workers.
    fn empty() -> WorkerSet {
        WorkerSet {
            by_stage: BTreeMap::new(),
            whole_scene: Err(SCENES_WORKER.into()),
            compiler: String::new(),
            limit: None,
            has_failed: false,
        }
    }

    /// Adds `worker`, which links `stages` and, with `whole_scene`, all intersection stages.
    fn add(&mut self, stages: &[&str], whole_scene: bool, worker: &Worker) {
        let entries = stages.iter().map(|s| (s.to_string(), worker.clone()));
        self.by_stage.extend(entries);
        if whole_scene {
            self.whole_scene = Ok(worker.clone());
        }
    }

    /// The workers of `stage`; `None` if it does not compile.
    pub fn workers(&self, stage: &str) -> Option<StageWorkers> {
        Some(StageWorkers {
            stage: self.by_stage.get(stage)?.clone(),
            whole_scene: self.whole_scene.clone(),
        })
    }
}

/// The names of the intersection stages that do not compile, if any.
fn failed_intersection_stages(errors: &CompileErrors) -> Option<String> {
    let names = INTERSECTION_STAGES
        .iter()
        .filter(|stage| errors.failed_crates.contains(**stage));
    let names: Vec<String> = names.map(|stage| format!("`{stage}`")).collect();
    (!names.is_empty()).then(|| names.join(" and "))
}
