//! Grading what a student handed in, apart from the student's own manifests, scripts and tests.
//!
//! [`read`] takes the stages' source files and nothing else, [`job`] puts them into a clean copy of the course, and
//! [`Judgement::of`] grades them: each stage among the reference's other stages, so that a mistake in one costs
//! nothing in another; and, if asked, all of the student's stages together. [`class`] does so for many.
//!
//! What the student's code does when it is built or run is limited in time and memory, but it is not locked in: it
//! runs with the rights of whoever grades it.

pub mod class;
pub mod file_tree;
pub mod job;
pub mod packages;
pub mod read;

use crate::file_tree::Files;
use grader::course::{Course, Task};
use grader::error::GraderError;
use grader::grade::{self, GradeRequest};
use grader::score::{CaseResult, Report, Status, TaskResult};
use grader::workspace::Workspace;
use job::Job;
use read::Submission;
use serde::Serialize;
use std::fmt::Write;
use std::path::Path;

/// What is to be said of a submission.
#[derive(Clone, Debug, Serialize)]
pub struct Judgement {
    /// The score that counts: each stage among the reference's.
    #[serde(flatten)]
    pub report: Report,
    /// The score of all of the student's stages together, if asked for.
    pub together: Option<Report>,
    /// Stages under test that were not handed in.
    pub missing: Vec<String>,
    /// Files that a submission may not bring.
    pub ignored: Vec<String>,
    /// Places in the student's code that reach for files or programs.
    pub reaches_out: Vec<String>,
    /// What the compiler said of stages that do not compile.
    pub compiler: String,
    /// What the student's code printed.
    pub printed: String,
}

impl Judgement {
    /// Grades `submission` in `job`.
    pub fn of(
        submission: &Submission,
        workspace: &Workspace,
        job: &Job,
        request: &GradeRequest,
        together: bool,
    ) -> Result<Judgement, GraderError> {
        let course = Course::read(workspace)?;
        let tasks = course.select(&request.what)?;
        let mut judgement = Judgement {
            report: Report::new(Vec::new()),
            together: None,
            missing: Vec::new(),
            ignored: submission
                .ignored
                .iter()
                .map(|path| path.display().to_string())
                .collect(),
            reaches_out: submission.reaches_out.clone(),
            compiler: String::new(),
            printed: String::new(),
        };
        let mut lost = Vec::new();
        let mut results = Vec::new();
        let mut sound = Vec::new();
        for stage in grade::stages(&tasks) {
            let of_stage = tasks.iter().copied().filter(|task| task.stage == stage);
            let Some(sources) = submission.stages.get(stage) else {
                judgement.missing.push(stage.to_string());
                lost.extend(of_stage.map(|task| without_answer(task, &Status::NotAttempted)));
                continue;
            };
            if !sources.contains_key(Path::new("lib.rs")) {
                let _ = writeln!(
                    judgement.compiler,
                    "stages/{stage}/src has no lib.rs, so there is nothing to build"
                );
                lost.extend(of_stage.map(|task| without_answer(task, &Status::DoesNotCompile)));
                continue;
            }
            let of_stage: Vec<&Task> = of_stage.collect();
            let site = job.with(&[(stage, sources)])?;
            let graded = grade::at(workspace, &course, &of_stage, request.seed, &site)?;
            judgement.compiler.push_str(&graded.compiler);
            judgement.printed.push_str(&graded.printed);
            results.extend(graded.report.tasks);
            sound.extend(of_stage);
        }
        judgement.report = report(results, &lost);
        if together {
            let all = submission
                .stages
                .iter()
                .filter(|(_, sources)| sources.contains_key(Path::new("lib.rs")));
            let all: Vec<(&str, &Files)> = all
                .map(|(stage, sources)| (stage.as_str(), sources))
                .collect();
            let site = job.with(&all)?;
            let graded = grade::at(workspace, &course, &sound, request.seed, &site)?;
            judgement.together = Some(report(graded.report.tasks, &lost));
        }
        Ok(judgement)
    }
}

/// The tasks that were graded and those that could not be, in order.
fn report(mut graded: Vec<TaskResult>, lost: &[TaskResult]) -> Report {
    graded.extend_from_slice(lost);
    graded.sort_by(|a, b| a.key.cmp(&b.key));
    Report::new(graded)
}

/// No points, for `status`.
fn without_answer(task: &Task, status: &Status) -> TaskResult {
    let cases = task
        .cases
        .iter()
        .map(|entry| CaseResult::new(entry, "", status.clone(), Vec::new()));
    TaskResult::new(task, cases.collect())
}
