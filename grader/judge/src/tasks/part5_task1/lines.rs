//! Writes the results of stopping rules and of adaptively sampled pixels to a snapshot.

use crate::snapshot::{Fields, Forms, Value, field, forms, number, vector};
use wire::adaptive::{AdaptiveAnswer, AdaptivePixel, StopAnswer, StopCall};

/// The result of a stopping rule, and how often the waiting rule called the plain rule.
pub(crate) fn stop(call: &StopCall, answer: &StopAnswer) -> Forms {
    let runs = call.runs.iter().take(4);
    let mut question: Fields = runs
        .map(|&(count, x)| field("run", vector(&[f64::from(count), x])))
        .collect();
    question.push(number("tolerance", call.tolerance));
    let answer = vec![
        number("stop", f64::from(u8::from(answer.stop))),
        number("asked", answer.rule_calls.len() as f64),
    ];
    forms(question, answer.clone(), answer)
}

/// The number of samples, the radiance, and how often the pixel called its stopping rule. Full
/// lines also have the count, mean and variance of the first two calls.
pub(super) fn pixel(work: &AdaptivePixel, answer: &AdaptiveAnswer) -> Forms {
    let question = vec![
        field("pixel", vector(&work.pixel.map(f64::from))),
        number("ns_aa", f64::from(work.ns_aa)),
        number("batch", f64::from(work.batch)),
        number("tolerance", work.tolerance),
    ];
    let short = vec![
        number("samples", f64::from(answer.samples)),
        field("radiance", vector(&answer.radiance)),
        number("looks", answer.rule_calls.len() as f64),
    ];
    let mut full = short.clone();
    full.extend(
        answer
            .rule_calls
            .iter()
            .take(2)
            .map(|&(count, mean, variance, _)| {
                field("look", Value::Vector(vec![count as f64, mean, variance]))
            }),
    );
    forms(question, short, full)
}
