//! Grades *empty* solutions, code without the idea of its task such as a traversal that tests every
//! primitive, and *half-written* ones.
//!
//! `grader/mutants/empty/TASK.txt` and `grader/mutants/half/TASK.txt` list them, in the format of
//! mutants. An empty one must get less than [`FAIR_SHARE`] of the core points and no extra credit,
//! a half-written one at least that share, so that points follow the point of the task.
//! `tests/empty_solutions.rs` tests this.

use super::corpus::{Corpus, Sources, reference_sources};
use super::run::{Kind, VersionsWorker, versions};
use super::versions_crate;
use base::{GraderError, Workspace};
use grader::course::{Course, Task};
use grader::score::TaskResult;
use judge::cases;
use rayon::prelude::*;

/// The share of a task's core points below which empty solutions are, and above which half-written
/// ones.
pub const FAIR_SHARE: f64 = 1.0 / 3.0;

/// A solution that is not one.
#[derive(Clone, Debug)]
pub struct Unfinished {
    /// Its name.
    pub name: String,
    /// Whether it is half-written; otherwise it is empty.
    pub is_half: bool,
    /// Its score.
    pub result: TaskResult,
}

/// Grades the empty and half-written solutions of the tasks of `stages`, with seed 0. One worker
/// contains all of them.
pub fn of_stages(
    workspace: &Workspace,
    course: &Course,
    stages: &[&str],
) -> Result<Vec<Unfinished>, GraderError> {
    workspace.ensure_full("it does not contain the lists of unfinished solutions")?;
    let mut listed: Vec<(&Task, usize, bool)> = Vec::new();
    let mut kinds = vec![("reference".to_string(), Kind::Correct)];
    let mut of_stages: Vec<(&str, Vec<Sources>)> = Vec::new();
    for &stage in stages {
        let mut sources = vec![reference_sources(workspace, stage)?];
        let of_stage = course.tasks().filter(|task| task.stage == stage);
        let lists = of_stage.flat_map(|task| [(task, "empty"), (task, "half")]);
        for (task, list) in lists {
            let folder = workspace.root().join("grader/mutants").join(list);
            let mutants = Corpus::read_unlisted(&folder, task)?;
            let (named, texts) = versions(workspace, task, mutants)?;
            for (named, text) in named.into_iter().zip(texts) {
                if matches!(named.1, Kind::Mutant(_)) {
                    listed.push((task, kinds.len(), list == "half"));
                    kinds.push(named);
                    sources.push(text);
                }
            }
        }
        of_stages.push((stage, sources));
    }
    let program = versions_crate::worker_of_stages(workspace, "empty", &of_stages)?;
    let worker = VersionsWorker::new(program, course, kinds);
    let specs = cases::all(0);
    let each = listed.into_par_iter().map(|(task, version, is_half)| {
        let graded = worker.grade_one(task, &specs, version, None)?;
        Ok(Unfinished {
            name: graded.name,
            is_half,
            result: graded.result,
        })
    });
    each.collect()
}
