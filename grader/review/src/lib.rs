//! `grader review` shows the differences between the goldens and the answers of the current code on
//! a page. `grader bless` accepts them.
//!
//! Start at [`Review::add`]: a worker answers the cases. [`look::case`] compares each answer with
//! its golden. The exact oracle checks the answers independently of both. [`page`] writes the
//! result as one self-contained HTML file.

pub mod bless;
pub mod page;

use base::{GraderError, Workspace};
use grader::course::consistency;
use grader::course::{CaseEntry, Course, Task};
use grader::diagnosis::{self, Diagnosis};
use grader::grade;
use grader::grade::picture as task_picture;
use grader::report::table::status_text;
use grader::score::Status;
use grader::signature::Signature;
use grader::workers::worker_set::WorkerSet;
use judge::Tier;
use judge::cases::Spec;
use judge::pictures;
use look::case::{Case, State};
use pages::picture::read_png;
use std::collections::BTreeMap;
use submission::{clean_workspace::CleanWorkspace, read::Submission};

/// The comparison of goldens and answers.
#[derive(Clone, Debug, Default)]
pub struct Review {
    /// The compared cases in the order of the course; after those of a task its picture.
    pub cases: Vec<Case>,
    /// The known mistakes that the wrong answers look like, by tasks.
    pub diagnoses: BTreeMap<String, Diagnosis>,
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
    /// Runs the cases of `tasks` in `stage_workers` and adds the comparisons.
    pub fn add(
        &mut self,
        workspace: &Workspace,
        course: &Course,
        tasks: &[&Task],
        specs: &[Spec],
        stage_workers: &WorkerSet,
        author: &Author,
    ) -> Result<(), GraderError> {
        for task in tasks {
            let chosen = grade::chosen(&[task], specs)?;
            let Some(workers) = stage_workers.workers(&task.stage) else {
                self.add_without_answer(&chosen, &Status::DoesNotCompile);
                continue;
            };
            let endings = workers.run(&chosen, &mut Vec::new())?;
            let mut is_wrong = false;
            for ((entry, spec), ending) in task.cases.iter().zip(&chosen).zip(&endings) {
                let case = match grade::answered(&task.key, ending, course)? {
                    Err(status) => Case::silent(spec, status_text(&status)),
                    Ok(answer) => {
                        let tier = author.tier(entry);
                        Case::of(workspace, spec, tier, answer, &workers.whole_scene)?
                    }
                };
                is_wrong |=
                    matches!(&case.state, State::Differs { wrong, .. } if !wrong.is_empty());
                self.cases.push(case);
            }
            if is_wrong {
                let known = diagnosis::known(workspace, &task.key)?;
                for result in grade::score_tasks(course, &[task], &chosen, &endings)? {
                    let diagnosis = diagnosis::diagnose(&known, &Signature::of(&result.cases));
                    self.diagnoses
                        .extend(diagnosis.map(|diagnosis| (task.key.clone(), diagnosis)));
                }
            }
            let has_golden = workspace
                .golden_picture(&task.key, pictures::NAME)
                .is_file();
            if let Some(kind) = pictures::of(&task.key).filter(|_| has_golden) {
                let golden = read_png(&workspace.golden_picture(kind.task, pictures::NAME))?;
                self.cases.push(
                    match task_picture::of_code(course, task, &kind, stage_workers)? {
                        Ok(actual) => Case::of_task_picture(kind.task, golden, actual),
                        Err(status) => Case::silent(&kind.spec(), status_text(&status)),
                    },
                );
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
            let of_stage: Vec<&Task> = tasks
                .iter()
                .copied()
                .filter(|task| task.stage == stage)
                .collect();
            match submission.stages.get(stage) {
                None => review
                    .add_without_answer(&grade::chosen(&of_stage, specs)?, &Status::NotAttempted),
                Some(_) if !submission.why_not_built(stage).is_empty() => {
                    review.add_without_answer(
                        &grade::chosen(&of_stage, specs)?,
                        &Status::DoesNotCompile,
                    );
                }
                Some(sources) => {
                    let folder = clean.with_stages(&[(stage, sources)], None)?;
                    let workers = grade::workers(&folder.build_root(), &of_stage, specs, false)?;
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
