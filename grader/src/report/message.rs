//! The parts of the message about a wrong answer.

use super::wrap::{columns, shorten_numbers};
use crate::diagnosis::simplest::SimplestCall;
use crate::score::TaskResult;
use judge::findings::Message;
use judge::shown::ShownCall;

/// What is said where no case fails but those that also run other stages.
pub(crate) const WITH_NEIGHBOURS: &str = "Only cases fail that trace whole scenes, with your code \
    of other tasks, too: if one of these tasks fails, mend it first";

/// What cannot be judged in this run, a sentence for each case.
pub(super) fn undecided(task: &TaskResult) -> impl Iterator<Item = String> {
    task.cases.iter().flat_map(|case| {
        let of = |why| format!("{}/{} costs nothing: {why}", task.key, case.name);
        case.undecided().map(of)
    })
}

/// The input of the simplest call, with whole numbers as one writes them on paper. At a box the
/// sign of a zero may be what is wrong.
pub fn input(call: &SimplestCall) -> String {
    let text = on_paper(&call.input);
    match &call.shown {
        Some(ShownCall::Ray(ray)) if !ray.boxes.is_empty() => text,
        _ => without_signs_of_zeros(&text),
    }
}

/// Writes 0 for -0, as judges count them.
pub(crate) fn without_signs_of_zeros(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some(at) = rest.find("-0") {
        let (before, after) = rest.split_at(at);
        let is_number = before.ends_with(char::is_alphanumeric)
            || after[2..].starts_with(|c: char| c.is_ascii_digit() || c == '.');
        plain.push_str(before);
        plain.push_str(if is_number { "-0" } else { "0" });
        rest = &after[2..];
    }
    plain + rest
}

/// Writes 3 for 3.0, and `ray` in lower case inside a sentence.
pub(crate) fn on_paper(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(".0") {
        let (before, after) = rest.split_at(at);
        let is_whole = before.ends_with(|c: char| c.is_ascii_digit())
            && !after[2..].starts_with(|c: char| c.is_ascii_digit());
        plain.push_str(before);
        plain.push_str(if is_whole { "" } else { ".0" });
        rest = &after[2..];
    }
    plain.push_str(rest);
    plain.replace("Ray: o", "ray o")
}

/// What was found at the simplest call, without the question, in as few digits as show the
/// difference.
pub fn found(call: &SimplestCall) -> String {
    without_signs_of_zeros(&on_paper(&with_telling_digits(&call.result)))
}

/// The result with its reason, or without if the reason does not fit in `width` columns.
pub(crate) fn to_fit(message: &Message, width: usize) -> String {
    let whole = format!("{}{}", message.result, message.reason);
    match columns(&whole) > width {
        true => message.result.clone(),
        false => whole,
    }
}

/// The result with its reason, without the question, in as few digits as show that the code's
/// numbers differ from the expected ones.
pub fn with_telling_digits(message: &Message) -> String {
    let result = format!("{}{}", message.result, message.reason);
    match telling_digits(message) {
        Some(digits) => shorten_numbers(&result, digits),
        None => result,
    }
}

/// The fewest digits with which the numbers differ that are farthest apart; `None` if all are
/// necessary.
fn telling_digits(message: &Message) -> Option<usize> {
    let mut digits = [3, 4, 6, 8, 10, 12, 14, 16].into_iter();
    match message.farthest_apart() {
        Some(numbers) => digits.find(|digits| {
            let [yours, expected] = numbers.map(|x| printed(x, *digits));
            yours != expected
        }),
        None => digits.next(),
    }
}

/// The numbers that are farthest apart as they are printed, if a reader sees no difference.
pub(crate) fn looks_equal(message: &Message) -> Option<String> {
    let numbers = message.farthest_apart()?;
    let digits = telling_digits(message).unwrap_or(usize::MAX);
    let [yours, expected] = numbers.map(|x| printed(x, digits));
    (yours == expected).then(|| format!("{yours} twice in \"{}\"", with_telling_digits(message)))
}

/// A number as it is printed with at most so many digits.
fn printed(x: f64, digits: usize) -> f64 {
    let text = shorten_numbers(&format!("{x:?}"), digits);
    text.parse().unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_digits_are_shown_as_differ() {
        let of = |yours: f64| {
            let result = format!("t: your result: t = {yours}; expected: t = 8.825531");
            with_telling_digits(&Message::new(result).compares([yours], [8.825531]))
        };
        assert_eq!(of(7.125531), "t: your result: t = 7.13; expected: t = 8.83");
        assert_eq!(
            of(8.825538),
            "t: your result: t = 8.82554; expected: t = 8.82553"
        );
        assert_eq!(of(f64::NAN), "t: your result: t = NaN; expected: t = 8.83");
        assert_eq!(with_telling_digits(&"4.123456 boxes".into()), "4.12 boxes");
    }

    /// Words before a number are not the same, and hide nothing.
    #[test]
    fn digits_are_chosen_from_the_numbers() {
        let ends = "your result: the interval ends at t = 1.0001; expected: t = 1";
        let message = Message::new(ends.into()).compares([1.0001], [1.0]);
        assert_eq!(with_telling_digits(&message), ends);
        // What is equal but for rounding does not add digits.
        let vectors = "your result: (0.30000000000000004, 2.5, 0); expected: (0.3, 2.0, 0)";
        let message =
            Message::new(vectors.into()).compares([0.1 + 0.2, 2.5, -0.0], [0.3, 2.0, 0.0]);
        let short = "your result: (0.3, 2.5, 0); expected: (0.3, 2.0, 0)";
        assert_eq!(with_telling_digits(&message), short);
        // A sign alone is a difference.
        let sign = Message::new("f = -0.0001; expected: 0.0001".into()).compares([-1e-4], [1e-4]);
        assert_eq!(telling_digits(&sign), Some(3));
    }

    #[test]
    fn whole_numbers_are_written_as_on_paper() {
        let text = "Ray: o = (3.0, -1.0, 0.05), d = (10.0, 0.5, 2.01), t in [0.0, inf]";
        let plain = "ray o = (3, -1, 0.05), d = (10, 0.5, 2.01), t in [0, inf]";
        assert_eq!(on_paper(text), plain);
    }

    #[test]
    fn a_zero_has_no_sign() {
        let text = "c2w = [(-1, -0, -0.5)], x-0 and 1e-05, t = -0";
        let plain = "c2w = [(-1, 0, -0.5)], x-0 and 1e-05, t = 0";
        assert_eq!(without_signs_of_zeros(text), plain);
    }

    #[test]
    fn a_reason_is_left_out_before_a_result_is_cut() {
        let message = Message::new("hit; expected: miss".into())
            .because(", because it is beside".into())
            .asked("Ray: o = 1".into());
        assert_eq!(
            to_fit(&message, 80),
            "hit; expected: miss, because it is beside"
        );
        assert_eq!(to_fit(&message, 20), "hit; expected: miss");
    }
}
