//! Tests of the form of an answer, for [`super::Check::fits`].

use wire::answer::HitsAnswer;

/// Checks that there is one answer for each call.
pub(crate) fn one_each<T>(calls: usize, answers: &[T]) -> Result<(), String> {
    same_length("answers", answers.len(), calls)
}

/// Checks that there are as many of `what` as the case has calls.
pub(crate) fn same_length(what: &str, found: usize, calls: usize) -> Result<(), String> {
    if found == calls {
        Ok(())
    } else {
        Err(format!(
            "expected {calls} {what}, one per call, found {found}"
        ))
    }
}

/// Checks that `index`, which call number `call` has for a `what`, is below `count`.
pub(crate) fn in_range(what: &str, call: usize, index: u32, count: usize) -> Result<(), String> {
    if (index as usize) < count {
        Ok(())
    } else {
        Err(format!(
            "call {call} has the {what} index {index}, expected one below {count}"
        ))
    }
}

/// Checks that there is a hit or a miss, and a `max_t`, for each of `rays` rays.
pub(crate) fn hits_fit(rays: usize, answer: &HitsAnswer) -> Result<(), String> {
    same_length("hits or misses", answer.hits.len(), rays)?;
    same_length("max_t", answer.max_t.len(), rays)
}
