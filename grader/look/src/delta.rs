//! How much two values differ: in units in the last place, and digit by digit.

use judge::snapshot::{Fields, Line, Value};
use std::cmp::Ordering;

/// From this difference on, units in the last place are no longer counted.
const MANY_ULPS: f64 = 1e6;

/// The largest difference of the numbers of two values, in units in the last place of the largest
/// number of `golden`; infinite if the values have other shapes, or are not finite.
pub fn ulps(golden: &Value, actual: &Value) -> f64 {
    let (a, b) = (golden.numbers(), actual.numbers());
    if a.len() != b.len() {
        return f64::INFINITY;
    }
    let largest = a.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let ulp = largest.next_up() - largest;
    let pairs = a.iter().zip(&b).filter(|(a, b)| a.to_bits() != b.to_bits());
    pairs
        .map(|(a, b)| match ((a - b) / ulp).abs() {
            difference if difference.is_nan() => f64::INFINITY,
            difference => difference,
        })
        .fold(0.0, f64::max)
}

/// The difference as text: "3 ulp" if it is small, "0.25" if it is not.
pub fn text(golden: &Value, actual: &Value) -> String {
    let ulps = ulps(golden, actual);
    if ulps < MANY_ULPS {
        // 0 and -0 differ by no unit.
        return format!("{} ulp", (ulps * 10.0).round() / 10.0);
    }
    let pairs = golden.numbers().into_iter().zip(actual.numbers());
    let difference = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    match difference.is_finite() && ulps.is_finite() {
        true => format!("{difference:.3e}"),
        false => "∞".into(),
    }
}

/// A value as text, in pieces: whether each piece differs from `other`. Of numbers of equal
/// magnitude, only the last digits differ.
pub fn digits(value: &Value, other: &Value) -> Vec<(String, bool)> {
    let (numbers, others) = (value.numbers(), other.numbers());
    let (open, close) = match value {
        Value::Number(_) => ("", ""),
        Value::Vector(_) => ("(", ")"),
        Value::Range(..) => ("[", "]"),
    };
    let mut pieces = vec![(open.to_string(), false)];
    for (i, number) in numbers.iter().enumerate() {
        if i > 0 {
            pieces.push((", ".into(), false));
        }
        let text = Value::Number(*number).to_string();
        let other = others.get(i).map(|other| Value::Number(*other).to_string());
        let same = other.map_or(0, |other| common(&text, &other));
        let (same, changed) = text.split_at(same);
        pieces.push((same.into(), false));
        pieces.push((changed.into(), true));
    }
    pieces.push((close.into(), false));
    pieces.retain(|(text, _)| !text.is_empty());
    pieces
}

/// The length of the digits that two numbers have in common: 0 if their magnitudes differ.
fn common(a: &str, b: &str) -> usize {
    let magnitude = |text: &str| {
        let mantissa = text.split('e').next().unwrap_or_default().len();
        (
            text.find('.').unwrap_or(mantissa),
            text.get(mantissa..).map(str::to_string),
        )
    };
    if magnitude(a) != magnitude(b) {
        return 0;
    }
    let same = a.bytes().zip(b.bytes()).take_while(|(a, b)| a == b);
    same.count()
}

/// Which of two answers is nearer to the exact one: `Less` if `golden` is. The first field decides
/// in which they differ: hit or miss, the primitive, then each number. `None` if the exact answer
/// does not have this field.
pub fn nearer(golden: &Line, actual: &Line, exact: &Fields) -> Option<Ordering> {
    if golden.is_miss() != actual.is_miss() {
        let golden_is_right = golden.is_miss() == exact.is_empty();
        return Some(match golden_is_right {
            true => Ordering::Less,
            false => Ordering::Greater,
        });
    }
    let differs = |(name, value): &&(String, Value)| actual.get(name) != Some(value);
    let (name, old) = golden.answer.iter().find(differs)?;
    let new = actual.get(name)?;
    let (_, truth) = exact.iter().find(|(field, _)| field == name)?;
    let off = |value: &Value| {
        let pairs = value.numbers().into_iter().zip(truth.numbers());
        pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f64>()
    };
    off(old).partial_cmp(&off(new))
}

#[cfg(test)]
mod tests {
    use super::*;
    use judge::snapshot::parse;

    fn line(text: &str) -> Line {
        parse(&format!("0: -> {text}\n")).expect("a row").lines[0].clone()
    }

    fn value(text: &str) -> Value {
        let line = line(&format!("x={text}"));
        line.get("x").expect("the field").clone()
    }

    #[test]
    fn small_differences_are_counted_in_ulps_of_the_largest_number() {
        let text = |a: &str, b: &str| text(&value(a), &value(b));
        assert_eq!(text("1", "1.0000000000000004"), "2 ulp");
        assert_eq!(text("(1,0,1e-300)", "(1,0,2e-300)"), "0 ulp");
        assert_eq!(text("4", "4.25"), "2.500e-1");
        assert_eq!(text("1", "inf"), "∞");
        assert_eq!(text("NaN", "1"), "∞");
    }

    #[test]
    fn only_the_changed_digits_are_marked() {
        let marked = |a: &str, b: &str| -> String {
            let pieces = digits(&value(a), &value(b)).into_iter();
            pieces
                .map(|(text, changed)| match changed {
                    true => format!("<{text}>"),
                    false => text,
                })
                .collect()
        };
        assert_eq!(marked("8.5712", "8.5734"), "8.57<12>");
        assert_eq!(marked("85.5", "8.55"), "<85.5>", "another magnitude");
        assert_eq!(marked("1.5e-7", "1.5e-9"), "<1.5e-7>");
        assert_eq!(marked("(1,2.5,3)", "(1,2.25,3)"), "(1, 2.<5>, 3)");
        assert_eq!(marked("7", "7"), "7");
    }

    #[test]
    fn the_first_field_that_differs_decides_what_is_nearer() {
        let exact = line("t=2 prim=1 p=(0,0,1)").answer;
        let nearer = |a: &str, b: &str| nearer(&line(a), &line(b), &exact);
        let full = "t=2 prim=1 p=(0,0,1)";
        assert_eq!(nearer("miss", full), Some(Ordering::Greater));
        assert_eq!(
            nearer("t=2.25 prim=1", "t=1.5 prim=1"),
            Some(Ordering::Less)
        );
        let as_far = nearer("t=2.25 prim=1", "t=1.75 prim=1");
        assert_eq!(as_far, Some(Ordering::Equal));
        assert_eq!(
            nearer("t=2 prim=1 p=(0,0,3)", full),
            Some(Ordering::Greater)
        );
        assert_eq!(nearer("t=2 w=1", "t=2 w=2"), None);
    }
}
