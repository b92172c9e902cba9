//! Tables of golden and actual answers.

use crate::case::{Case, ROWS, Row, State};
use judge::snapshot::{Line, Value};
use judge::tally::Aspect;
use judge::whole::Verdict;
use pages::html::escape;
use std::fmt::Write;

/// Formats the calls that differ, golden and actual side by side.
pub(super) fn rows(case: &Case) -> String {
    let mut text = String::new();
    if let State::Differs { changes, calls, .. } = &case.state {
        if changes.totals {
            text.push_str("<p>The totals of the case also differ.</p>\n");
        }
        if *calls > ROWS {
            let _ = writeln!(
                text,
                "<p class=\"note\">The first {ROWS} of {calls} calls that differ.</p>"
            );
        }
    }
    if case.rows.is_empty() {
        return text;
    }
    text.push_str(
        "<div class=\"scroll\"><table class=\"rows\">\n<thead><tr><th scope=\"col\">call</th><th scope=\"col\">difference</th><th scope=\"col\">golden</th>\
         <th scope=\"col\">actual</th><th scope=\"col\">exact oracle</th></tr></thead>\n<tbody>\n",
    );
    for row in &case.rows {
        let oracle = oracle(&case.whole.verdict(row.call));
        let [golden, actual] = sides(row);
        let _ = writeln!(
            text,
            "<tr class=\"question\"><td>{}</td><td colspan=\"4\">{}</td></tr>\n<tr><td></td><td>{}</td><td>{golden}</td><td>{actual}</td><td>{oracle}</td></tr>",
            row.call,
            escape(&row.question),
            row.cause.label(),
        );
    }
    text + "</tbody>\n</table></div>\n"
}

/// What the exact oracle says about an answer.
fn oracle(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Confirmed => "<span class=\"good\">confirms</span>".into(),
        Verdict::Refused(wrong) => {
            let wrong: Vec<&str> = wrong.iter().map(|aspect| Aspect::label(*aspect)).collect();
            format!("<span class=\"bad\">wrong: {}</span>", wrong.join(", "))
        }
        Verdict::NotJudged(open) => {
            let open = open.iter().map(|open| {
                format!(
                    "<span title=\"{}\">{}</span>",
                    escape(open.why),
                    open.aspect.label()
                )
            });
            let open: Vec<String> = open.collect();
            format!(
                "<span class=\"open\">not judged: {}</span>",
                open.join(", ")
            )
        }
    }
}

/// The golden and the actual answer, with the differing fields marked. Without a golden answer the
/// exact oracle's is shown.
fn sides(row: &Row) -> [String; 2] {
    let Some(golden) = &row.golden else {
        let exact = row.exact.as_ref().map(|line| answer(line, None));
        let exact = exact.map(|text| format!("<span class=\"note\">no row; exact:</span> {text}"));
        let actual = row.actual.as_ref().map(|line| answer(line, None));
        return [exact, actual].map(|side| side.unwrap_or("–".into()));
    };
    let actual = row.actual.as_ref();
    [
        answer(golden, Some(actual)),
        actual.map_or("–".into(), |line| answer(line, Some(Some(golden)))),
    ]
}

/// The answer in `line`; what `other` does not have is marked, if there is one to compare with.
fn answer(line: &Line, other: Option<Option<&Line>>) -> String {
    let is_marked = |field: &(String, Value)| {
        other.is_some_and(|other| other.is_none_or(|other| !other.answer.contains(field)))
    };
    if line.is_miss() {
        return match other {
            Some(_) => "<mark>miss</mark>".into(),
            None => "miss".into(),
        };
    }
    let fields = line.answer.iter().map(|field| {
        let text = escape(&format!("{}={}", field.0, field.1));
        match is_marked(field) {
            true => format!("<mark>{text}</mark>"),
            false => text,
        }
    });
    fields.collect::<Vec<String>>().join(" ")
}
