//! Writing a snapshot.

use super::line::{Line, Value};
use super::parse::Snapshot;
use crate::check::Content;
use crate::tasks;
use wire::answer::Hit;
use wire::{Answer, Work};

/// How many lines of a case have the question and the whole record.
pub const FULL_LINES: usize = 48;

/// The text of the snapshot of `answer` to `work`; `None` for what is different every time (times).
pub fn write(work: &Work, answer: &Answer) -> Option<String> {
    let (totals, lines) = content(work, answer)?;
    let mut text = String::new();
    if !totals.is_empty() {
        let fields: Vec<String> = totals
            .iter()
            .map(|(name, value)| format!("{name}={value}"))
            .collect();
        text.push_str(&format!("# {}\n", fields.join(" ")));
    }
    let stride = lines.len().div_ceil(FULL_LINES).max(1);
    for (i, (short, full)) in lines.into_iter().enumerate() {
        let line = if i % stride == 0 { full } else { short };
        text.push_str(&format!(
            "{}\n",
            Line {
                call: u32::try_from(i).unwrap_or(u32::MAX),
                ..line
            }
        ));
    }
    Some(text)
}

/// What a snapshot of `answer` to `work` would say if every line had its question and the whole
/// record.
pub fn full(work: &Work, answer: &Answer) -> Option<Snapshot> {
    let (totals, lines) = content(work, answer)?;
    let lines = (0..).zip(lines);
    Some(Snapshot {
        totals: Line {
            answer: totals,
            ..Line::default()
        },
        lines: lines
            .map(|(call, (_, full))| Line { call, ..full })
            .collect(),
    })
}

/// Names and values.
pub type Fields = Vec<(String, Value)>;

/// The short and the full form of a line.
pub(crate) type Forms = (Line, Line);

/// What a snapshot says of `answer`, by the check of its kind of work.
fn content(work: &Work, answer: &Answer) -> Option<Content> {
    tasks::check_of(work).lines(answer)
}

/// The fields of a hit; the first two are its main figures.
pub fn record(hit: &Hit) -> Fields {
    vec![
        number("t", hit.t),
        number("prim", f64::from(hit.prim)),
        field("uv", vector(&hit.uv)),
        field("p", vector(&hit.p)),
        field("n", vector(&hit.n)),
        field("ng", vector(&hit.ng)),
    ]
}

/// A line in both its forms: the question is in the full one alone.
pub(crate) fn forms(question: Fields, short: Fields, full: Fields) -> Forms {
    (
        Line {
            answer: short,
            ..Line::default()
        },
        Line {
            question,
            answer: full,
            ..Line::default()
        },
    )
}

/// A field.
pub(crate) fn field(name: &str, value: Value) -> (String, Value) {
    (name.to_string(), value)
}

/// A field of one number.
pub(crate) fn number(name: &str, number: f64) -> (String, Value) {
    field(name, Value::Number(number))
}

/// The value of a vector.
pub(crate) fn vector(numbers: &[f64]) -> Value {
    Value::Vector(numbers.to_vec())
}
