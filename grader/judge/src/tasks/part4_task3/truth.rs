//! The right results of Russian roulette.

use crate::tools::packed_truth;
use wire::work::Xyz;

// BEGIN SOLUTION(part4.task3)
/// The number of bounces before roulette may end a path.
const FREE_BOUNCES: u32 = 3;
// END SOLUTION(part4.task3)

/// The probability that a path continues, and its throughput if it does.
pub(super) fn survival(throughput: Xyz, bounces: u32) -> (f64, Xyz) {
    let input = (throughput, bounces);
    // BEGIN SOLUTION(part4.task3)
    let brightest = throughput.into_iter().fold(0.0, f64::max);
    let chance = match bounces {
        0..=FREE_BOUNCES if brightest > 0.0 => 1.0,
        _ => brightest.min(1.0),
    };
    let survival = (chance, throughput.map(|channel| channel / chance));
    packed_truth::record("part4.task3", "survival", &input, survival)
    // STUB: packed_truth::find("part4.task3", "survival", &input)
    // END SOLUTION(part4.task3)
}
