//! Turns the findings about answers into points.
//!
//! A case gives points only if its main answers are right, such as hit or miss. Of tasks with
//! several functions each is judged by itself ([`functions`]): the points of a case are shared
//! equally by those that it judges. A function without the idea of its task gets a quarter of them
//! (`idea` in `course.toml`), some cases count only with another (`only_with`), and robust points
//! count from two thirds of the core points on.

pub mod functions;
pub(crate) mod order;
pub mod regularity;

use crate::course::{CaseEntry, Task, YOUR_EXAMPLES};
use crate::workers::crash::Crash;
use functions::{FunctionResult, FunctionShare};
use judge::Tier;
use judge::findings::{Finding, Worst};
use serde::Serialize;
use std::collections::BTreeSet;
use wire::record::HoleCall;

/// The share of its points that a function without the idea of its task gets.
const WITHOUT_IDEA: f64 = 0.25;

/// The share of a task's core points from which on its robust points count.
const CORE_FOR_ROBUST: f64 = 2.0 / 3.0;

/// Sums of points are rounded: a share of a limit that is this close to it has reached it.
const ROUNDING: f64 = 1e-9;

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
    Crashed(Crash),
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
    /// The share of its points that its answers earn, whatever the points are. Extra credit that
    /// waits for core points ([`earns_extra`]) is not taken away here.
    pub earned: f64,
    /// Its status.
    #[serde(flatten)]
    pub status: Status,
    /// What the case tests.
    pub about: String,
    /// The findings about its answers, one for each aspect.
    pub findings: Vec<Finding>,
    /// What else than wrong answers costs points of the case, as sentences without a full stop.
    pub reductions: Vec<String>,
    /// The functions that share its points.
    #[serde(skip)]
    pub shares: Vec<FunctionShare>,
    /// Whether it also runs other stages. Their mistakes may affect its answers.
    #[serde(skip)]
    pub with_neighbours: bool,
    /// The number of its calls.
    #[serde(skip)]
    pub calls: usize,
    /// The answer to every one of its calls, as text, if there is only one.
    #[serde(skip)]
    pub answer_to_all: Option<String>,
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
    /// Its functions, as far as they are judged or have holes.
    pub functions: Vec<FunctionResult>,
    /// Its cases.
    pub cases: Vec<CaseResult>,
}

#[cfg(test)]
impl CaseResult {
    /// A failed core case worth one point, for tests of what is said about it.
    pub(crate) fn failed(name: &str, findings: Vec<Finding>) -> CaseResult {
        CaseResult {
            name: name.into(),
            tier: Tier::Core,
            score: 0.0,
            max_score: 1.0,
            earned: 0.0,
            status: Status::Failed,
            about: String::new(),
            findings,
            reductions: Vec::new(),
            shares: Vec::new(),
            with_neighbours: false,
            calls: 0,
            answer_to_all: None,
        }
    }
}

impl CaseResult {
    /// How its code crashed, if it did.
    pub fn crash(&self) -> Option<&Crash> {
        match &self.status {
            Status::Crashed(crash) => Some(crash),
            _ => None,
        }
    }

    /// Scores a case: `findings` earn a fraction of its points, of which the functions with `holes`
    /// have their share.
    pub fn new(
        entry: &CaseEntry,
        about: &str,
        status: Status,
        findings: Vec<Finding>,
        holes: &[HoleCall],
    ) -> CaseResult {
        let shares = functions::shares(&findings, holes);
        let fraction = functions::mean(shares.iter().map(|share| share.fraction));
        let status = match status {
            Status::Passed if !holes.is_empty() && shares.iter().all(FunctionShare::is_hole) => {
                Status::NotAttempted
            }
            Status::Passed if fraction < 1.0 => Status::Failed,
            status => status,
        };
        let earned = match status {
            Status::Passed | Status::Failed => fraction,
            _ => 0.0,
        };
        let mut findings = findings;
        if !holes.is_empty() {
            // Aspects of functions with holes.
            findings.retain(|finding| finding.judged > 0);
        }
        let reductions = shares.iter().filter_map(FunctionShare::reduction).collect();
        CaseResult {
            name: entry.name.clone(),
            tier: entry.tier,
            score: entry.points * earned,
            max_score: entry.points,
            earned,
            status,
            about: about.into(),
            findings,
            reductions,
            shares,
            with_neighbours: false,
            calls: 0,
            answer_to_all: None,
        }
    }

    /// Takes points away, because of `why`.
    fn reduce(&mut self, score: f64, why: String) {
        if score >= self.score {
            return;
        }
        self.score = score;
        self.status = match &self.status {
            Status::Passed => Status::Failed,
            status => status.clone(),
        };
        self.reductions.push(why);
    }

    /// Why aspects of its answers cannot be judged in this run, which costs nothing.
    pub fn undecided(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.findings.iter().filter_map(|finding| finding.undecided)
    }

    /// Whether its answers are right, and it lost points for another reason: another case shows
    /// that the idea of the task is missing.
    pub fn is_only_reduced(&self) -> bool {
        let is_right = !self.findings.is_empty() && self.findings.iter().all(Finding::passed);
        (is_right || self.is_of_examples()) && !self.reductions.is_empty()
    }

    /// Whether this is no case of the grader's, but what the student's examples earn.
    pub fn is_of_examples(&self) -> bool {
        self.name == YOUR_EXAMPLES
    }

    /// Whether its answers are right and complete, and only the idea of the task is missing.
    pub(crate) fn lacks_only_the_idea(&self) -> bool {
        self.is_only_reduced() && !self.has_hole()
    }

    /// Whether it has no answers for a reason that is not in the code of its task. A gap of another
    /// task is in this code if the case runs no other stage.
    fn waits_for_others(&self) -> bool {
        match self.status {
            Status::Needs(_) => self.with_neighbours,
            _ => self.status == Status::DoesNotCompile,
        }
    }

    /// Whether a function that the case judges is not written yet.
    pub(crate) fn has_hole(&self) -> bool {
        self.shares.iter().any(FunctionShare::is_hole)
    }

    /// The first finding that has a worst answer, with that answer.
    pub fn worst(&self) -> Option<(&Finding, &Worst)> {
        self.findings
            .iter()
            .find_map(|finding| finding.worst.as_ref().map(|worst| (finding, worst)))
    }
}

impl TaskResult {
    /// Whether it has all core points.
    pub fn is_complete(&self) -> bool {
        self.score >= self.max_score
    }

    /// The cases whose own answers are wrong, or that have none: not those that lost points because
    /// something else is missing.
    pub fn failed_cases(&self) -> impl Iterator<Item = &CaseResult> {
        self.cases.iter().filter(|case| {
            let has_no_result = matches!(
                case.status,
                Status::Passed | Status::NotAttempted | Status::DoesNotCompile | Status::Needs(_)
            );
            !has_no_result && !case.is_only_reduced()
        })
    }

    /// Whether no core case fails but those that also run other stages, which may be wrong instead.
    pub fn fails_only_with_neighbours(&self) -> bool {
        let mut failed = self.failed_cases().filter(|case| case.tier == Tier::Core);
        failed.next().is_some_and(|case| case.with_neighbours)
            && failed.all(|case| case.with_neighbours)
    }

    /// Adds what a student's examples earn ([`crate::examples::case_of`]). The status stays that of
    /// the code.
    pub fn add_examples(&mut self, case: Option<CaseResult>) {
        let Some(mut case) = case else { return };
        if !earns_extra(self.score, self.max_score) {
            case.reduce(0.0, WAITS_FOR_CORE.into());
        }
        self.robust_score += case.score;
        self.robust_max_score += case.max_score;
        self.cases.push(case);
    }

    /// The same result of code that also crashes in the cases whose names `crashes` accepts.
    pub fn with_crashes(&self, task: &Task, crashes: impl Fn(&str) -> bool) -> TaskResult {
        let each = self.cases.iter().filter_map(|case| {
            let entry = task.cases.iter().find(|entry| entry.name == case.name)?;
            let (status, findings) = match &case.status {
                _ if crashes(&case.name) => (Status::Crashed(Crash::default()), &[][..]),
                Status::Passed | Status::Failed => (Status::Passed, &case.findings[..]),
                status => (status.clone(), &[][..]),
            };
            let holes = case.shares.iter().filter_map(|share| {
                Some(HoleCall {
                    called: share.function.clone(),
                    hole: share.hole.clone()?,
                })
            });
            let holes: Vec<HoleCall> = holes.collect();
            let findings = findings.iter().map(Finding::counts).collect();
            Some(CaseResult {
                with_neighbours: case.with_neighbours,
                ..CaseResult::new(entry, "", status, findings, &holes)
            })
        });
        TaskResult::new(task, each.collect())
    }

    /// Adds up the points of a task's cases.
    pub fn new(task: &Task, mut cases: Vec<CaseResult>) -> TaskResult {
        functions::require_idea(task, &mut cases);
        require_others(task, &mut cases);
        require_core(task, &mut cases);
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
            max_score: task.points_of_cases(Tier::Core),
            robust_score: sum(Tier::Robust),
            robust_max_score: task.points_of_cases(Tier::Robust),
            status,
            stage: task.stage.clone(),
            functions: functions::results(task, &cases),
            cases,
        }
    }
}

/// Takes the points away from cases that count only with another case, if answers of that one are
/// wrong or missing.
fn require_others(task: &Task, cases: &mut [CaseResult]) {
    let failed = |case: &&CaseResult| {
        let is_complete = !case.findings.is_empty() && !case.has_hole();
        let is_right = is_complete && case.findings.iter().all(Finding::passed);
        !is_right && !case.waits_for_others()
    };
    let failed: BTreeSet<String> = cases
        .iter()
        .filter(failed)
        .map(|case| case.name.clone())
        .collect();
    for case in cases {
        let entry = task.cases.iter().find(|entry| entry.name == case.name);
        let other = entry.and_then(|entry| entry.only_with.as_ref());
        if let Some(other) = other.filter(|other| failed.contains(*other)) {
            case.earned = 0.0;
            case.reduce(0.0, format!("counts only if the case {other} passes, too"));
        }
    }
}

/// Why extra credit gives no points yet.
const WAITS_FOR_CORE: &str =
    "extra credit counts from two thirds of the core points of the task on";

/// Whether the robust points of a task count, with `core` of its `of` core points.
pub fn earns_extra(core: f64, of: f64) -> bool {
    core >= (CORE_FOR_ROBUST - ROUNDING) * of
}

/// Takes the robust points away from a task with few core points.
fn require_core(task: &Task, cases: &mut [CaseResult]) {
    let core: f64 = cases
        .iter()
        .filter(|case| case.tier == Tier::Core)
        .map(|case| case.score)
        .sum();
    if earns_extra(core, task.points_of_cases(Tier::Core)) {
        return;
    }
    for case in cases.iter_mut().filter(|case| case.tier == Tier::Robust) {
        case.reduce(0.0, WAITS_FOR_CORE.into());
    }
}
