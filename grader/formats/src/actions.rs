//! Workflow commands of GitHub Actions: annotations on lines of the student's code, and a line with
//! the points.
//!
//! <https://docs.github.com/en/actions/reference/workflows-and-actions/workflow-commands>

use crate::Outcome;
use crate::annotation::{Annotation, Level};
use crate::outcome::{NOT_GRADED, REFUSED};
use crate::points::rounded;
use crate::text::printable;

/// The commands about `outcome`, one a line.
pub fn write(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Infrastructure(why) => not_graded(NOT_GRADED, why),
        Outcome::Refused { why, .. } => not_graded(REFUSED, why),
        Outcome::Graded(graded) => {
            let report = &graded.report;
            let lines = graded.annotations.iter().map(command);
            let total = format!(
                "::notice title={}::{} of {} points, extra credit {} of {}\n",
                property(&graded.what),
                rounded(report.score),
                rounded(report.max_score),
                rounded(report.robust_score),
                rounded(report.robust_max_score)
            );
            lines.chain([total]).collect()
        }
    }
}

fn not_graded(sentence: &str, why: &str) -> String {
    let text = data(&format!("{sentence}\n{why}"));
    format!("::error title=Not graded::{text}\n")
}

fn command(annotation: &Annotation) -> String {
    let level = match annotation.level {
        Level::Error => "error",
        Level::Notice => "notice",
    };
    format!(
        "::{level} file={},line={},title={}::{}\n",
        property(&annotation.file),
        annotation.line,
        property(&annotation.title),
        data(&annotation.message)
    )
}

/// The text of a command. Without this a line of it could be a command of its own.
fn data(text: &str) -> String {
    let text = printable(text).replace('%', "%25");
    text.replace('\r', "%0D").replace('\n', "%0A")
}

/// The value of a property of a command.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_can_become_a_command() {
        let annotation = Annotation {
            file: "stages/a,b/src/x:y.rs".into(),
            line: 3,
            level: Level::Error,
            title: "50%".into(),
            message: "one\r\n::stop-commands::x\nlast".into(),
        };
        assert_eq!(
            command(&annotation),
            "::error file=stages/a%2Cb/src/x%3Ay.rs,line=3,title=50%25::one%0A::stop-commands::x%0Alast\n"
        );
    }
}
