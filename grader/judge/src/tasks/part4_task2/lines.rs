//! Writes a path to a snapshot.

use crate::tools::snapshot::{Forms, field, forms, number, vector};
use wire::global::{PathAnswer, ScriptedPath};

/// Radiance, number of rays and of calls of roulette; full lines also have the first throughputs.
pub(super) fn path(path: &ScriptedPath, answer: &PathAnswer) -> Forms {
    let question = vec![
        number("max_depth", f64::from(path.max_depth)),
        number("surfaces", path.steps.len() as f64),
        field("d", vector(&path.ray.d)),
    ];
    let short = vec![
        field("radiance", vector(&answer.radiance)),
        number("rays", answer.rays.len() as f64),
        number("games", answer.roulette_calls.len() as f64),
    ];
    let mut full = short.clone();
    let throughputs = answer.roulette_calls.iter().take(2);
    full.extend(throughputs.map(|(throughput, _, _)| field("throughput", vector(throughput))));
    forms(question, short, full)
}
