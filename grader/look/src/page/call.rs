//! One call on the page: the question, and golden, actual and exact answer field by field.

use super::words::Words;
use crate::calls::Row;
use crate::delta;
use judge::findings::Aspect;
use judge::snapshot::{Line, Value};
use judge::whole::Verdict;
use pages::html::{chip, escape};
use std::fmt::Write;

/// Formats a call below its heading, which is text.
pub fn call(row: &Row, heading: &str, verdict: &Verdict, words: &Words) -> String {
    let mut text = format!(
        "<section class=\"call\"><h4>{}{}</h4>\n{}",
        chip(row.cause.colour()),
        escape(heading),
        oracle(verdict, words)
    );
    if !row.question.is_empty() {
        let _ = writeln!(text, "<p class=\"asked\">{}</p>", escape(&row.question));
    }
    if row.golden.is_none() {
        let why = match row.exact {
            Some(_) => words.instead,
            None => words.only_colour,
        };
        let _ = writeln!(text, "<p class=\"note\">{}</p>", escape(why));
    }
    text.push_str(&record(row, matches!(verdict, Verdict::Refused(_)), words));
    text + "</section>\n"
}

/// What the exact oracle says about an answer.
fn oracle(verdict: &Verdict, words: &Words) -> String {
    match verdict {
        Verdict::Confirmed => format!("<p class=\"good\">{}</p>\n", words.confirmed),
        Verdict::Refused(wrong) => {
            let wrong: Vec<&str> = wrong.iter().map(|aspect| Aspect::label(*aspect)).collect();
            format!(
                "<p class=\"bad\">{}: {}.</p>\n",
                words.refuted,
                wrong.join(", ")
            )
        }
        Verdict::NotJudged(open) => {
            let open = open
                .iter()
                .map(|open| format!("{} ({})", open.aspect.label(), escape(open.why)));
            let open: Vec<String> = open.collect();
            format!(
                "<p class=\"open\">{}: {}.</p>\n",
                words.open,
                open.join("; ")
            )
        }
    }
}

/// The fields that differ, or all of them if the answer is wrong.
fn record(row: &Row, all: bool, words: &Words) -> String {
    let sides = [&row.golden, &row.actual, &row.exact].map(Option::as_ref);
    let [golden, actual, exact] = sides;
    let mut text = String::from("<table class=\"record\"><tbody>\n");
    let is_miss = |side: Option<&Line>| side.map(Line::is_miss);
    let misses = [
        is_miss(golden).or(row.golden_hits.map(|hits| !hits)),
        is_miss(actual),
        is_miss(exact),
    ];
    if misses.contains(&Some(true)) || row.golden_hits.is_some() {
        let answer = |miss: bool| if miss { "miss" } else { "hit" };
        let differs = misses[0].is_some_and(|golden| misses[1].is_some_and(|new| new != golden));
        let lines = misses.map(|miss| {
            miss.map(|miss| match differs {
                true => format!("<mark>{}</mark>", answer(miss)),
                false => answer(miss).to_string(),
            })
        });
        text.push_str(&field("answer", lines, [const { String::new() }; 3], words));
    }
    let mut same = Vec::new();
    for (name, nth) in names(&sides) {
        let [golden, actual, exact] =
            sides.map(|side| side.and_then(|line| value(line, name, nth)));
        let differs = match (golden, actual) {
            (Some(golden), Some(actual)) => golden != actual,
            (Some(_), None) => true,
            (None, Some(_)) => row.golden.as_ref().is_none_or(Line::is_miss),
            (None, None) => false,
        };
        if !differs && !all {
            same.push(name);
            continue;
        }
        let off = |value: Option<&Value>| match value.zip(exact) {
            Some((value, exact)) => format!("{} from exact", delta::text(exact, value)),
            None => String::new(),
        };
        let change = golden.zip(actual).map(|(a, b)| delta::text(a, b));
        let notes = [
            off(golden),
            match change {
                Some(change) => format!("Δ {change}; {}", off(actual)),
                None => off(actual),
            },
            String::new(),
        ];
        let base = golden.or(exact);
        let lines = [
            golden.map(|value| marked(value, actual)),
            actual.map(|value| marked(value, base)),
            exact.map(|value| marked(value, None)),
        ];
        text.push_str(&field(name, lines, notes, words));
    }
    text.push_str("</tbody></table>\n");
    same.dedup();
    if !same.is_empty() {
        let _ = writeln!(
            text,
            "<p class=\"note\">Not shown, because they are equal or not stored: {}.</p>",
            escape(&same.join(", "))
        );
    }
    text
}

/// The lines of a field: golden, actual and exact value, as HTML, and a note about each, as text.
fn field(name: &str, lines: [Option<String>; 3], notes: [String; 3], words: &Words) -> String {
    let who = [words.golden, words.actual, words.exact];
    let classes = ["golden", "actual", "exact"];
    let shown: Vec<usize> = (0..3).filter(|i| lines[*i].is_some()).collect();
    let mut text = String::new();
    for (i, &side) in shown.iter().enumerate() {
        text.push_str("<tr>");
        if i == 0 {
            let _ = write!(
                text,
                "<th scope=\"rowgroup\" rowspan=\"{}\">{}</th>",
                shown.len(),
                escape(name)
            );
        }
        let _ = writeln!(
            text,
            "<td class=\"who\">{}</td><td data-field=\"{}.{}\">{}</td><td class=\"delta\">{}</td></tr>",
            who[side],
            classes[side],
            escape(name),
            lines[side].as_deref().unwrap_or_default(),
            escape(notes[side].trim_end_matches("; "))
        );
    }
    text
}

/// A value; the digits that `other`, if there is one, does not have are marked.
fn marked(value: &Value, other: Option<&Value>) -> String {
    let pieces = delta::digits(value, other.unwrap_or(value)).into_iter();
    pieces
        .map(|(text, changed)| match changed {
            true => format!("<mark>{}</mark>", escape(&text)),
            false => escape(&text),
        })
        .collect()
}

/// The names of all fields, in the order in which they first occur; the second field of a name has
/// the number 1.
fn names<'a>(sides: &[Option<&'a Line>]) -> Vec<(&'a str, usize)> {
    let mut names = Vec::new();
    for line in sides.iter().flatten() {
        for (i, (name, _)) in line.answer.iter().enumerate() {
            let before = line.answer[..i].iter();
            let nth = before.filter(|(other, _)| other == name).count();
            if !names.contains(&(name.as_str(), nth)) {
                names.push((name.as_str(), nth));
            }
        }
    }
    names
}

fn value<'a>(line: &'a Line, name: &str, nth: usize) -> Option<&'a Value> {
    let mut fields = line.answer.iter().filter(|(field, _)| field == name);
    fields.nth(nth).map(|(_, value)| value)
}
