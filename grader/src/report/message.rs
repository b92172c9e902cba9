//! The parts of the message about a wrong answer.

use super::wrap::columns;

/// The result and the question: what stands before and after ". Ray: ". Not every message has a
/// question.
pub(crate) fn parts(message: &str) -> (&str, Option<&str>) {
    match message.split_once(". Ray: ") {
        Some((result, ray)) => (result, Some(ray)),
        None => (message, None),
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_is_a_result_with_a_reason_and_a_ray() {
        let (result, ray) = parts("hit; expected: miss, because it is beside. Ray: o = 1");
        assert_eq!(ray, Some("o = 1"));
        assert_eq!(without_reason(result, 80), result);
        assert_eq!(without_reason(result, 20), "hit; expected: miss");
        assert_eq!(parts("t = 1"), ("t = 1", None));
    }
}
