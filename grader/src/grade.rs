//! A whole run: build the worker, run the cases, judge, add up.

use crate::cases::{self, Spec};
use crate::compile::{Build, Built};
use crate::course::{Course, Task, Tier};
use crate::diagnosis;
use crate::error::GraderError;
use crate::judge;
use crate::paste;
use crate::runner::Ending;
use crate::score::{CaseResult, Report, Status, TaskResult, status_without_answer};
use crate::signature::Signature;
use crate::speedup::{self, Speedups};
use crate::workers::Workers;
use crate::workspace::Workspace;
use std::path::Path;
use wire::Outcome;

/// What to grade.
#[derive(Clone, Debug)]
pub struct Order {
    /// `all`, a part or a task.
    pub what: String,
    /// Seed of the fresh random probes.
    pub seed: u64,
}

/// A report, and what was said meanwhile.
#[derive(Clone, Debug)]
pub struct Graded {
    /// The scores.
    pub report: Report,
    /// Printed by the student's code.
    pub printed: String,
    /// What the compiler said of stages that do not compile.
    pub compiler: String,
}

/// Where the code under test is built. Everything else (the course, the goldens) is the trusted workspace's.
#[derive(Clone, Copy, Debug)]
pub struct Site<'a> {
    /// The top folder of a workspace with a worker in it.
    pub root: &'a Path,
    /// Where cargo keeps what it builds, if not there.
    pub target: Option<&'a Path>,
    /// As [`Build::sealed`].
    pub sealed: bool,
}

impl Site<'_> {
    /// The workspace itself.
    fn of(workspace: &Workspace) -> Site<'_> {
        Site {
            root: workspace.root(),
            target: None,
            sealed: false,
        }
    }
}

/// Grades the code in `workspace` in place.
pub fn in_place(workspace: &Workspace, order: &Order) -> Result<Graded, GraderError> {
    let course = Course::read(workspace)?;
    let tasks = course.select(&order.what)?;
    at(workspace, &course, &tasks, order.seed, &Site::of(workspace))
}

/// Times the code in `workspace` in place; `None` if `what` is not about trees.
pub fn times(workspace: &Workspace, what: &str) -> Result<Option<Speedups>, GraderError> {
    let course = Course::read(workspace)?;
    if !speedup::belongs_to(&course.select(what)?) {
        return Ok(None);
    }
    speedup::measure(&course, &Site::of(workspace)).map(Some)
}

/// Grades `tasks` with the code that stands at `site`.
pub fn at(
    workspace: &Workspace,
    course: &Course,
    tasks: &[&Task],
    seed: u64,
    site: &Site,
) -> Result<Graded, GraderError> {
    let specs = cases::all(seed);
    let mut results = Vec::new();
    let mut printed = String::new();
    let mut compiler = String::new();
    let mut stages: Vec<&str> = tasks.iter().map(|task| task.stage.as_str()).collect();
    stages.sort_unstable();
    stages.dedup();
    for stage in stages {
        let tasks: Vec<&Task> = tasks
            .iter()
            .copied()
            .filter(|task| task.stage == stage)
            .collect();
        let build = Build {
            root: site.root,
            features: &[stage],
            target: site.target,
            sealed: site.sealed,
        };
        match build.run()? {
            Built::DoesNotCompile(messages) => {
                compiler.push_str(&messages);
                results.extend(tasks.iter().map(|task| does_not_compile(task)));
            }
            Built::Worker(program) => {
                let chosen = chosen(&tasks, &specs)?;
                let workers = Workers::new(program.into(), site, &chosen)?;
                let graded = grade_tasks(course, &tasks, &specs, &workers, &mut printed)?;
                results.extend(graded);
            }
        }
    }
    results.sort_by(|a, b| a.key.cmp(&b.key));
    for result in &mut results {
        let known = diagnosis::known(workspace, &result.key)?;
        result.worst_as_test = paste::worst(&result.cases, &specs, &result.key);
        result.diagnosis = diagnosis::diagnose(&known, &Signature::of(&result.cases));
    }
    Ok(Graded {
        report: Report::new(results),
        printed,
        compiler,
    })
}

/// The cases that `course.toml` lists for `tasks`, in its order.
fn chosen<'a>(tasks: &[&Task], specs: &'a [Spec]) -> Result<Vec<&'a Spec>, GraderError> {
    let listed = tasks
        .iter()
        .flat_map(|task| task.cases.iter().map(|entry| (&task.key, &entry.name)));
    listed
        .map(|(task, name)| {
            let spec = specs.iter().find(|spec| spec.is(task, name));
            spec.ok_or_else(|| {
                GraderError::new(format!(
                    "course.toml lists the case `{name}` of `{task}`, which the grader does not have"
                ))
            })
        })
        .collect()
}

/// Runs the cases of `tasks` in `workers` and scores them.
pub fn grade_tasks(
    course: &Course,
    tasks: &[&Task],
    specs: &[Spec],
    workers: &Workers,
    printed: &mut String,
) -> Result<Vec<TaskResult>, GraderError> {
    let chosen = chosen(tasks, specs)?;
    let endings = workers.run(&chosen, printed)?;
    let mut endings = chosen.iter().zip(&endings);
    let mut results = Vec::new();
    for task in tasks {
        let mut case_results = Vec::new();
        for entry in &task.cases {
            let (spec, ending) = endings
                .next()
                .ok_or_else(|| GraderError::new("the worker lost a case"))?;
            let (status, findings) = match ending {
                Err(broken) => {
                    let needs = format!("{broken}, which does not compile");
                    (Status::Needs(needs), Vec::new())
                }
                Ok(ending) => match status_without_answer(&task.key, ending, course)? {
                    Some(status) => (status, Vec::new()),
                    None => (Status::Passed, judged(spec, entry.tier, ending)),
                },
            };
            case_results.push(CaseResult::new(entry, spec.about, status, findings));
        }
        results.push(TaskResult::new(task, case_results));
    }
    Ok(results)
}

fn judged(spec: &Spec, tier: Tier, ending: &Ending) -> Vec<judge::tally::Finding> {
    match ending.outcome() {
        Some(Outcome::Answered(answer)) => judge::judge(spec, tier, answer),
        _ => Vec::new(),
    }
}

fn does_not_compile(task: &Task) -> TaskResult {
    let cases = task
        .cases
        .iter()
        .map(|entry| CaseResult::new(entry, "", Status::DoesNotCompile, Vec::new()));
    TaskResult::new(task, cases.collect())
}
