//! From findings to points.

use crate::course::{CaseEntry, Course, Task};
use crate::diagnosis::Diagnosis;
use crate::error::GraderError;
use crate::runner::Ending;
use crate::speedup::Speedups;
use judge::Tier;
use judge::tally::{Aspect, Finding, Worst};
use serde::Serialize;
use wire::Outcome;

/// How a task or a case stands.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "status", content = "detail")]
pub enum Status {
    /// Every point.
    Passed,
    /// Points were lost.
    Failed,
    /// The code is still a hole or the given start.
    NotAttempted,
    /// Another task must be written first: its key.
    Needs(String),
    /// The code panicked, hung or died, or its worker's record is malformed: how.
    Crashed(String),
    /// The stage does not compile.
    DoesNotCompile,
}

/// The result of one case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaseResult {
    /// As in `course.toml`.
    pub name: String,
    /// Whose points it gives.
    pub tier: Tier,
    /// Points earned.
    pub score: f64,
    /// Points there are.
    pub max_score: f64,
    /// How it stands.
    #[serde(flatten)]
    pub status: Status,
    /// What the case checks.
    pub about: String,
    /// What was found, aspect by aspect.
    pub findings: Vec<Finding>,
    /// Whether it is made with other stages, too, whose mistakes may show.
    #[serde(skip)]
    pub with_neighbours: bool,
}

/// The result of one task. Core and robust points are apart.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TaskResult {
    /// As in `course.toml`.
    pub key: String,
    /// For people.
    pub title: String,
    /// Core points earned.
    pub score: f64,
    /// Core points there are.
    pub max_score: f64,
    /// Robust points earned.
    pub robust_score: f64,
    /// Robust points there are.
    pub robust_max_score: f64,
    /// How it stands.
    #[serde(flatten)]
    pub status: Status,
    /// The crate below `stages/` that it is written in.
    pub stage: String,
    /// What its wrong answers look like, if they look like a known mistake.
    pub diagnosis: Option<Diagnosis>,
    /// The worst wrong answer as a Rust test.
    pub worst_as_test: Option<String>,
    /// Its cases.
    pub cases: Vec<CaseResult>,
}

/// The result of a run of the grader.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Core points earned.
    pub score: f64,
    /// Core points there are.
    pub max_score: f64,
    /// Robust points earned.
    pub robust_score: f64,
    /// Robust points there are.
    pub robust_max_score: f64,
    /// The tasks that were graded.
    pub tasks: Vec<TaskResult>,
    /// What the tree of Part 2 saves, if it was timed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speedups: Option<Speedups>,
}

impl CaseResult {
    /// Scores a case by the share of its points that `findings` earn.
    pub fn new(
        entry: &CaseEntry,
        about: &str,
        status: Status,
        findings: Vec<Finding>,
    ) -> CaseResult {
        let share = share_earned(&findings);
        let status = if status == Status::Passed && share < 1.0 {
            Status::Failed
        } else {
            status
        };
        let score = if matches!(status, Status::Passed | Status::Failed) {
            entry.points * share
        } else {
            0.0
        };
        CaseResult {
            name: entry.name.clone(),
            tier: entry.tier,
            score,
            max_score: entry.points,
            status,
            about: about.into(),
            findings,
            with_neighbours: false,
        }
    }

    /// The aspect that failed worst, if one did.
    pub fn worst(&self) -> Option<(&Finding, &Worst)> {
        self.findings
            .iter()
            .find_map(|finding| finding.worst.as_ref().map(|worst| (finding, worst)))
    }
}

/// The share of a case's points that was earned. The aspects that the case can show share them evenly, but for two that
/// weigh as much as all others together: hit or miss, without which they mean little, and work, which a tree is for.
fn share_earned(findings: &[Finding]) -> f64 {
    let weight = |finding: &Finding| match finding.aspect {
        Aspect::Decision | Aspect::Work => (findings.len() - 1).max(1),
        _ => 1,
    };
    let all: usize = findings.iter().map(weight).sum();
    let earned: usize = findings
        .iter()
        .filter(|finding| finding.passed())
        .map(weight)
        .sum();
    if all == 0 {
        0.0
    } else {
        earned as f64 / all as f64
    }
}

impl TaskResult {
    /// Adds up a task.
    pub fn new(task: &Task, cases: Vec<CaseResult>) -> TaskResult {
        let sum = |tier: Tier| {
            cases
                .iter()
                .filter(|case| case.tier == tier)
                .map(|case| case.score)
                .fold(0.0, |sum, points| sum + points)
        };
        let status = if cases.iter().all(|case| case.status == Status::Passed) {
            Status::Passed
        } else if let Some(first) = cases
            .first()
            .filter(|first| cases.iter().all(|case| case.status == first.status))
        {
            first.status.clone()
        } else {
            Status::Failed
        };
        TaskResult {
            key: task.key.clone(),
            title: task.title.clone(),
            score: sum(Tier::Core),
            max_score: task.points(Tier::Core),
            robust_score: sum(Tier::Robust),
            robust_max_score: task.points(Tier::Robust),
            status,
            stage: task.stage.clone(),
            diagnosis: None,
            worst_as_test: None,
            cases,
        }
    }
}

impl Report {
    /// Adds up a run.
    pub fn new(tasks: Vec<TaskResult>) -> Report {
        let sum = |points: fn(&TaskResult) -> f64| {
            tasks
                .iter()
                .map(points)
                .fold(0.0, |sum, points| sum + points)
        };
        Report {
            score: sum(|task| task.score),
            max_score: sum(|task| task.max_score),
            robust_score: sum(|task| task.robust_score),
            robust_max_score: sum(|task| task.robust_max_score),
            tasks,
            speedups: None,
        }
    }

    /// Whether every core point was earned.
    pub fn is_full(&self) -> bool {
        self.tasks.iter().all(|task| task.score >= task.max_score)
    }
}

/// What an ending that brought no answer means for a case of `task`; `None` if there is an answer to judge.
pub fn status_without_answer(
    task: &str,
    ending: &Ending,
    course: &Course,
) -> Result<Option<Status>, GraderError> {
    Ok(match ending {
        Ending::TimedOut { call, limit_ms } => Some(Status::Crashed(format!(
            "did not come back within {} s (call {call} of the case): an endless loop?",
            *limit_ms as f64 / 1e3
        ))),
        Ending::Died(how) | Ending::Malformed(how) => Some(Status::Crashed(how.clone())),
        Ending::Skipped => {
            return Err(GraderError::new(format!(
                "a case of {task} was skipped, as only timings are"
            )));
        }
        Ending::Recorded(record) if record.untouched.iter().any(|key| key == task) => {
            Some(Status::NotAttempted)
        }
        Ending::Recorded(record) => match &record.outcome {
            Outcome::Answered(_) => None,
            Outcome::NotAttempted { task: hole } if hole == task => Some(Status::NotAttempted),
            Outcome::NotAttempted { task: hole } if course.holes().any(|(_, key)| key == hole) => {
                Some(Status::Needs(hole.clone()))
            }
            Outcome::NotAttempted { task: hole } => Some(Status::Crashed(format!(
                "the worker's record names the hole {hole:?}, which is none of the course"
            ))),
            Outcome::Panicked {
                message,
                location,
                call,
            } => Some(Status::Crashed(format!(
                "panicked at {location}: {message} (call {call} of the case)"
            ))),
            Outcome::Unable { reason } => {
                return Err(GraderError::new(format!(
                    "a case of {task} could not run: {reason}"
                )));
            }
        },
    })
}
