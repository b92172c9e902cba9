//! Grades one submission: what a run over a class calls for each folder.

use crate::SubmissionReport;
use crate::clean_workspace::CleanWorkspace;
use crate::containment::Containment;
use crate::control;
pub use crate::not_graded::NotGraded;
use crate::read::Submission;
use base::{GraderError, Workspace};
use grader::build::BuildLimit;
use grader::course::{Course, Task};
use grader::grade::GradeRequest;
use std::hash::{BuildHasher, Hasher, RandomState};
use std::path::Path;

/// The course that submissions are graded against. Threads may share it: each submission has files
/// of its own.
#[derive(Debug)]
pub struct GradingCourse {
    workspace: Workspace,
    course: Course,
    clean: CleanWorkspace,
}

impl GradingCourse {
    /// Reads the course of `workspace` and builds what all submissions share, if it is not built
    /// yet.
    pub fn open(
        workspace: &Workspace,
        containment: Containment,
    ) -> Result<GradingCourse, GraderError> {
        Ok(GradingCourse {
            course: Course::read(workspace)?,
            clean: CleanWorkspace::open(workspace, containment)?,
            workspace: workspace.clone(),
        })
    }

    /// Builds and grades the course's own first stage of `request` as submissions are: if that fails,
    /// this machine cannot grade.
    pub fn ensure_that_it_grades(&self, request: &GradeRequest) -> Result<(), GraderError> {
        let tasks = self.course.select(&request.what)?;
        let stage = tasks.first().map(|task| &task.stage);
        let tasks: Vec<&Task> = (tasks.iter().copied())
            .filter(|task| Some(&task.stage) == stage)
            .collect();
        control::grade(
            &self.workspace,
            &self.clean,
            &self.course,
            &tasks,
            request.seed,
        )
    }

    /// The same course with another program in place of the compiler. For tests.
    pub fn with_compiler(self, program: &Path) -> GradingCourse {
        let clean = self.clean.with_compiler(program);
        GradingCourse { clean, ..self }
    }

    /// What all submissions share.
    pub fn clean(&self) -> &CleanWorkspace {
        &self.clean
    }

    /// The list of parts and tasks.
    pub fn course(&self) -> &Course {
        &self.course
    }

    /// How the code of submissions is contained.
    pub fn containment(&self) -> &Containment {
        self.clean.containment()
    }
}

/// A seed that cannot be known before: answers that were learned by heart do not fit its cases.
pub fn random_seed() -> u64 {
    // Short enough to be typed. Not 0: students know the cases of seed 0.
    let drawn = RandomState::new().build_hasher().finish();
    drawn % u64::from(u32::MAX) + 1
}

/// What to grade, and how.
#[derive(Clone, Debug)]
pub struct Options {
    /// The part or task, and the seed of the cases.
    pub request: GradeRequest,
    /// Also grades all stages of the submission linked together.
    pub together: bool,
    /// Also renders the pictures of tasks that lost core points.
    pub pictures: bool,
}

/// How a submission that was graded ended. It has a score in every case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// At least one of its stages was built, and its cases were judged.
    Graded,
    /// None of the stages that were handed in compiles.
    DoesNotCompile,
    /// Building it exceeded a limit.
    OverLimit(BuildLimit),
}

/// A submission with its scores.
#[derive(Clone, Debug)]
pub struct GradedSubmission {
    /// How it ended.
    pub outcome: Outcome,
    /// The scores, and what explains them.
    pub report: SubmissionReport,
}

/// Grades the submission in `folder`.
pub fn grade_one(
    course: &GradingCourse,
    folder: &Path,
    options: &Options,
) -> Result<GradedSubmission, NotGraded> {
    let submission = Submission::read(folder, &course.course, course.workspace.root())?;
    Ok(grade_read(course, &submission, options)?)
}

/// Grades a submission that was read. An error is the machine's or the course's.
pub fn grade_read(
    course: &GradingCourse,
    submission: &Submission,
    options: &Options,
) -> Result<GradedSubmission, GraderError> {
    let report = SubmissionReport::of(submission, &course.workspace, &course.clean, options)?;
    Ok(GradedSubmission {
        outcome: outcome(&report),
        report,
    })
}

fn outcome(report: &SubmissionReport) -> Outcome {
    use grader::score::Status;
    let handed_in = report.scores.tasks.iter().map(|task| &task.result.status);
    if let Some(limit) = report.limit {
        return Outcome::OverLimit(limit);
    }
    let mut handed_in = handed_in.filter(|status| **status != Status::NotAttempted);
    let compiles = |status: &Status| *status != Status::DoesNotCompile;
    match report.compiler.is_empty() || handed_in.any(compiles) {
        true => Outcome::Graded,
        false => Outcome::DoesNotCompile,
    }
}
