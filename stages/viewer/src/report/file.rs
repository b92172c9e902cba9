//! Reads `report.json`, as far as the window shows it.

use judge::cases::{self, Spec};
use judge::findings::Aspect;
use judge::{Tier, repro};
use serde::Deserialize;
use std::fs;
use std::path::Path;

/// A case that lost points.
#[derive(Clone, Debug)]
pub struct FailedCase {
    /// Key of the task.
    pub task: String,
    /// The task's title.
    pub title: String,
    /// The stage that the task is in.
    pub stage: String,
    /// Name of the case.
    pub name: String,
    /// "core" or "robust".
    pub tier: Tier,
    /// What is checked, for students.
    pub about: String,
    /// Points earned and possible.
    pub points: (f64, f64),
    /// What went wrong if there are no findings: a crash, a missing task.
    pub status: String,
    /// The grader's sentences, one for each wrong aspect.
    pub findings: Vec<WrongAspect>,
    /// The likely mistake.
    pub diagnosis: Option<String>,
    /// The question of the case.
    pub spec: Option<Box<Spec>>,
}

/// An aspect with wrong answers.
#[derive(Clone, Debug, PartialEq)]
pub struct WrongAspect {
    /// Its name in sentences.
    pub aspect: String,
    /// Wrong answers.
    pub wrong: u32,
    /// Judged answers.
    pub judged: u32,
    /// The call with the worst answer, and the grader's sentence about it.
    pub worst: Option<(u32, String)>,
}

impl FailedCase {
    /// The call with the worst answer.
    pub fn worst_call(&self) -> Option<(u32, &str)> {
        let worst = self
            .findings
            .iter()
            .find_map(|finding| finding.worst.as_ref());
        worst.map(|(call, message)| (*call, message.as_str()))
    }

    /// The worst answer as a Rust test.
    pub fn test(&self) -> Option<String> {
        let (call, _) = self.worst_call()?;
        let test = repro::test(self.spec.as_ref()?, self.tier, call as usize)?;
        Some(repro::as_file("The worst answer of", &self.task, &test))
    }
}

/// The seed of the cases that the grader uses without `--seed`.
const SEED: u64 = 0;

/// Reads the failing cases of a report. The error is a sentence.
pub fn read(path: &Path) -> Result<Vec<FailedCase>, String> {
    let name = path.display();
    let text = fs::read_to_string(path).map_err(|why| {
        format!("cannot read the report {name}: {why}: `cargo grader part1` writes one")
    })?;
    let report: Report = serde_json::from_str(&text)
        .map_err(|why| format!("{name} is not a report of the grader: {why}"))?;
    let specs = cases::all(SEED);
    let mut failed = Vec::new();
    for task in report.tasks {
        for case in task
            .cases
            .into_iter()
            .filter(|case| case.score < case.max_score)
        {
            let spec = specs.iter().find(|spec| spec.is(&task.key, &case.name));
            let wrong = case
                .findings
                .into_iter()
                .filter(|finding| finding.wrong > 0);
            failed.push(FailedCase {
                task: task.key.clone(),
                title: task.title.clone(),
                stage: task.stage.clone(),
                name: case.name,
                tier: case.tier,
                about: case.about,
                points: (case.score, case.max_score),
                status: match case.detail {
                    Some(detail) => format!("{}: {detail}", case.status),
                    None => case.status,
                },
                findings: wrong
                    .map(|finding| WrongAspect {
                        aspect: name_of(finding.aspect),
                        wrong: finding.wrong,
                        judged: finding.judged,
                        worst: finding.worst.map(|worst| (worst.call, worst.message)),
                    })
                    .collect(),
                diagnosis: task
                    .diagnosis
                    .as_ref()
                    .map(|diagnosis| diagnosis.says.clone()),
                spec: spec.cloned().map(Box::new),
            });
        }
    }
    Ok(failed)
}

#[derive(Deserialize)]
struct Report {
    tasks: Vec<Task>,
}

#[derive(Deserialize)]
struct Task {
    key: String,
    title: String,
    stage: String,
    cases: Vec<Case>,
    diagnosis: Option<Diagnosis>,
}

#[derive(Deserialize)]
struct Diagnosis {
    says: String,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    tier: Tier,
    score: f64,
    max_score: f64,
    status: String,
    detail: Option<serde_json::Value>,
    about: String,
    findings: Vec<Finding>,
}

/// The name of an aspect in sentences. One that only a newer grader knows stays as in the file.
fn name_of(aspect: String) -> String {
    match serde_json::from_value::<Aspect>(aspect.clone().into()) {
        Ok(known) => known.label().to_owned(),
        Err(_) => aspect,
    }
}

#[derive(Deserialize)]
struct Finding {
    aspect: String,
    judged: u32,
    wrong: u32,
    worst: Option<Worst>,
}

#[derive(Deserialize)]
struct Worst {
    call: u32,
    message: String,
}
