//! Turns the findings about answers into points.

use crate::course::{CaseEntry, Task};
use crate::crash::Crash;
use judge::Tier;
use judge::tally::{Aspect, Finding, Worst};
use serde::Serialize;

/// The status of a task or a case.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "status", content = "detail")]
pub enum Status {
    /// Every point was earned.
    Passed,
    /// Points were lost.
    Failed,
    /// The function is still the one of the handout.
    NotAttempted,
    /// Another task must be written first. Contains its key.
    Needs(String),
    /// The code panicked, timed out or ended the process, or its worker's record is malformed.
    /// Contains a description.
    Crashed(String),
    /// The stage does not compile.
    DoesNotCompile,
}

/// The result of one case.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CaseResult {
    /// Its name in `course.toml`.
    pub name: String,
    /// Whether its points are core or robust points.
    pub tier: Tier,
    /// Points earned.
    pub score: f64,
    /// Points possible.
    pub max_score: f64,
    /// Its status.
    #[serde(flatten)]
    pub status: Status,
    /// What the case tests.
    pub about: String,
    /// The findings about its answers, one for each aspect.
    pub findings: Vec<Finding>,
    /// Whether it also runs other stages. Their mistakes may affect its answers.
    #[serde(skip)]
    pub with_neighbours: bool,
    /// The number of its calls.
    #[serde(skip)]
    pub calls: usize,
    /// How its code crashed, if it did.
    #[serde(skip)]
    pub crash: Option<Crash>,
}

/// The result of one task. Core and robust points are counted separately.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TaskResult {
    /// Its key in `course.toml`.
    pub key: String,
    /// Its title.
    pub title: String,
    /// Core points earned.
    pub score: f64,
    /// Core points possible.
    pub max_score: f64,
    /// Robust points earned.
    pub robust_score: f64,
    /// Robust points possible.
    pub robust_max_score: f64,
    /// Its status.
    #[serde(flatten)]
    pub status: Status,
    /// The crate below `stages/` that has its functions.
    pub stage: String,
    /// Its cases.
    pub cases: Vec<CaseResult>,
}

impl CaseResult {
    /// Scores a case: `findings` earn a fraction of its points.
    pub fn new(
        entry: &CaseEntry,
        about: &str,
        status: Status,
        findings: Vec<Finding>,
    ) -> CaseResult {
        let fraction = earned_fraction(&findings);
        let status = if status == Status::Passed && fraction < 1.0 {
            Status::Failed
        } else {
            status
        };
        let score = if matches!(status, Status::Passed | Status::Failed) {
            entry.points * fraction
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
            calls: 0,
            crash: None,
        }
    }

    /// The first finding that has a worst answer, with that answer.
    pub fn worst(&self) -> Option<(&Finding, &Worst)> {
        self.findings
            .iter()
            .find_map(|finding| finding.worst.as_ref().map(|worst| (finding, worst)))
    }
}

/// The fraction of a case's points that was earned: the weighted fraction of its aspects that
/// passed.
///
/// All aspects have the same weight, except two that weigh as much as all others together: hit or
/// miss, without which the others mean little, and work, which is the purpose of a BVH.
fn earned_fraction(findings: &[Finding]) -> f64 {
    let weight = |finding: &Finding| match finding.aspect {
        Aspect::HitOrMiss | Aspect::Work => (findings.len() - 1).max(1),
        _ => 1,
    };
    let total: usize = findings.iter().map(weight).sum();
    let earned: usize = findings
        .iter()
        .filter(|finding| finding.passed())
        .map(weight)
        .sum();
    if total == 0 {
        0.0
    } else {
        earned as f64 / total as f64
    }
}

impl TaskResult {
    /// Adds up the points of a task's cases.
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
            cases,
        }
    }
}
