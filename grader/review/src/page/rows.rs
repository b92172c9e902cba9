//! The first calls of a case that differ.

use look::case::{Case, State};
use look::page::call;
use look::page::words::Words;
use std::fmt::Write;

/// Formats at most `count` calls that differ; the first one is open, the others are folded.
pub(super) fn rows(case: &Case, count: usize, words: &Words) -> String {
    let mut text = String::new();
    let shown = &case.rows[..case.rows.len().min(count)];
    if let State::Differs { changes, calls, .. } = &case.state {
        if changes.totals {
            text.push_str("<p>The totals of the case also differ.</p>\n");
        }
        if *calls > shown.len() && !shown.is_empty() {
            let _ = writeln!(
                text,
                "<p class=\"note\">The first {} of {calls} calls that differ.</p>",
                shown.len()
            );
        }
    }
    for (i, row) in shown.iter().enumerate() {
        let heading = format!("Call {}: {}", row.call, row.cause.label());
        let call = call(row, &heading, &case.whole.verdict(row.call), words);
        match i {
            0 => text.push_str(&call),
            1 => {
                let _ = write!(
                    text,
                    "<details class=\"more\"><summary>More calls: {}</summary>\n{call}",
                    shown.len() - 1
                );
            }
            _ => text.push_str(&call),
        }
    }
    if shown.len() > 1 {
        text.push_str("</details>\n");
    }
    text
}
