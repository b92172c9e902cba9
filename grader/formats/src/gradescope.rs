//! `results.json` of Gradescope: a test for each task, and one for its extra credit.
//!
//! <https://gradescope-autograders.readthedocs.io/en/latest/specs/>

use crate::outcome::{NOT_GRADED, REFUSED, name};
use crate::points::{rounded, total};
use crate::text::{limited, printable};
use crate::{Graded, Outcome, Settings};
use base::GraderError;
use grader::report::{TaskReport, json};
use serde::Serialize;

/// The longest output of a test in bytes. A browser shows no more with pleasure.
const LONGEST: usize = 20_000;

#[derive(Serialize)]
struct Results {
    #[serde(skip_serializing_if = "Option::is_none")]
    score: Option<f64>,
    output: String,
    output_format: &'static str,
    test_output_format: &'static str,
    test_name_format: &'static str,
    visibility: &'static str,
    stdout_visibility: &'static str,
    extra_data: ExtraData,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    tests: Vec<Test>,
}

/// What a script of the instructor may want to read.
#[derive(Serialize)]
#[serde(untagged)]
enum ExtraData {
    Points {
        core: f64,
        max_core: f64,
        extra: f64,
        max_extra: f64,
    },
    Failure {
        infrastructure: String,
    },
}

#[derive(Serialize)]
struct Test {
    score: f64,
    max_score: f64,
    status: &'static str,
    name: String,
    number: String,
    output: String,
    tags: [&'static str; 1],
}

/// The file about `outcome`. After a failure of the grader it has neither a score nor tests, and
/// Gradescope reports that the autograder failed instead of giving points.
pub fn write(outcome: &Outcome, settings: &Settings) -> Result<String, GraderError> {
    let results = match outcome {
        Outcome::Graded(graded) => results(graded, settings),
        Outcome::Refused { why, max_score } => Results {
            score: Some(0.0),
            output: printable(&format!("{REFUSED}\n{why}")),
            extra_data: ExtraData::Points {
                core: 0.0,
                max_core: rounded(*max_score),
                extra: 0.0,
                max_extra: 0.0,
            },
            ..empty(settings)
        },
        Outcome::Infrastructure(why) => Results {
            output: printable(&format!("{NOT_GRADED}\n{why}")),
            extra_data: ExtraData::Failure {
                infrastructure: printable(why),
            },
            ..empty(settings)
        },
    };
    json(&results)
}

fn empty(settings: &Settings) -> Results {
    Results {
        score: None,
        output: String::new(),
        output_format: "text",
        test_output_format: "text",
        test_name_format: "text",
        visibility: settings.visibility.name(),
        // It belongs to the instructor: cargo's progress, and paths of the container.
        stdout_visibility: "hidden",
        extra_data: ExtraData::Failure {
            infrastructure: String::new(),
        },
        tests: Vec::new(),
    }
}

fn results(graded: &Graded, settings: &Settings) -> Results {
    let report = &graded.report;
    let tasks = report.tasks.iter();
    Results {
        score: Some(rounded(total(report, settings))),
        output: limited(&printable(&graded.notes), LONGEST),
        extra_data: ExtraData::Points {
            core: rounded(report.score),
            max_core: rounded(report.max_score),
            extra: rounded(report.robust_score),
            max_extra: rounded(report.robust_max_score),
        },
        tests: tasks.flat_map(|task| tests(graded, task)).collect(),
        ..empty(settings)
    }
}

/// The test of a task, and that of its extra credit if there is some.
fn tests(graded: &Graded, task: &TaskReport) -> Vec<Test> {
    let result = &task.result;
    let core = Test {
        score: rounded(result.score),
        max_score: rounded(result.max_score),
        status: status(result.score, result.max_score),
        name: name(task),
        number: number(&result.key),
        output: limited(&printable(&graded.task_text(task)), LONGEST),
        tags: ["core"],
    };
    let mut tests = vec![core];
    if result.robust_max_score > 0.0 {
        tests.push(Test {
            score: rounded(result.robust_score),
            max_score: rounded(result.robust_max_score),
            status: status(result.robust_score, result.robust_max_score),
            name: format!("{} (extra credit)", name(task)),
            number: format!("{}.extra", number(&result.key)),
            output: String::new(),
            tags: ["extra credit"],
        });
    }
    tests
}

fn status(score: f64, max_score: f64) -> &'static str {
    match score >= max_score {
        true => "passed",
        false => "failed",
    }
}

/// The number of a task: "1.3" of `part1.task3`.
fn number(key: &str) -> String {
    key.replace("part", "").replace("task", "")
}
