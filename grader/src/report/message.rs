//! The parts of the message about a wrong answer.

use super::wrap::{columns, shorten_numbers};
use crate::diagnosis::simplest::SimplestCall;
use crate::score::TaskResult;

/// What is said where no case fails but those that also run other stages.
pub(crate) const WITH_NEIGHBOURS: &str = "Only cases fail that trace whole scenes, with your code \
    of other tasks, too: if one of these tasks fails, mend it first";

/// The result and the question: what stands before and after ". Ray: ". Not every message has a
/// question.
pub(crate) fn parts(message: &str) -> (&str, Option<&str>) {
    match message.split_once(". Ray: ") {
        Some((result, ray)) => (result, Some(ray)),
        None => (message, None),
    }
}

/// What cannot be judged in this run, a sentence for each case.
pub(super) fn undecided(task: &TaskResult) -> impl Iterator<Item = String> {
    task.cases.iter().flat_map(|case| {
        let of = |why| format!("{}/{} costs nothing: {why}", task.key, case.name);
        case.undecided().map(of)
    })
}

/// The input of the simplest call, with whole numbers as one writes them on paper.
pub fn input(call: &SimplestCall) -> String {
    on_paper(&call.input)
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
    on_paper(&with_telling_digits(without_question(&call.result)))
}

/// How the question begins that judges repeat after a result.
const QUESTIONS: [&str; 13] = [
    ". Ray: ",
    ". Sensor point ",
    ". Pixel ",
    ". Box: (",
    ". Point [",
    ". lambert_",
    ". play_roulette(",
    ". Fresnel {",
    ". Reflect {",
    ". Refract {",
    ". Mirror {",
    ". Refraction {",
    ". Glass {",
];

fn without_question(message: &str) -> &str {
    let ends = QUESTIONS
        .iter()
        .filter_map(|question| message.find(question));
    &message[..ends.min().unwrap_or(message.len())]
}

/// The result, without the reason at its end if it does not fit in `width` columns.
pub(crate) fn without_reason(result: &str, width: usize) -> &str {
    let reasons = [", because ", ", since "];
    let cut = reasons.iter().find_map(|reason| result.split_once(reason));
    match cut {
        Some((short, _)) if columns(result) > width => short,
        _ => result,
    }
}

/// The result with as few digits as show that it differs from the expected one.
pub fn with_telling_digits(result: &str) -> String {
    let differs = |text: &str| match text.split_once("; expected: ") {
        Some((yours, expected)) => {
            let yours = yours
                .rsplit_once("your result: ")
                .map_or(yours, |(_, yours)| yours);
            !expected.starts_with(yours)
        }
        None => true,
    };
    let digits = [3, 4, 6, 8, 10, 12, 14, 16];
    let texts = digits.iter().map(|digits| shorten_numbers(result, *digits));
    let telling = texts.into_iter().find(|text| differs(text));
    telling.unwrap_or_else(|| result.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_digits_are_shown_as_differ() {
        let of = |yours: f64| {
            with_telling_digits(&format!(
                "t: your result: t = {yours}; expected: t = 8.825531"
            ))
        };
        assert_eq!(of(7.125531), "t: your result: t = 7.13; expected: t = 8.83");
        assert_eq!(
            of(8.825538),
            "t: your result: t = 8.82554; expected: t = 8.82553"
        );
        assert_eq!(with_telling_digits("4.123456 boxes"), "4.12 boxes");
    }

    #[test]
    fn a_result_is_shown_without_its_question() {
        let result = "your result: d = (0, 1, -1) of length 1.4; expected: length 1";
        let message = format!("{result}. Sensor point (0.5, 1), h_fov = 90");
        assert_eq!(without_question(&message), result);
        assert_eq!(without_question(result), result);
        let stop = "your result: true; expected: false. 2 samples with the mean 1";
        assert_eq!(without_question(stop), stop);
    }

    #[test]
    fn whole_numbers_are_written_as_on_paper() {
        let text = "Ray: o = (3.0, -1.0, 0.05), d = (10.0, 0.5, 2.01), t in [0.0, inf]";
        let plain = "ray o = (3, -1, 0.05), d = (10, 0.5, 2.01), t in [0, inf]";
        assert_eq!(on_paper(text), plain);
    }

    #[test]
    fn a_message_is_a_result_with_a_reason_and_a_ray() {
        let (result, ray) = parts("hit; expected: miss, because it is beside. Ray: o = 1");
        assert_eq!(ray, Some("o = 1"));
        assert_eq!(without_reason(result, 80), result);
        assert_eq!(without_reason(result, 20), "hit; expected: miss");
        assert_eq!(parts("t = 1"), ("t = 1", None));
    }
}
