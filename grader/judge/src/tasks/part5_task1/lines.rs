//! Writes the results of adaptively sampled pixels to a snapshot.

use crate::tools::snapshot::{Forms, Value, field, forms, number, vector};
use wire::adaptive::{AdaptiveAnswer, AdaptivePixel};

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
