//! The report of a run. It is built last, from the scores, the diagnosis and the times, and printed
//! as a [`table`] for people or as JSON for programs.

mod functions;
mod order;
mod speedups;
pub mod table;

use crate::diagnosis::Diagnosis;
use crate::error::{GraderError, without_path};
use crate::score::TaskResult;
use crate::speedup::Speedups;
use serde::Serialize;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The report of one run of the grader.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Core points earned.
    pub score: f64,
    /// Core points possible.
    pub max_score: f64,
    /// Robust points earned.
    pub robust_score: f64,
    /// Robust points possible.
    pub robust_max_score: f64,
    /// The tasks that were graded.
    pub tasks: Vec<TaskReport>,
    /// The speedups by the BVH of Part 2, if they were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speedups: Option<Speedups>,
}

/// The score of one task, and what explains it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TaskReport {
    /// The score.
    #[serde(flatten)]
    pub result: TaskResult,
    /// The known mistake that explains the wrong answers, if there is one.
    pub diagnosis: Option<Diagnosis>,
    /// What the wrong answers have in common, unless a known mistake likely explains them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub regularities: Vec<String>,
    /// A Rust test that reproduces the worst wrong answer.
    pub worst_as_test: Option<String>,
    /// The picture of the task: golden, the code's and their difference, if it was rendered.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub picture: Option<PathBuf>,
}

impl From<TaskResult> for TaskReport {
    /// A report without an explanation.
    fn from(result: TaskResult) -> TaskReport {
        TaskReport {
            result,
            diagnosis: None,
            regularities: Vec::new(),
            worst_as_test: None,
            picture: None,
        }
    }
}

impl Report {
    /// Adds up the scores of `tasks`.
    pub fn new(tasks: Vec<TaskReport>, speedups: Option<Speedups>) -> Report {
        let sum = |points: fn(&TaskResult) -> f64| {
            let points = tasks.iter().map(|task| points(&task.result));
            points.fold(0.0, |sum, points| sum + points)
        };
        Report {
            score: sum(|task| task.score),
            max_score: sum(|task| task.max_score),
            robust_score: sum(|task| task.robust_score),
            robust_max_score: sum(|task| task.robust_max_score),
            tasks,
            speedups,
        }
    }

    /// Whether every core point was earned.
    pub fn is_full(&self) -> bool {
        self.tasks
            .iter()
            .all(|task| task.result.score >= task.result.max_score)
    }
}

/// Formats a report as one JSON object.
pub fn json(report: &impl Serialize) -> Result<String, GraderError> {
    serde_json::to_string_pretty(report)
        .map_err(|e| GraderError::new(format!("cannot write the report as JSON: {e}")))
}

/// Writes `text` to the file `path` atomically: on an error the old file stays as it was.
pub fn write_whole(path: &Path, text: &[u8]) -> Result<(), GraderError> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let failed = |e: &std::io::Error| GraderError::file("write", path, without_path(e));
    let mut file = tempfile::Builder::new();
    // Temporary files are readable by their owner only; reports get the usual permissions.
    #[cfg(unix)]
    file.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = file.tempfile_in(folder).map_err(|e| failed(&e))?;
    file.write_all(text).map_err(|e| failed(&e))?;
    file.persist(path).map_err(|e| failed(&e.error))?;
    Ok(())
}
