//! The report of a run. It is built last, from the scores, the diagnosis and the times, and printed
//! as one [`screen`] or a long [`table`] for people, or as JSON for programs.

mod functions;
pub(crate) mod message;
mod order;
pub mod screen;
mod speedups;
pub mod table;
pub mod terminal;
pub mod worst_test;
pub(crate) mod wrap;

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
    /// What the wrong answers have in common.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub regularities: Vec<String>,
    /// A Rust test that reproduces the worst wrong answer.
    pub worst_as_test: Option<String>,
    /// The file that this test was written to, below the workspace's root folder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub test_file: Option<PathBuf>,
    /// The picture of the task, below the workspace's root folder: golden, the code's and their
    /// difference, if it was rendered.
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
            test_file: None,
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

/// How much a report for people reveals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reveal {
    /// What it says about wrong answers.
    pub hint: HintLevel,
    /// Whether it shows what extra credit lost, too.
    pub extra: bool,
}

/// How much the report reveals about wrong answers, from the least to the most.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum HintLevel {
    /// What each failed case tests.
    Cases,
    /// Also which fields of the answers are wrong, what the wrong answers have in common, the worst
    /// ray and a Rust test that reproduces it, and why simple formulas often fail there.
    Findings,
    /// Also the likely mistake, if it is a known one.
    Mistake,
    /// Also where to look for it.
    Remedy,
}

impl HintLevel {
    /// All levels, from 1 on.
    pub const ALL: [HintLevel; 4] = [
        HintLevel::Cases,
        HintLevel::Findings,
        HintLevel::Mistake,
        HintLevel::Remedy,
    ];

    /// Its number, counted from 1.
    pub fn number(self) -> usize {
        self as usize + 1
    }

    /// The next level, if there is one.
    pub fn next(self) -> Option<HintLevel> {
        HintLevel::ALL.get(self.number()).copied()
    }

    /// What it adds to the level before it.
    pub fn adds(self) -> &'static str {
        match self {
            HintLevel::Cases => "what each failed case tests",
            HintLevel::Findings => "what is wrong, and the worst ray",
            HintLevel::Mistake => "the likely mistake",
            HintLevel::Remedy => "where to look",
        }
    }
}

/// Formats a report as one JSON object.
pub fn json(report: &impl Serialize) -> Result<String, GraderError> {
    serde_json::to_string_pretty(report)
        .map_err(|e| GraderError::new(format!("cannot write the report as JSON: {e}")))
}

/// The folder that the new file or folder `path` is written to. Fails if it does not exist.
pub fn folder_of(path: &Path) -> Result<&Path, GraderError> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    if folder.is_dir() {
        return Ok(folder);
    }
    let cause = match folder.exists() {
        true => format!("{} is not a folder. Name another place", folder.display()),
        false => format!(
            "there is no folder {}. Create it first, or name another place",
            folder.display()
        ),
    };
    Err(GraderError::file("write", path, cause))
}

/// Writes `text` to the file `path` atomically: on an error the old file stays as it was.
pub fn write_whole(path: &Path, text: &[u8]) -> Result<(), GraderError> {
    let folder = folder_of(path)?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_is_written_only_to_a_folder_that_exists() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let missing = folder.path().join("missing");
        let error = write_whole(&missing.join("a.html"), b"").expect_err("no folder");
        let expected = format!("there is no folder {}. Create it first", missing.display());
        assert!(error.to_string().contains(&expected), "{error}");
        write_whole(&missing, b"").expect("a file");
        let error = write_whole(&missing.join("a.html"), b"").expect_err("a file");
        assert!(error.to_string().contains("is not a folder"), "{error}");
    }
}
