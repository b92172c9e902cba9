//! What a run of the grader came to.

use crate::annotation::Annotation;
use grader::report::{Report, Reveal, TaskReport, table};
use grader::score::Status;

/// What a run of the grader came to.
#[derive(Clone, Debug)]
pub enum Outcome {
    /// The code was graded.
    Graded(Box<Graded>),
    /// What was handed in cannot be graded, and the student can mend that: it is not a submission, or
    /// has a file that a submission may not contain.
    Refused {
        /// What is wrong.
        why: String,
        /// The core points that were to be had.
        max_score: f64,
    },
    /// The grader failed, for a reason that is not the fault of the code: this says which. It is
    /// never worth zero points: somebody has to look at it.
    Infrastructure(String),
}

/// Code that was graded.
#[derive(Clone, Debug)]
pub struct Graded {
    /// What was graded: `all`, a part or a task.
    pub what: String,
    /// The scores.
    pub report: Report,
    /// The whole report as JSON, as `--format json` prints it.
    pub json: String,
    /// How much the texts reveal.
    pub reveal: Reveal,
    /// What is said besides the tasks, such as ignored files and the compiler's messages. Empty if
    /// there is nothing.
    pub notes: String,
    /// Remarks about lines of the code.
    pub annotations: Vec<Annotation>,
}

impl Graded {
    /// What the report says about one task, at the chosen level.
    pub fn task_text(&self, task: &TaskReport) -> String {
        table::task_text(task, self.reveal)
    }

    /// Whether no task compiles.
    pub fn nothing_compiles(&self) -> bool {
        let mut tasks = self.report.tasks.iter().peekable();
        tasks.peek().is_some() && tasks.all(|task| task.result.status == Status::DoesNotCompile)
    }
}

/// The title of a task with its key: "part1.task3 Intersecting triangles".
pub(crate) fn name(task: &TaskReport) -> String {
    format!("{} {}", task.result.key, task.result.title)
}

/// The first sentence about an infrastructure failure, in every format.
pub(crate) const NOT_GRADED: &str =
    "This submission was not graded: the grader failed. This is not the fault of the code.";

/// The first sentence about a submission that cannot be graded, in every format.
pub(crate) const REFUSED: &str = "This submission cannot be graded.";
