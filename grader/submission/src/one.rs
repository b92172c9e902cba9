//! Grades one submission: what a run over a class calls for each folder.

use crate::SubmissionReport;
use crate::clean_workspace::CleanWorkspace;
use crate::read::Submission;
use grader::course::Course;
use grader::error::GraderError;
use grader::grade::GradeRequest;
use grader::workspace::Workspace;
use std::fmt;
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
    pub fn open(workspace: &Workspace) -> Result<GradingCourse, GraderError> {
        Ok(GradingCourse {
            course: Course::read(workspace)?,
            clean: CleanWorkspace::open(workspace)?,
            workspace: workspace.clone(),
        })
    }

    /// The list of parts and tasks.
    pub fn course(&self) -> &Course {
        &self.course
    }
}

/// What to grade, and how.
#[derive(Clone, Debug)]
pub struct Options {
    /// The part or task, and the seed of the cases.
    pub request: GradeRequest,
    /// Also grades all stages of the submission linked together.
    pub together: bool,
}

/// How a submission that was graded ended. It has a score in every case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// At least one of its stages was built, and its cases were judged.
    Graded,
    /// None of the stages that were handed in compiles.
    DoesNotCompile,
    /// Building it exceeded a limit.
    OverLimit(Limit),
}

/// The limits on building a submission. The limits of a case are a result of the case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// Processor time or elapsed time of the compiler.
    CompileTime,
    /// Memory of the compiler, or the size of a file that it writes.
    CompileMemory,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Limit::CompileTime => "time of the compiler",
            Limit::CompileMemory => "memory of the compiler",
        })
    }
}

/// A submission with its scores.
#[derive(Clone, Debug)]
pub struct GradedSubmission {
    /// How it ended.
    pub outcome: Outcome,
    /// The scores, and what explains them.
    pub report: SubmissionReport,
}

/// Why a submission has no score. The text is a sentence for the person who grades.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotGraded {
    /// The folder is not a submission, or has a file that a submission may not contain. Grading it
    /// again does not help.
    Refused(String),
    /// The machine or the course failed, not the submission: a full disk, for example. It may
    /// succeed if it is tried again.
    Infrastructure(String),
}

impl fmt::Display for NotGraded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (NotGraded::Refused(why) | NotGraded::Infrastructure(why)) = self;
        f.write_str(why)
    }
}

impl std::error::Error for NotGraded {}

/// Grades the submission in `folder`.
pub fn grade_one(
    course: &GradingCourse,
    folder: &Path,
    options: &Options,
) -> Result<GradedSubmission, NotGraded> {
    let submission = Submission::read(folder, &course.course, course.workspace.root());
    let submission = submission.map_err(|why| NotGraded::Refused(why.to_string()))?;
    let report = SubmissionReport::of(
        &submission,
        &course.workspace,
        &course.clean,
        &options.request,
        options.together,
    );
    let report = report.map_err(|why| NotGraded::Infrastructure(why.to_string()))?;
    Ok(GradedSubmission {
        outcome: outcome(&report),
        report,
    })
}

fn outcome(report: &SubmissionReport) -> Outcome {
    use grader::score::Status;
    let handed_in = report.scores.tasks.iter().map(|task| &task.result.status);
    let mut handed_in = handed_in.filter(|status| **status != Status::NotAttempted);
    let compiles = |status: &Status| *status != Status::DoesNotCompile;
    match report.compiler.is_empty() || handed_in.any(compiles) {
        true => Outcome::Graded,
        false => Outcome::DoesNotCompile,
    }
}
