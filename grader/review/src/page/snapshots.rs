//! The snapshots on the page: each changed case, then the names of the unchanged ones.

use super::case_text::{self, differs, is_silent, meaning};
use super::rows::rows;
use crate::Review;
use crate::case::{Case, State};
use judge::plural;
use pages::html::escape;
use std::fmt::Write;

/// Formats all cases.
pub(super) fn section(review: &Review) -> String {
    let cases: Vec<&Case> = review.cases.iter().collect();
    let mut text = String::new();
    for case in cases.iter().filter(|case| differs(&case.state)) {
        let id = escape(&case.path());
        if case.picture.is_some() {
            let _ = writeln!(
                text,
                "<p><a href=\"#{id}\">{id}</a>: {} (see its picture above)</p>",
                escape(&meaning(case))
            );
            continue;
        }
        let _ = write!(
            text,
            "<details class=\"case\" id=\"{id}\" open>\n<summary><h3>{id}</h3></summary>\n{}{}</details>\n",
            case_text::describe(case),
            rows(case)
        );
    }
    let silent = cases.iter().filter(|case| is_silent(&case.state));
    let silent: Vec<&&Case> = silent.collect();
    for of_reason in silent.chunk_by(|a, b| a.state == b.state) {
        if let State::Silent(why) = &of_reason[0].state {
            let names: Vec<String> = of_reason.iter().map(|case| escape(&case.path())).collect();
            let _ = writeln!(
                text,
                "<p class=\"bad\">No answer ({}): {}</p>",
                escape(why),
                names.join(", ")
            );
        }
    }
    let same = cases.iter().filter(|case| case.state == State::Same);
    let same: Vec<String> = same.map(|case| escape(&case.path())).collect();
    if !same.is_empty() {
        let _ = writeln!(
            text,
            "<details><summary>{} unchanged</summary><p>{}</p></details>",
            plural(same.len(), "case is", "cases are"),
            same.join(", ")
        );
    }
    text
}
