//! A summary for people: the step summary of GitHub Actions, the release page of Classroom 50.

use crate::outcome::{NOT_GRADED, REFUSED};
use crate::points::rounded;
use crate::text::{limited, printable};
use crate::{Graded, Outcome};
use grader::report::table;
use std::fmt::Write;

/// GitHub refuses a summary of more than 1 MB.
const LONGEST: usize = 100_000;

/// The summary: a table of the tasks, then what the report says about those that lost points.
pub fn write(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Infrastructure(why) => {
            format!("## Not graded\n\n{NOT_GRADED}\n\n{}", code(&printable(why)))
        }
        Outcome::Refused { why, .. } => {
            format!("## Not graded\n\n{REFUSED}\n\n{}", code(&printable(why)))
        }
        Outcome::Graded(graded) => summary(graded),
    }
}

fn summary(graded: &Graded) -> String {
    let report = &graded.report;
    let mut text = format!(
        "## {}: {} of {} points, extra credit {} of {}\n\n| task | | core | extra | status |\n|---|---|--:|--:|---|\n",
        graded.what,
        rounded(report.score),
        rounded(report.max_score),
        rounded(report.robust_score),
        rounded(report.robust_max_score)
    );
    for task in &report.tasks {
        let result = &task.result;
        let _ = writeln!(
            text,
            "| {} | {} | {}/{} | {}/{} | {} |",
            result.key,
            cell(&result.title),
            rounded(result.score),
            rounded(result.max_score),
            rounded(result.robust_score),
            rounded(result.robust_max_score),
            cell(&table::summary(result))
        );
    }
    let details = report.tasks.iter().map(|task| graded.task_text(task));
    let details: String = std::iter::once(graded.notes.clone())
        .chain(details)
        .collect();
    if !details.trim().is_empty() {
        text.push('\n');
        text.push_str(&code(&limited(&printable(details.trim()), LONGEST)));
    }
    text
}

/// The text in a cell of a table: students' code may have caused what it says.
fn cell(text: &str) -> String {
    let mut cell = String::new();
    for c in printable(text).chars() {
        match c {
            '\n' | '\t' => cell.push(' '),
            '|' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '\\' | '!' | '@' => {
                cell.push('\\');
                cell.push(c);
            }
            c => cell.push(c),
        }
    }
    cell
}

/// The text as code, between fences that are longer than any in the text.
fn code(text: &str) -> String {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest.max(2) + 1);
    format!("{fence}text\n{text}\n{fence}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_cannot_end_its_fence_or_cell() {
        assert_eq!(code("a\n```\nb"), "````text\na\n```\nb\n````\n");
        assert_eq!(cell("a|b\n<i>"), "a\\|b \\<i\\>");
    }
}
