//! `grader review`: what changed between the goldens and what the code answers now, as a page for a person to judge.
//!
//! Follow [`Review::add`]: a worker answers the cases, [`case`] compares each answer with its golden, line by line
//! and, where there is a [`picture`], pixel by pixel, with the [`cause`] of each difference. The [`exact`] oracle says
//! apart from both who is right. [`page`] writes it all as one HTML file that needs nothing but itself; [`columns`]
//! and [`boxes`] are what it holds of every pixel.

pub mod bless;
pub mod boxes;
pub mod case;
pub mod cause;
pub mod columns;
pub mod exact;
pub mod page;
pub mod picture;

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

/// Goldens against answers, case by case.
#[derive(Clone, Debug, Default)]
pub struct Review {
    /// In the order of the course.
    pub cases: Vec<Case>,
}

/// Whose answers are reviewed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Author {
    /// The reference's, which must satisfy the oracle at the robust bounds.
    Reference,
    /// A student's: the oracle asks of each case what its points ask.
    Student(String),
}

impl Author {
    /// What the oracle asks of a case.
    fn tier(&self, entry: &CaseEntry) -> Tier {
        match self {
            Author::Reference => Tier::Robust,
            Author::Student(_) => entry.tier,
        }
    }
}

impl Review {
    /// Adds the cases of `tasks`, answered by `workers`.
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
                self.lost(&chosen, &Status::DoesNotCompile);
                continue;
            };
            let endings = workers.run(&chosen, &mut String::new())?;
            for ((entry, spec), ending) in task.cases.iter().zip(chosen).zip(&endings) {
                let case = match grade::answered(&task.key, ending, course)? {
                    Err(status) => Case::silent(spec, status_text(&status)),
                    Ok(answer) => {
                        let tier = author.tier(entry);
                        Case::of(workspace, spec, tier, answer, &workers.together)?
                    }
                };
                self.cases.push(case);
            }
        }
        Ok(())
    }

    /// Reviews a student's stages, each among the reference's others.
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
                None => review.lost(&grade::chosen(&of_stage, specs)?, &Status::NotAttempted),
                Some(sources) if !sources.contains_key(Path::new("lib.rs")) => {
                    review.lost(&grade::chosen(&of_stage, specs)?, &Status::DoesNotCompile);
                }
                Some(sources) => {
                    let site = clean.with_stages(&[(stage, sources)])?;
                    let workers = grade::workers(&site, &of_stage, specs, false)?;
                    review.add(workspace, course, &of_stage, specs, &workers, author)?;
                }
            }
        }
        review.cases.sort_by_key(|case| case.task);
        Ok(review)
    }

    /// Adds cases without answers.
    fn lost(&mut self, specs: &[&Spec], status: &Status) {
        let cases = specs
            .iter()
            .map(|spec| Case::silent(spec, status_text(status)));
        self.cases.extend(cases);
    }

    /// Whether every case has an answer, and every answer is the golden's.
    pub fn is_same(&self) -> bool {
        self.cases.iter().all(|case| case.state == State::Same)
    }
}

/// Refuses to review cases whose golden is missing.
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
            "{first}. (So it is with {} more.)",
            more.len()
        ))),
    }
}
