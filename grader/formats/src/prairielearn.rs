//! `results.json` of PrairieLearn: a score from 0 to 1, and a test for each task.
//!
//! <https://docs.prairielearn.com/externalGrading/>, "Grading results"

use crate::outcome::{NOT_GRADED, REFUSED, name};
use crate::points::{rounded, total};
use crate::text::{limited, printable};
use crate::{Graded, Outcome, Settings};
use base::GraderError;
use grader::report::{TaskReport, json, table};
use serde::Serialize;

/// The longest output of a test in bytes: PrairieLearn refuses files above 1 MB.
const LONGEST: usize = 20_000;

#[derive(Serialize)]
struct Results {
    gradable: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    score: Option<f64>,
    message: String,
    output: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    format_errors: Vec<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    tests: Vec<Test>,
}

#[derive(Serialize)]
struct Test {
    name: String,
    description: String,
    points: f64,
    max_points: f64,
    message: String,
    output: String,
}

/// The file about `outcome`. After a failure of the grader, and if nothing can be graded or
/// compiled, the submission is not gradable: it costs the student no attempt and gives no points.
pub fn write(outcome: &Outcome, settings: &Settings) -> Result<String, GraderError> {
    let results = match outcome {
        Outcome::Infrastructure(why) => not_gradable(NOT_GRADED, why),
        Outcome::Refused { why, .. } => not_gradable(REFUSED, why),
        Outcome::Graded(graded) if graded.nothing_compiles() => {
            not_gradable("The code does not compile.", &graded.notes)
        }
        Outcome::Graded(graded) => results(graded, settings),
    };
    json(&results)
}

fn not_gradable(message: &str, error: &str) -> Results {
    let error = limited(&printable(error), LONGEST);
    Results {
        gradable: false,
        score: None,
        message: message.into(),
        output: String::new(),
        format_errors: vec![message.into(), error],
        tests: Vec::new(),
    }
}

fn results(graded: &Graded, settings: &Settings) -> Results {
    let report = &graded.report;
    let tasks = report.tasks.iter();
    Results {
        gradable: true,
        score: Some(fraction(total(report, settings), report.max_score)),
        message: format!(
            "core {} of {}, extra credit {} of {}",
            rounded(report.score),
            rounded(report.max_score),
            rounded(report.robust_score),
            rounded(report.robust_max_score)
        ),
        output: limited(&printable(&graded.notes), LONGEST),
        format_errors: Vec::new(),
        tests: tasks.flat_map(|task| tests(graded, task)).collect(),
    }
}

/// A fraction from 0 to 1; 1 only for all points.
fn fraction(points: f64, max: f64) -> f64 {
    match points >= max {
        true => 1.0,
        false => (points / max).clamp(0.0, 1.0 - f64::EPSILON),
    }
}

/// The test of a task, and that of its extra credit if there is some.
fn tests(graded: &Graded, task: &TaskReport) -> Vec<Test> {
    let result = &task.result;
    let core = Test {
        name: result.key.clone(),
        description: result.title.clone(),
        points: rounded(result.score),
        max_points: rounded(result.max_score),
        message: printable(&table::summary(result)),
        output: limited(&printable(&graded.task_text(task)), LONGEST),
    };
    let mut tests = vec![core];
    if result.robust_max_score > 0.0 {
        tests.push(Test {
            name: format!("{} extra credit", result.key),
            description: name(task),
            points: rounded(result.robust_score),
            max_points: rounded(result.robust_max_score),
            message: String::new(),
            output: String::new(),
        });
    }
    tests
}
