//! Writing a snapshot.

use super::hash::RowsHash;
use super::line::{Line, Value};
use super::parse::Snapshot;
use wire::answer::Hit;

/// The largest number of calls for which a snapshot has a row for each call.
pub const ALL_ROWS: usize = 640;

/// The largest number of rows of a case with more calls than [`ALL_ROWS`].
const SAMPLED_ROWS: usize = 200;

/// The number of rows of a case that have the question and the whole record.
pub const FULL_ROWS: usize = 48;

/// The text of a snapshot.
pub(crate) fn write(content: Content) -> String {
    let (totals, forms) = numbered(content);
    let calls = forms.len();
    let hash = hash(forms.iter().map(|(_, full)| full));
    let mut text = format!("# calls={calls} hash={hash}\n");
    if !totals.is_empty() {
        let fields: Vec<String> = totals
            .iter()
            .map(|(name, value)| format!("{name}={value}"))
            .collect();
        text.push_str(&format!("# {}\n", fields.join(" ")));
    }
    let rows: Vec<Forms> = forms.into_iter().step_by(row_stride(calls)).collect();
    let stride = rows.len().div_ceil(FULL_ROWS).max(1);
    for (i, (short, full)) in rows.into_iter().enumerate() {
        let row = if i % stride == 0 { full } else { short };
        text.push_str(&format!("{row}\n"));
    }
    text
}

/// The distance between the numbers of two calls that have a row. It is 1 or another odd number, so
/// that the sample has pixels in all columns of a picture whose width is a power of 2.
fn row_stride(calls: usize) -> usize {
    if calls <= ALL_ROWS {
        1
    } else {
        calls.div_ceil(SAMPLED_ROWS) | 1
    }
}

/// The hash of the text of `rows`.
fn hash<'a>(rows: impl Iterator<Item = &'a Line>) -> RowsHash {
    rows.fold(RowsHash::EMPTY, |hash, row| hash.then(&format!("{row}\n")))
}

/// A snapshot with a row for every call, each with its question and the whole record.
pub(crate) fn full(content: Content) -> Snapshot {
    let (totals, forms) = numbered(content);
    let lines: Vec<Line> = forms.into_iter().map(|(_, full)| full).collect();
    Snapshot {
        calls: lines.len(),
        hash: Some(hash(lines.iter())),
        totals: Line {
            answer: totals,
            ..Line::default()
        },
        lines,
    }
}

/// The same content with the numbers of the calls.
fn numbered((totals, mut forms): Content) -> Content {
    for (call, (short, full)) in (0..).zip(&mut forms) {
        short.call = call;
        full.call = call;
    }
    (totals, forms)
}

/// The content of a snapshot: the totals, and each line in its short and its full form.
pub(crate) type Content = (Fields, Vec<Forms>);

/// Names and values.
pub type Fields = Vec<(String, Value)>;

/// The short and the full form of a row.
pub(crate) type Forms = (Line, Line);

/// The fields of a hit; the first two are the main fields.
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

/// The short and the full form of a row. Only the full form has the question.
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
