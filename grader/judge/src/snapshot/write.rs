//! Writing a snapshot.

use super::hash::RowsHash;
use super::line::{Line, Value};
use super::parse::Snapshot;
use crate::check::Content;
use crate::tasks;
use wire::answer::Hit;
use wire::{Answer, Work};

/// The largest number of calls for which a snapshot has a row for each call.
pub const ALL_ROWS: usize = 640;

/// The largest number of rows of a case with more calls than [`ALL_ROWS`].
const SAMPLED_ROWS: usize = 200;

/// The number of rows of a case that have the question and the whole record.
pub const FULL_ROWS: usize = 48;

/// The text of the snapshot of `answer` to `work`; `None` for answers that differ between runs
/// (measured times).
pub fn write(work: &Work, answer: &Answer) -> Option<String> {
    let (totals, forms) = content(work, answer)?;
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
    Some(text)
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

/// The snapshot of `answer` to `work` with a row for every call, each with its question and the
/// whole record.
pub fn full(work: &Work, answer: &Answer) -> Option<Snapshot> {
    let (totals, forms) = content(work, answer)?;
    let lines: Vec<Line> = forms.into_iter().map(|(_, full)| full).collect();
    Some(Snapshot {
        calls: lines.len(),
        hash: Some(hash(lines.iter())),
        totals: Line {
            answer: totals,
            ..Line::default()
        },
        lines,
    })
}

/// The totals of a case and its numbered rows, from the check of its kind of work.
fn content(work: &Work, answer: &Answer) -> Option<Content> {
    let (totals, mut forms) = tasks::check_of(work).lines(answer)?;
    for (call, (short, full)) in (0..).zip(&mut forms) {
        short.call = call;
        full.call = call;
    }
    Some((totals, forms))
}

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

#[cfg(test)]
mod tests {
    use super::super::{changes, parse};
    use super::*;
    use wire::work::{BoxWork, Probe, Ray};

    fn boxes(calls: usize) -> (Work, Vec<Option<[f64; 2]>>) {
        let ray = Ray {
            o: [0.0; 3],
            d: [0.0, 0.0, 1.0],
            min_t: 0.0,
            max_t: f64::INFINITY,
        };
        let work = Work::Boxes(BoxWork {
            boxes: vec![[[0.0; 3], [1.0; 3]]],
            probes: vec![Probe { shape: 0, ray }; calls],
        });
        let answers = (0..calls).map(|call| (call % 3 > 0).then_some([call as f64, 1e9]));
        (work, answers.collect())
    }

    #[test]
    fn a_large_case_has_a_sample_of_its_rows() {
        for (calls, rows) in [(640, 640), (641, 129), (19_200, 198)] {
            let (work, answers) = boxes(calls);
            let snapshot = parse(&write(&work, &Answer::Boxes(answers)).unwrap()).unwrap();
            assert_eq!((snapshot.calls, snapshot.lines.len()), (calls, rows));
            let full = snapshot.lines.iter().filter(|row| !row.question.is_empty());
            assert!((30..=FULL_ROWS).contains(&full.count()));
        }
    }

    #[test]
    fn every_bit_of_every_answer_is_in_the_hash() {
        let (work, answers) = boxes(3000);
        let snapshot = |answers: &Vec<_>| {
            parse(&write(&work, &Answer::Boxes(answers.clone())).unwrap()).unwrap()
        };
        let golden = snapshot(&answers);
        for call in [1, 1000, 2999] {
            let mut other = answers.clone();
            other[call] = match other[call] {
                Some([from, to]) => Some([from, to.next_up()]),
                None => Some([0.0, 0.0]),
            };
            assert!(changes(&golden, &snapshot(&other)).hash, "call {call}");
        }
    }

    #[test]
    fn full_has_the_hash_that_is_written() {
        let (work, answers) = boxes(700);
        let answer = Answer::Boxes(answers);
        let full = full(&work, &answer).unwrap();
        let written = parse(&write(&work, &answer).unwrap()).unwrap();
        assert!(full.is_whole());
        assert_eq!((full.calls, full.hash), (written.calls, written.hash));
    }
}
