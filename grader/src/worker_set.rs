//! The workers of all stages under test: one build where every stage compiles.
//!
//! Where some do not, they are told by whose errors the compiler shows, and a second build goes without them. Only
//! where the errors are no stage's own (a changed signature breaks the worker) is each stage tried alone.

use crate::compile::{Broken, Build, Built};
use crate::error::GraderError;
use crate::grade::BuildRoot;
use crate::runner::Worker;
use crate::stage_workers::Workers;
use std::collections::BTreeMap;

/// The cargo feature of the worker that rays go through whole scenes in.
const TOGETHER: &str = "meshes";

/// The stages that it has.
const HITTING_STAGES: [&str; 3] = ["intersect", "bbox", "bvh"];

/// The workers of some stages.
#[derive(Clone, Debug)]
pub struct WorkerSet {
    /// For each stage that compiles a worker that has it.
    own: BTreeMap<String, Worker>,
    /// Has every stage that hits something; or why there is none: the stages that do not compile.
    pub together: Result<Worker, String>,
    /// What the compiler said of stages that do not compile.
    pub compiler: String,
}

impl WorkerSet {
    /// Builds workers for `stages` at `site`; with `together` one for rays through whole scenes, too.
    pub fn build(
        site: &BuildRoot,
        stages: &[&str],
        together: bool,
    ) -> Result<WorkerSet, GraderError> {
        let mut workers = WorkerSet::none();
        let mut sound = stages.to_vec();
        let mut together = together;
        while !sound.is_empty() || together {
            let mut features = sound.clone();
            features.extend(together.then_some(TOGETHER));
            let broken = match build(site, &features)? {
                Built::Worker(program) => {
                    workers.has(&sound, together, &program.into());
                    break;
                }
                Built::DoesNotCompile(broken) => broken,
            };
            let is_stage = |name: &String| {
                let mut known = stages.iter().chain(&HITTING_STAGES);
                known.any(|stage| stage == name)
            };
            if !broken.crates.iter().all(is_stage) {
                return WorkerSet::one_by_one(site, stages, together);
            }
            workers.compiler.push_str(&broken.messages);
            sound.retain(|stage| !broken.crates.contains(*stage));
            if together && let Some(names) = hitting(&broken) {
                (workers.together, together) = (Err(names), false);
            }
        }
        Ok(workers)
    }

    /// Builds a worker for each of `stages` alone.
    fn one_by_one(
        site: &BuildRoot,
        stages: &[&str],
        together: bool,
    ) -> Result<WorkerSet, GraderError> {
        let mut workers = WorkerSet::none();
        let mut all_broken = Broken::default();
        let others = HITTING_STAGES
            .iter()
            .filter(|stage| together && !stages.contains(stage));
        for &stage in stages.iter().chain(others) {
            match build(site, &[stage])? {
                Built::Worker(program) => workers.has(&[stage], false, &program.into()),
                Built::DoesNotCompile(broken) => {
                    workers.compiler.push_str(&broken.messages);
                    all_broken.crates.insert(stage.to_string());
                }
            }
        }
        if together {
            workers.together = match (hitting(&all_broken), build(site, &[TOGETHER])?) {
                (None, Built::Worker(program)) => Ok(program.into()),
                (names, _) => Err(names.unwrap_or_else(|| "the worker for whole scenes".into())),
            };
        }
        Ok(workers)
    }

    /// No worker yet.
    fn none() -> WorkerSet {
        WorkerSet {
            own: BTreeMap::new(),
            together: Err("the worker for whole scenes".into()),
            compiler: String::new(),
        }
    }

    /// `worker` has `stages`.
    fn has(&mut self, stages: &[&str], together: bool, worker: &Worker) {
        let own = stages.iter().map(|s| (s.to_string(), worker.clone()));
        self.own.extend(own);
        if together {
            self.together = Ok(worker.clone());
        }
    }

    /// The workers of `stage`, or none if it does not compile.
    pub fn workers(&self, stage: &str) -> Option<Workers> {
        Some(Workers {
            own: self.own.get(stage)?.clone(),
            together: self.together.clone(),
        })
    }
}

/// The names of the stages that keep rays from going through whole scenes, if some do.
fn hitting(broken: &Broken) -> Option<String> {
    let names = HITTING_STAGES
        .iter()
        .filter(|stage| broken.crates.contains(**stage));
    let names: Vec<String> = names.map(|stage| format!("`{stage}`")).collect();
    (!names.is_empty()).then(|| names.join(" and "))
}

fn build(site: &BuildRoot, features: &[&str]) -> Result<Built, GraderError> {
    Build {
        root: site.root,
        features,
        target: site.target,
        sealed: site.sealed,
    }
    .run()
}
