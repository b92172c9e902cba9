//! `result.json` of Classroom 50: whole points only, so they are in hundredths.
//!
//! <https://github.com/foundation50/classroom50/wiki/Advanced-Autograding>, "The `result.json`
//! contract", and `schemas/result-v1.schema.json` of that repository.

use crate::outcome::name;
use crate::points::{hundredths, rounded, total};
use crate::text::printable;
use crate::{Graded, Outcome, Settings};
use base::GraderError;
use base::utc::Utc;
use grader::report::json;
use serde::Serialize;

/// What Classroom 50 calls a submission. Its runner passes it in variables of the environment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    classroom: String,
    assignment: String,
    assignment_type: String,
    owner: String,
    submission: String,
    commit: String,
    release: String,
    review: String,
    /// UTC, `2026-06-01T14:32:01Z`.
    datetime: String,
}

impl Assignment {
    /// Reads the variables by `get`. `now` is the time in seconds since 1970, UTC; the runner
    /// replaces it by the time of the commit.
    ///
    /// # Errors
    ///
    /// Names all variables that are missing.
    pub fn read(get: impl Fn(&str) -> Option<String>, now: u64) -> Result<Assignment, GraderError> {
        let value = |name: &str| get(name).filter(|value| !value.is_empty());
        let needed = [
            "CLASSROOM",
            "ASSIGNMENT",
            "OWNER",
            "SUBMISSION_TAG",
            "COMMIT_URL",
            "RELEASE_URL",
        ];
        let missing: Vec<&str> = needed
            .into_iter()
            .filter(|name| value(name).is_none())
            .collect();
        if !missing.is_empty() {
            return Err(GraderError::new(format!(
                "the format classroom50 needs what the runner of Classroom 50 sets: expected the variables {}. \
                 Start the grader from its autograder.py",
                missing.join(", ")
            )));
        }
        let text = |name: &str| value(name).unwrap_or_default();
        Ok(Assignment {
            classroom: text("CLASSROOM"),
            assignment: text("ASSIGNMENT"),
            assignment_type: value("ASSIGNMENT_TYPE").unwrap_or_else(|| "individual".into()),
            owner: text("OWNER"),
            submission: text("SUBMISSION_TAG"),
            commit: text("COMMIT_URL"),
            release: text("RELEASE_URL"),
            review: value("REVIEW_URL").unwrap_or_else(|| text("COMMIT_URL")),
            datetime: utc(now),
        })
    }
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct File<'a> {
    schema: &'static str,
    classroom: &'a str,
    assignment: &'a str,
    #[serde(rename = "assignment_type")]
    assignment_type: &'a str,
    owner: &'a str,
    submission: &'a str,
    commit: &'a str,
    release: &'a str,
    review: &'a str,
    datetime: &'a str,
    score: u64,
    max_score: u64,
    tests: Vec<Test>,
}

/// The result of a task. Fields beyond the first four are kept by Classroom 50, and read by nobody.
#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Test {
    test_name: String,
    passed: bool,
    score: u64,
    max_score: u64,
    points: f64,
    max_points: f64,
    extra_credit: f64,
    max_extra_credit: f64,
    output: String,
}

/// The file about `outcome`. After a failure of the grader it has 0 of 0 points and no tests, as
/// the runner's own files about errors, and the exit code tells the runner to show an error.
pub fn write(outcome: &Outcome, settings: &Settings) -> Result<String, GraderError> {
    let assignment = settings.assignment.as_ref().map_err(Clone::clone)?;
    let (score, max_score, tests) = match outcome {
        Outcome::Infrastructure(_) => (0, 0, Vec::new()),
        Outcome::Refused { max_score, .. } => (0, hundredths(*max_score, *max_score), Vec::new()),
        Outcome::Graded(graded) => {
            let max = graded.report.max_score;
            // A score above the maximum is refused.
            let score = hundredths(total(&graded.report, settings).min(max), max);
            (score, hundredths(max, max), tests(graded))
        }
    };
    json(&File {
        schema: "classroom50/result/v1",
        classroom: &assignment.classroom,
        assignment: &assignment.assignment,
        assignment_type: &assignment.assignment_type,
        owner: &assignment.owner,
        submission: &assignment.submission,
        commit: &assignment.commit,
        release: &assignment.release,
        review: &assignment.review,
        datetime: &assignment.datetime,
        score,
        max_score,
        tests,
    })
}

fn tests(graded: &Graded) -> Vec<Test> {
    let tests = graded.report.tasks.iter().map(|task| {
        let result = &task.result;
        Test {
            test_name: name(task),
            passed: result.score >= result.max_score,
            score: hundredths(result.score, result.max_score),
            max_score: hundredths(result.max_score, result.max_score),
            points: rounded(result.score),
            max_points: rounded(result.max_score),
            extra_credit: rounded(result.robust_score),
            max_extra_credit: rounded(result.robust_max_score),
            output: printable(&graded.task_text(task)),
        }
    });
    tests.collect()
}

/// A time in seconds since 1970 as `2026-06-01T14:32:01Z`.
fn utc(seconds: u64) -> String {
    let Utc {
        year,
        month,
        day,
        hour,
        minute,
        second,
    } = Utc::at(seconds as i64);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_utc() {
        assert_eq!(utc(0), "1970-01-01T00:00:00Z");
        assert_eq!(utc(951_782_399), "2000-02-28T23:59:59Z");
        assert_eq!(utc(951_782_400), "2000-02-29T00:00:00Z");
        assert_eq!(utc(1_780_324_321), "2026-06-01T14:32:01Z");
        assert_eq!(utc(4_107_542_400), "2100-03-01T00:00:00Z");
    }

    #[test]
    fn missing_variables_are_all_named() {
        let get = |name: &str| (name == "CLASSROOM").then(|| "cs".to_owned());
        let error = Assignment::read(get, 0).expect_err("most are missing");
        let names = "ASSIGNMENT, OWNER, SUBMISSION_TAG, COMMIT_URL, RELEASE_URL";
        assert!(error.to_string().contains(names), "{error}");
    }
}
