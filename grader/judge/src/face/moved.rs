//! Compares answers to moved questions with those to the questions themselves.

use wire::Answer;

/// Whether two answers have the same bits. Both zeros are one: `x - x` is +0, whichever way its
/// axis is turned. The order of primitives in leaves is that of the question, so trees are not
/// compared.
pub fn has_same_bits(a: &Answer, b: &Answer) -> bool {
    matches!((a, b), (Answer::Build(_), Answer::Build(_))) || bits(a) == bits(b)
}

/// The answer as text, in which numbers have all their bits.
fn bits(answer: &Answer) -> String {
    let text = format!("{answer:?}");
    let mut parts = text.split("-0.0");
    let mut bits = parts.next().unwrap_or_default().to_string();
    for part in parts {
        // Part of a longer number, such as -0.05.
        let goes_on = part.starts_with(|c: char| c.is_ascii_digit());
        bits.push_str(if goes_on { "-0.0" } else { "0.0" });
        bits.push_str(part);
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_counts_but_the_sign_of_zero() {
        let answer = |x: f64| Answer::Boxes(vec![Some([x, 1.0])]);
        let is_same = |a: f64, b: f64| has_same_bits(&answer(a), &answer(b));
        assert!(is_same(0.0, -0.0) && is_same(-0.05, -0.05));
        assert!(!is_same(0.05, -0.05) && !is_same(2.0, 2.0_f64.next_up()));
    }
}
