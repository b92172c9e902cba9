//! A gradebook of one row: who, core points and extra credit, the core points of each task, a note.
//!
//! RFC 4180. Canvas and Moodle import it by the columns `id`, `name` and `score`.

use crate::points::rounded;
use crate::{Outcome, Settings};
use grader::score::{Status, TaskResult};
use submission::about_refused;

/// The columns before those of the tasks.
const COLUMNS: [&str; 6] = ["id", "name", "score", "max_score", "extra", "max_extra"];

/// The file about `outcome`: a header and a row. If nothing was graded, all points are empty,
/// not 0, and the note says why.
pub fn write(outcome: &Outcome, settings: &Settings) -> String {
    let mut header: Vec<String> = COLUMNS.map(str::to_owned).to_vec();
    let mut row = vec![settings.id.clone(), settings.name.clone()];
    let note = match outcome {
        Outcome::Infrastructure(why) | Outcome::Refused { why, .. } => {
            row.extend(["", "", "", ""].map(str::to_owned));
            format!("not graded: {why}")
        }
        Outcome::Graded(graded) => {
            let report = &graded.report;
            let points = [
                report.score,
                report.max_score,
                report.robust_score,
                report.robust_max_score,
            ];
            row.extend(points.map(|points| rounded(points).to_string()));
            let results = || report.tasks.iter().map(|task| &task.result);
            header.extend(results().map(|task| task.key.clone()));
            row.extend(results().map(|task| rounded(task.score).to_string()));
            let not_built = |task: &&TaskResult| task.status == Status::DoesNotCompile;
            let is_refused = |task: &&TaskResult| graded.refused.contains_key(&task.stage);
            let broken = results().filter(not_built).filter(|task| !is_refused(task));
            let broken: Vec<&str> = broken.map(|task| task.key.as_str()).collect();
            let broken =
                (!broken.is_empty()).then(|| format!("does not compile: {}", broken.join(" ")));
            let notes = broken.into_iter().chain(about_refused(&graded.refused));
            notes.collect::<Vec<_>>().join("; ")
        }
    };
    header.push("note".into());
    row.push(note);
    let line = |fields: &[String]| {
        let fields: Vec<String> = fields.iter().map(|text| field(text)).collect();
        format!("{}\r\n", fields.join(","))
    };
    format!("{}{}", line(&header), line(&row))
}

/// A field of a CSV file. Text that a spreadsheet would read as a formula gets an apostrophe in
/// front.
pub fn field(text: &str) -> String {
    let text = match text.starts_with(['=', '+', '-', '@', '\t', '\r']) {
        true => format!("'{text}"),
        false => text.to_owned(),
    };
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_with_commas_and_formulas_are_quoted() {
        assert_eq!(field("anna"), "anna");
        assert_eq!(field("a, \"b\""), "\"a, \"\"b\"\"\"");
        assert_eq!(field("=1+1"), "'=1+1");
        assert_eq!(field("two\nlines"), "\"two\nlines\"");
    }
}
