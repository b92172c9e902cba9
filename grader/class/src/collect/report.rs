//! What the tables and pages read of the report about a submission.

use super::points;
use crate::plan::Plan;
use crate::unit::Unit;
use base::GraderError;
use judge::Tier;
use serde::Deserialize;
use std::collections::BTreeMap;
use submission::Untrusted;

/// The report about one submission.
#[derive(Clone, Debug, Deserialize)]
pub struct StudentReport {
    /// Core points earned.
    pub score: f64,
    /// Core points possible.
    pub max_score: f64,
    /// Extra points earned.
    pub robust_score: f64,
    /// Extra points possible.
    pub robust_max_score: f64,
    /// The tasks, in the order of their keys.
    pub tasks: Vec<Task>,
    /// Stages that were not handed in.
    #[serde(default)]
    pub missing: Vec<String>,
    /// Stages that were refused before they were compiled, with the reasons.
    #[serde(default)]
    pub refused_stages: BTreeMap<String, Vec<String>>,
    /// Files that are not graded.
    #[serde(default)]
    pub ignored: Vec<String>,
    /// Those of them that decide points in the student's own runs.
    #[serde(default)]
    pub changed_given: Vec<String>,
    /// Code that a person should look at.
    #[serde(default)]
    pub to_check: Vec<String>,
    /// The compiler's messages.
    #[serde(default)]
    pub compiler: Untrusted,
    /// What the code printed.
    #[serde(default)]
    pub printed: Untrusted,
    /// How the code was contained.
    #[serde(default)]
    pub containment: String,
}

/// The result of one task.
#[derive(Clone, Debug, Deserialize)]
pub struct Task {
    /// Its key.
    pub key: String,
    /// Its title.
    pub title: String,
    /// Core points earned.
    pub score: f64,
    /// Core points possible.
    pub max_score: f64,
    /// Extra points earned.
    pub robust_score: f64,
    /// Extra points possible.
    pub robust_max_score: f64,
    /// Its status, such as `failed`.
    pub status: String,
    /// The crate with its functions.
    pub stage: String,
    /// Its cases.
    pub cases: Vec<Case>,
    /// The likely mistake.
    pub diagnosis: Option<Diagnosis>,
    /// What the wrong answers have in common.
    #[serde(default)]
    pub regularities: Vec<Untrusted>,
    /// The simplest call that shows what is wrong.
    #[serde(default)]
    pub simplest: Option<Simplest>,
    /// A Rust test of the worst answer.
    pub worst_as_test: Option<Untrusted>,
}

/// The result of one case.
#[derive(Clone, Debug, Deserialize)]
pub struct Case {
    /// Its name.
    pub name: String,
    /// Whether its points are core points or extra credit.
    pub tier: Tier,
    /// Points earned.
    pub score: f64,
    /// Points possible.
    pub max_score: f64,
    /// Its status, such as `crashed`.
    pub status: String,
    /// What the status is about.
    pub detail: Option<Untrusted>,
    /// What it tests.
    pub about: String,
    /// What was found about its answers.
    pub findings: Vec<Finding>,
    /// What else costs points.
    pub reductions: Vec<Untrusted>,
}

/// What was found about an aspect of the answers.
#[derive(Clone, Debug, Deserialize)]
pub struct Finding {
    /// The aspect, such as `decision`.
    pub aspect: judge::findings::Aspect,
    /// How many answers were judged.
    pub judged: u64,
    /// How many of them are wrong.
    pub wrong: u64,
    /// The worst one.
    pub worst: Option<Worst>,
}

/// The worst wrong answer.
#[derive(Clone, Debug, Deserialize)]
pub struct Worst {
    /// The student's result, the expected one and the input.
    pub message: Untrusted,
}

/// The simplest call on which the code is wrong in the way of a failed case.
#[derive(Clone, Debug, Deserialize)]
pub struct Simplest {
    /// The case.
    pub case: String,
    /// What is wrong; `None` if the code crashes, and says so in its own words.
    pub aspect: Option<judge::findings::Aspect>,
    /// What the function is called with.
    pub input: Untrusted,
    /// Its result and the expected one.
    pub result: Untrusted,
    /// The call, drawn.
    #[serde(default)]
    pub drawing: Option<Drawing>,
}

/// A drawing of a call.
#[derive(Clone, Debug, Deserialize)]
pub struct Drawing {
    /// An SVG file.
    pub svg: Untrusted,
    /// What is seen, and what the signs mean.
    pub caption: Untrusted,
}

impl Simplest {
    /// How much there is to read.
    pub fn length(&self) -> usize {
        self.input.raw().len() + self.result.raw().len()
    }
}

/// A known mistake that explains wrong answers.
#[derive(Clone, Debug, Deserialize)]
pub struct Diagnosis {
    /// The names of the mistakes.
    pub mistakes: Vec<String>,
    /// The sentence about it.
    pub says: String,
    /// What the code does, such as "culls back faces". Results of older programs lack it.
    #[serde(default)]
    pub description: String,
    /// Where to look.
    pub hint: String,
    /// `likely` or `perhaps`.
    pub certainty: String,
}

impl StudentReport {
    /// Reads the report in a unit, with the points of the plan.
    pub fn of(unit: &Unit, plan: &Plan) -> Result<StudentReport, GraderError> {
        let report = StudentReport::deserialize(&unit.report);
        let mut report = report.map_err(|e| {
            GraderError::new(format!(
                "units/{}.json has a report of another version of the grader ({e}). Remove it and run again",
                unit.key
            ))
        })?;
        points::apply(&mut report, unit, plan)?;
        Ok(report)
    }

    /// What an instructor alone should look at, as sentences.
    pub(super) fn doubts(&self) -> Vec<Untrusted> {
        let doubts = self.to_check.iter();
        doubts
            .map(|what| format!("please look at {what}").into())
            .collect()
    }

    /// What is to be known besides the points, as sentences.
    pub(super) fn notes(&self) -> Vec<Untrusted> {
        let mut notes: Vec<String> = Vec::new();
        if !self.missing.is_empty() {
            notes.push(format!("not handed in: {}", self.missing.join(" ")));
        }
        let mut broken: Vec<&str> = self
            .tasks
            .iter()
            .filter(|task| task.status == "does_not_compile")
            .map(|task| task.stage.as_str())
            .filter(|stage| !self.refused_stages.contains_key(*stage))
            .collect();
        broken.dedup();
        if !broken.is_empty() {
            notes.push(format!("does not compile: {}", broken.join(" ")));
        }
        notes.extend(submission::about_refused(&self.refused_stages));
        notes.extend(submission::about_changed_given(&self.changed_given));
        let is_said = |file: &&String| self.changed_given.contains(*file);
        let mut others = self.ignored.iter().filter(|file| !is_said(file));
        if let Some(file) = others.next() {
            notes.push(match others.count() {
                0 => format!("ignored: {file}"),
                more => format!("ignored: {file} and {more} more files"),
            });
        }
        notes.into_iter().map(Untrusted::from).collect()
    }
}
