//! `grader look`: a page for students, with what is wrong in one task, and where.
//!
//! [`Look::of`] runs the cases of the task and compares its pictures, [`student_page`] formats
//! them, `lit_point` draws the rays of an estimate of light; a [`Sketch`] draws every other call.
//!
//! `grader review` uses the rest, too. [`case`] compares an answer with its golden, line by line
//! and, if the case has a [`picture`], pixel by pixel; [`calls`] are those that differ, each with
//! its cause. [`delta`], [`magnitude`] and [`box_walk`] say how much answers, colours and
//! traversals differ. [`page`] is what the pages of both consist of.

pub mod box_tests;
pub mod box_walk;
pub mod calls;
pub mod case;
pub mod delta;
mod lit_point;
pub mod magnitude;
pub mod page;
pub mod picture;
pub mod student_page;

use crate::case::Case;
use base::{GraderError, Workspace};
use grader::course::{Course, Task};
use grader::diagnosis::simplest::{self, SimplestCall};
use grader::diagnosis::{self, Diagnosis};
use grader::grade;
use grader::grade::picture::{self as task_picture, Rendered};
use grader::score::{CaseResult, Status, TaskResult};
use grader::sketch::Sketch;
use grader::workers::worker_set::WorkerSet;
use judge::Tier;
use judge::cases::Spec;
use judge::findings::Finding;
use judge::shown::ShownCall;
use wire::Answer;

/// What a student sees of one task.
#[derive(Clone, Debug)]
pub struct Look {
    /// The scores.
    pub result: TaskResult,
    /// The known mistake that explains the wrong answers, if there is one.
    pub diagnosis: Option<Diagnosis>,
    /// The simplest call that shows what is wrong, if there is one.
    pub simplest: Option<SimplestCall>,
    /// The task's picture, if it has one.
    pub picture: Option<Rendered>,
    /// The cases that lost points, in the order of the course.
    pub failed: Vec<FailedCase>,
}

/// A case that lost points.
#[derive(Clone, Debug)]
pub struct FailedCase {
    /// Its score and findings.
    pub result: CaseResult,
    /// The worst call, drawn as SVG with its key.
    pub figure: Option<String>,
    /// The comparison with the golden picture, if the case makes a picture.
    pub picture: Option<Case>,
}

impl Look {
    /// Runs the cases of `task` in `workers`.
    pub fn of(
        workspace: &Workspace,
        course: &Course,
        task: &Task,
        specs: &[Spec],
        workers: &WorkerSet,
    ) -> Result<Look, GraderError> {
        let Some(of_stage) = workers.workers(&task.stage) else {
            return Err(GraderError::new(format!(
                "`{}` does not compile: the compiler's messages are above",
                task.stage
            )));
        };
        let chosen = grade::chosen(&[task], specs)?;
        let endings = of_stage.run(&chosen, &mut Vec::new())?;
        let result = grade::score_tasks(course, &[task], &chosen, &endings)?.pop();
        let result =
            result.ok_or_else(|| GraderError::new("the task was graded without a result"))?;
        let mut failed = Vec::new();
        let cases = result.cases.iter().zip(&chosen).zip(&endings);
        for ((case, spec), ending) in cases {
            if matches!(case.status, Status::Passed | Status::NotAttempted)
                || case.is_only_reduced()
            {
                continue;
            }
            let answer = grade::answered(&task.key, ending, course)?.ok();
            let picture = match answer.filter(|_| spec.picture.is_some()) {
                Some(answer) => {
                    let together = &workers.whole_scene;
                    Some(Case::of(workspace, spec, case.tier, answer, together)?)
                }
                None => None,
            };
            failed.push(FailedCase {
                result: case.clone(),
                figure: answer.and_then(|answer| worst_call(case, spec, answer)),
                picture,
            });
        }
        let (simplest, diagnosis) = match result.status {
            Status::Passed | Status::NotAttempted => (None, None),
            _ => {
                let known = diagnosis::known(workspace, &task.key)?;
                let explain = |wrong_where: &[Vec<&str>]| {
                    diagnosis::explain(&result, &result.cases, &known, (specs, 0), wrong_where)
                };
                let (simplest, explanation) =
                    simplest::with_explanation(&of_stage, &result, specs, &explain)?;
                (simplest, explanation.diagnosis)
            }
        };
        Ok(Look {
            diagnosis,
            simplest,
            picture: task_picture::render(workspace, course, task, workers)?,
            failed,
            result,
        })
    }

    /// Whether every core point is earned.
    pub fn is_full(&self) -> bool {
        self.result.score >= self.result.max_score
    }
}

/// The drawing of the worst call of a case.
fn worst_call(case: &CaseResult, spec: &Spec, answer: &Answer) -> Option<String> {
    let wrong = case.findings.iter().filter(|finding| !finding.passed());
    let worst = wrong.filter_map(|finding: &Finding| finding.worst.as_ref());
    let call = worst.map(|worst| worst.call).next()?;
    match spec.shown(Tier::Core, call as usize, Some(answer))? {
        // From above, so that all rays are apart.
        ShownCall::LitPoint(point) => Some(lit_point::draw(&point)),
        call => Sketch::of(&call).map(|sketch| student_page::drawing(&sketch)),
    }
}
