//! Rust tests of Russian roulette.

use super::judge;
use super::truth::survival;
use crate::tools::repro::numbers::{float, same_colour, spectrum};
use wire::global::RouletteWork;

/// A test of one call.
pub(crate) fn call(work: &RouletteWork, call: usize) -> Option<String> {
    let &(throughput, bounces) = work.paths.get(call / work.numbers.len().max(1))?;
    let u = *work.numbers.get(call % work.numbers.len().max(1))?;
    let call = format!(
        "global::play_roulette({}, {bounces}, {})",
        spectrum(throughput),
        float(u)
    );
    let bound = judge::bound(survival(throughput, bounces).0);
    Some(match judge::right(throughput, bounces, u) {
        None => format!("use kit::Spectrum;\nassert_eq!({call}, None);\n"),
        Some(right) => format!(
            "use kit::Spectrum;\nlet throughput = {call}.expect(\"the path continues\");\n{}\n",
            same_colour("throughput", right, bound)
        ),
    })
}
