//! Tables of golden and actual answers.

use crate::case::{Case, ROWS, Row, State};
use judge::snapshot::{Fields, Line};
use pages::html::escape;
use std::fmt::Write;

/// Formats the calls that differ, golden and actual side by side.
pub(super) fn rows(case: &Case) -> String {
    let mut text = String::new();
    if let State::Differs { changes, .. } = &case.state {
        if changes.totals {
            text.push_str("<p>The totals of the case differ, too.</p>\n");
        }
        let differing = changes.differing.len() + changes.calls;
        if differing > ROWS {
            let _ = writeln!(
                text,
                "<p class=\"note\">The first {ROWS} of {differing} calls that differ.</p>"
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
        let wrong = case.wrong.get(&row.call);
        let oracle = match wrong {
            Some(wrong) => format!(
                "<span class=\"bad\">wrong: {}</span>",
                escape(&wrong.join(", "))
            ),
            None => "<span class=\"good\">confirms</span>".into(),
        };
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

/// The golden and the actual answer, with the differing fields marked.
fn sides(row: &Row) -> [String; 2] {
    let nothing = Fields::new();
    let fields = |line: &Option<Line>| {
        line.as_ref()
            .map_or(nothing.clone(), |line| line.answer.clone())
    };
    let (golden, actual) = (fields(&row.golden), fields(&row.actual));
    [
        (&row.golden, &golden, &actual),
        (&row.actual, &actual, &golden),
    ]
    .map(|(line, own, other)| match line {
        None => "–".into(),
        Some(line) if line.is_miss() => "<mark>miss</mark>".into(),
        Some(_) => {
            let field = |field: &(String, _)| {
                let (name, value) = field;
                let text = escape(&format!("{name}={value}"));
                if other.contains(field) {
                    text
                } else {
                    format!("<mark>{text}</mark>")
                }
            };
            let texts: Vec<String> = own.iter().map(field).collect();
            texts.join(" ")
        }
    })
}
