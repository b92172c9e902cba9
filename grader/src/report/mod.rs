//! The report of a run. It is built last, from the scores, the diagnosis and the times, and printed
//! as one [`screen`] or a long [`table`] for people, or as JSON for programs.

pub mod claims;
mod functions;
pub mod links;
pub mod message;
pub mod screen;
mod speedups;
pub mod table;
pub mod terminal;
pub mod worst_test;
pub(crate) mod wrap;

use crate::diagnosis::Diagnosis;
use crate::diagnosis::simplest::SimplestCall;
use crate::grade::speedup::Speedups;
use crate::score::TaskResult;
use crate::score::regularity::Regularity;
use base::GraderError;
use serde::Serialize;
use std::path::PathBuf;

/// The report of one run of the grader.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The version of the course and of the grader.
    pub version: &'static str,
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
    /// Its functions that no case judges: the points say nothing about them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub not_judged: Vec<String>,
    /// The known mistake that explains the wrong answers, if there is one.
    pub diagnosis: Option<Diagnosis>,
    /// What the wrong answers have in common.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub regularities: Vec<Regularity>,
    /// The simplest call that shows what is wrong, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub simplest: Option<SimplestCall>,
    /// A Rust test that reproduces this call, or else the worst wrong answer.
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
            not_judged: Vec::new(),
            diagnosis: None,
            regularities: Vec::new(),
            simplest: None,
            worst_as_test: None,
            test_file: None,
            picture: None,
        }
    }
}

/// A sentence about each task with functions that no case judges.
fn not_judged(report: &Report) -> impl Iterator<Item = String> {
    let tasks = report
        .tasks
        .iter()
        .filter(|task| !task.not_judged.is_empty());
    tasks.map(|task| {
        format!(
            "not judged: {} of {}, which is beyond the course",
            task.not_judged.join(", "),
            task.result.key
        )
    })
}

impl Report {
    /// Adds up the scores of `tasks`.
    pub fn new(tasks: Vec<TaskReport>, speedups: Option<Speedups>) -> Report {
        let sum = |points: fn(&TaskResult) -> f64| {
            let points = tasks.iter().map(|task| points(&task.result));
            points.fold(0.0, |sum, points| sum + points)
        };
        Report {
            version: base::VERSION,
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
        self.tasks.iter().all(|task| task.result.is_complete())
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
            HintLevel::Findings => "what is wrong, and a simple wrong call",
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
