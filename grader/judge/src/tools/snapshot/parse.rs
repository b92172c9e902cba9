//! Reading a snapshot.

use super::hash::RowsHash;
use super::line::{Line, MISS, Value};
use std::fmt;

/// A snapshot that was read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// How many calls the case has.
    pub calls: usize,
    /// The hash of the full rows of all calls; `None` if the text has no hash.
    pub hash: Option<RowsHash>,
    /// Fields of the whole case, from lines that begin with `#`.
    pub totals: Line,
    /// The rows of all calls or of a sample, in the order of their calls.
    pub lines: Vec<Line>,
}

impl Snapshot {
    /// The row of a call, if it has one.
    pub fn row(&self, call: u32) -> Option<&Line> {
        let place = self.lines.binary_search_by_key(&call, |line| line.call);
        place.ok().map(|place| &self.lines[place])
    }

    /// Whether every call has a row.
    pub fn is_whole(&self) -> bool {
        self.lines.len() == self.calls
    }
}

/// A line that a snapshot cannot contain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParseError {
    /// Counted from 1.
    pub line: usize,
    /// What was expected there.
    pub expected: &'static str,
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: expected {}", self.line, self.expected)
    }
}

impl std::error::Error for ParseError {}

/// Reads the text of a `.snap` file. Skips insta's header (between two lines `---`).
pub fn parse(text: &str) -> Result<Snapshot, ParseError> {
    let mut snapshot = Snapshot::default();
    let mut in_header = text.starts_with("---\n");
    for (i, text) in text.lines().enumerate() {
        if text == "---" {
            in_header &= i == 0;
            continue;
        }
        if in_header || text.is_empty() {
            continue;
        }
        let error = |expected| ParseError {
            line: i + 1,
            expected,
        };
        if let Some(totals) = text.strip_prefix('#') {
            comment(&mut snapshot, totals).ok_or(error("`# name=value ...`"))?;
            continue;
        }
        let line = line(text).ok_or(error("`call: name=value ... -> name=value ...`"))?;
        let last = snapshot.lines.last().map(|line| line.call);
        if last.is_some_and(|last| line.call <= last) {
            return Err(error("a later call"));
        }
        snapshot.lines.push(line);
    }
    // If the text has no number of calls, every call has a row.
    if snapshot.calls == 0 {
        snapshot.calls = snapshot.lines.len();
    }
    Ok(snapshot)
}

/// Reads a line that begins with `#`: the data of the whole case.
fn comment(snapshot: &mut Snapshot, text: &str) -> Option<()> {
    for field in text.split_whitespace() {
        let (name, text) = field.split_once('=')?;
        match name {
            "calls" => snapshot.calls = text.parse().ok()?,
            "hash" => snapshot.hash = Some(text.parse().ok()?),
            _ => {
                let total = (name.to_string(), value(text)?);
                snapshot.totals.answer.push(total);
            }
        }
    }
    Some(())
}

fn line(text: &str) -> Option<Line> {
    let (call, rest) = text.split_once(':')?;
    let (question, answer) = rest.split_once("->")?;
    let answer = if answer.trim() == MISS {
        Vec::new()
    } else {
        fields(answer)?
    };
    Some(Line {
        call: call.parse().ok()?,
        question: fields(question)?,
        answer,
    })
}

fn fields(text: &str) -> Option<Vec<(String, Value)>> {
    let pairs = text.split_whitespace().map(|field| field.split_once('='));
    pairs
        .map(|pair| pair.and_then(|(name, text)| Some((name.to_string(), value(text)?))))
        .collect()
}

fn value(text: &str) -> Option<Value> {
    let numbers = |inside: &str| {
        inside
            .split(',')
            .map(|number| number.parse().ok())
            .collect::<Option<Vec<f64>>>()
    };
    if let Some(inside) = text
        .strip_prefix('(')
        .and_then(|rest| rest.strip_suffix(')'))
    {
        return Some(Value::Vector(numbers(inside)?));
    }
    if let Some(inside) = text
        .strip_prefix('[')
        .and_then(|rest| rest.strip_suffix(']'))
    {
        let [min, max] = numbers(inside)?.try_into().ok()?;
        return Some(Value::Range(min, max));
    }
    text.parse().ok().map(Value::Number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_are_read_back_bit_for_bit() {
        for number in [0.1, -0.0, 5e-324, f64::MAX, f64::INFINITY, 1.0 / 3.0] {
            let text = format!("0: -> t={}\n", Value::Number(number));
            let read = parse(&text).unwrap().lines[0].number("t").unwrap();
            assert_eq!(read.to_bits(), number.to_bits(), "{text}");
        }
    }

    #[test]
    fn instas_header_is_skipped() {
        let snapshot = parse("---\nsource: golden/tests/goldens.rs\n---\n0: -> miss\n").unwrap();
        assert!(snapshot.lines[0].is_miss());
    }

    #[test]
    fn rows_out_of_order_are_an_error_with_its_place() {
        let error = parse("2: -> miss\n0: -> miss\n").unwrap_err();
        assert_eq!(error.to_string(), "line 2: expected a later call");
    }

    #[test]
    fn a_sample_has_some_rows_and_the_hash_of_all() {
        let text =
            "# calls=20 hash=6c62272e07bb014262b821756295c58d\n# nodes=3\n0: -> t=1\n7: -> miss\n";
        let sample = parse(text).unwrap();
        assert_eq!((sample.calls, sample.hash), (20, Some(RowsHash::EMPTY)));
        assert_eq!(sample.totals.number("nodes"), Some(3.0));
        assert!(sample.row(7).is_some_and(Line::is_miss));
        assert!(sample.row(1).is_none() && !sample.is_whole());
    }

    #[test]
    fn a_line_without_an_answer_is_an_error() {
        assert_eq!(parse("0: t=1\n").unwrap_err().line, 1);
    }
}
