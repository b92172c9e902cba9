//! `grader review` shows the differences between the goldens and the answers of the current code on
//! a page. `grader bless` accepts them.
//!
//! Start at [`Review::add`]: a worker answers the cases. [`case`] compares each answer with its
//! golden, line by line and, if the case has a [`picture`], pixel by pixel, and finds the [`cause`]
//! of each difference. The [`exact`] oracle checks the answers independently of both. [`page`]
//! writes the result as one self-contained HTML file; [`columns`] and [`box_tests`] are its data
//! about pixels. [`look`] is the page for students.

pub mod bless;
pub mod box_tests;
pub mod case;
pub mod columns;
pub mod exact;
pub mod look;
pub mod page;
pub mod picture;

pub use pictures::cause;

use case::{Case, State};
use grader::consistency;
use grader::course::{CaseEntry, Course, Task};
use grader::error::GraderError;
use grader::grade;
use grader::report::table::status_text;
use grader::score::Status;
use grader::worker_set::WorkerSet;
use grader::workspace::Workspace;
use judge::Tier;
use judge::cases::Spec;
use std::path::Path;
use submission::clean_workspace::CleanWorkspace;
use submission::read::Submission;

/// The comparison of goldens and answers.
#[derive(Clone, Debug, Default)]
pub struct Review {
    /// The compared cases in the order of the course.
    pub cases: Vec<Case>,
}

/// Whose answers are reviewed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Author {
    /// The reference. Its answers are checked with the robust bounds.
    Reference,
    /// A student. The answers to each case are checked with the bounds of its tier.
    Student(String),
}

impl Author {
    /// The tier whose bounds the answers to a case must meet.
    fn tier(&self, entry: &CaseEntry) -> Tier {
        match self {
            Author::Reference => Tier::Robust,
            Author::Student(_) => entry.tier,
        }
    }
}

impl Review {
    /// Runs the cases of `tasks` in `workers` and adds the comparisons.
    pub fn add(
        &mut self,
        workspace: &Workspace,
        course: &Course,
        tasks: &[&Task],
        specs: &[Spec],
        workers: &WorkerSet,
        author: &Author,
    ) -> Result<(), GraderError> {
        for task in tasks {
            let chosen = grade::chosen(&[task], specs)?;
            let Some(workers) = workers.workers(&task.stage) else {
                self.add_without_answer(&chosen, &Status::DoesNotCompile);
                continue;
            };
            let endings = workers.run(&chosen, &mut Vec::new())?;
            for ((entry, spec), ending) in task.cases.iter().zip(chosen).zip(&endings) {
                let case = match grade::answered(&task.key, ending, course)? {
                    Err(status) => Case::silent(spec, status_text(&status)),
                    Ok(answer) => {
                        let tier = author.tier(entry);
                        Case::of(workspace, spec, tier, answer, &workers.whole_scene)?
                    }
                };
                self.cases.push(case);
            }
        }
        Ok(())
    }

    /// Reviews a student's stages, each together with the reference's other stages.
    pub fn of_submission(
        workspace: &Workspace,
        course: &Course,
        tasks: &[&Task],
        specs: &[Spec],
        submission: &Submission,
        clean: &CleanWorkspace,
        author: &Author,
    ) -> Result<Review, GraderError> {
        let mut review = Review::default();
        for stage in grade::stages(tasks) {
            let of_stage = tasks.iter().copied().filter(|task| task.stage == stage);
            let of_stage: Vec<&Task> = of_stage.collect();
            match submission.stages.get(stage) {
                None => review
                    .add_without_answer(&grade::chosen(&of_stage, specs)?, &Status::NotAttempted),
                Some(sources) if !sources.contains_key(Path::new("lib.rs")) => {
                    review.add_without_answer(
                        &grade::chosen(&of_stage, specs)?,
                        &Status::DoesNotCompile,
                    );
                }
                Some(sources) => {
                    let build_root = clean.with_stages(&[(stage, sources)])?;
                    let workers = grade::workers(&build_root, &of_stage, specs, false)?;
                    review.add(workspace, course, &of_stage, specs, &workers, author)?;
                }
            }
        }
        review.cases.sort_by_key(|case| case.task);
        Ok(review)
    }

    /// Adds cases without answers, with the status as the reason.
    fn add_without_answer(&mut self, specs: &[&Spec], status: &Status) {
        let cases = specs
            .iter()
            .map(|spec| Case::silent(spec, status_text(status)));
        self.cases.extend(cases);
    }

    /// Whether every case has an answer and every answer equals its golden.
    pub fn is_same(&self) -> bool {
        self.cases.iter().all(|case| case.state == State::Same)
    }
}

/// Returns an error if a case has no golden.
pub fn check_goldens(
    workspace: &Workspace,
    tasks: &[&Task],
    specs: &[Spec],
) -> Result<(), GraderError> {
    let missing: Vec<String> = grade::chosen(tasks, specs)?
        .into_iter()
        .filter_map(|spec| consistency::missing_golden(workspace, spec))
        .collect();
    match missing.split_first() {
        None => Ok(()),
        Some((first, [])) => Err(GraderError::new(first)),
        Some((first, more)) => Err(GraderError::new(format!(
            "{first}. ({} more goldens are missing.)",
            more.len()
        ))),
    }
}
