//! The grader's own JSON, which `--format json` prints.

use crate::Outcome;
use base::GraderError;
use grader::report::json;
use serde::Serialize;

#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum NotGraded<'a> {
    Infrastructure(&'a str),
    Refused(&'a str),
}

/// The report, or an object that has only the reason why there is none.
pub fn write(outcome: &Outcome) -> Result<String, GraderError> {
    match outcome {
        Outcome::Graded(graded) => Ok(graded.json.clone()),
        Outcome::Infrastructure(why) => json(&NotGraded::Infrastructure(why)),
        Outcome::Refused { why, .. } => json(&NotGraded::Refused(why)),
    }
}
