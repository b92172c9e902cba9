//! Grades *empty* solutions: code without the idea of its task, such as a traversal that tests every
//! primitive, or direct light that is always black.
//!
//! `grader/mutants/empty/TASK.toml` lists them, in the format of mutants. Each must get less than
//! [`MAX_SHARE`] of the core points and no extra credit, so that points follow the point of the
//! task. `tests/empty_solutions.rs` tests this.

use super::corpus::{Corpus, Sources, reference_sources};
use super::run::{Kind, VersionsWorker, versions};
use super::versions_crate;
use grader::course::{Course, Task};
use grader::error::GraderError;
use grader::score::TaskResult;
use grader::workspace::Workspace;
use judge::cases;
use rayon::prelude::*;

/// An empty solution gets less than this share of a task's core points.
pub const MAX_SHARE: f64 = 1.0 / 3.0;

/// An empty solution and its score.
#[derive(Clone, Debug)]
pub struct Empty {
    /// Its name.
    pub name: String,
    /// Its score.
    pub result: TaskResult,
}

/// Grades the empty solutions of all tasks, with seed 0. One worker contains all of them.
pub fn all(workspace: &Workspace, course: &Course) -> Result<Vec<Empty>, GraderError> {
    workspace.ensure_full("it does not contain the list of empty solutions")?;
    let folder = workspace.root().join("grader/mutants/empty");
    let mut listed: Vec<(&Task, usize)> = Vec::new();
    let mut kinds = vec![("reference".to_string(), Kind::Correct)];
    let mut stages: Vec<(&str, Vec<Sources>)> = Vec::new();
    for stage in course.stages() {
        let mut sources = vec![reference_sources(workspace, stage)?];
        for task in course.tasks().filter(|task| task.stage == stage) {
            let mutants = Corpus::read_unlisted(&folder, task)?;
            let (named, texts) = versions(workspace, task, mutants)?;
            for (named, text) in named.into_iter().zip(texts) {
                if matches!(named.1, Kind::Mutant(_)) {
                    listed.push((task, kinds.len()));
                    kinds.push(named);
                    sources.push(text);
                }
            }
        }
        stages.push((stage, sources));
    }
    let program = versions_crate::worker_of_stages(workspace, "empty", &stages)?;
    let worker = VersionsWorker::new(program, course, kinds);
    let specs = cases::all(0);
    let each = listed.into_par_iter().map(|(task, version)| {
        let graded = worker.grade_one(task, &specs, version, None)?;
        Ok(Empty {
            name: graded.name,
            result: graded.result,
        })
    });
    each.collect()
}
