//! The right results of the stopping rule, and of pixels that stop by a rule.

use crate::tools::packed_truth;
// BEGIN SOLUTION(part5.task1)
use crate::tools::kinds::stopping;
// END SOLUTION(part5.task1)
use kit::{Spectrum, Tally};
use wire::adaptive::{AdaptivePixel, StopCall};
// BEGIN SOLUTION(part5.task1)
use wire::adaptive::StopRule;

/// Half the width of the 95 % confidence interval of a normal distribution, in standard deviations.
const CONFIDENCE: f64 = 1.96;

/// Whether the confidence interval of the mean is narrow enough; both sides are squared.
fn is_narrow(samples: &Tally, tolerance: f64) -> bool {
    let (n, wanted) = (samples.count() as f64, tolerance * samples.mean());
    n > 0.0 && n * wanted * wanted >= CONFIDENCE * CONFIDENCE * samples.variance()
}
// END SOLUTION(part5.task1)

/// The right result of the plain rule.
pub(super) fn converged(call: &StopCall) -> bool {
    let input = (&call.runs, call.tolerance);
    // BEGIN SOLUTION(part5.task1)
    let right = is_narrow(&stopping::samples(call), call.tolerance);
    packed_truth::record("part5.task1", "converged", &input, right)
    // STUB: packed_truth::find("part5.task1", "converged", &input)
    // END SOLUTION(part5.task1)
}

/// The tolerance at which the result of the plain rule changes for these samples, computed from
/// plain sums.
pub(super) fn threshold(runs: &[(u32, f64)]) -> f64 {
    // BEGIN SOLUTION(part5.task1)
    let over = |f: &dyn Fn(f64) -> f64| -> f64 {
        runs.iter().map(|&(count, x)| f64::from(count) * f(x)).sum()
    };
    let n = over(&|_| 1.0);
    let mean = over(&|x| x) / n;
    let variance = over(&|x| (x - mean) * (x - mean)) / (n - 1.0);
    let threshold = CONFIDENCE * (variance / n).sqrt() / mean;
    packed_truth::record("part5.task1", "threshold", runs, threshold)
    // STUB: packed_truth::find("part5.task1", "threshold", runs)
    // END SOLUTION(part5.task1)
}

/// The number of samples that a correct loop takes, and the samples at each call of the rule.
pub(super) fn right_samples(work: &AdaptivePixel) -> (u32, Vec<Tally>) {
    let (samples, calls) = counts(work);
    let mut luminances = work.stream.iter().cycle();
    let mut taken = Tally::default();
    let at_calls = calls.into_iter().map(|count| {
        while taken.count() < u64::from(count)
            && let Some(radiance) = luminances.next()
        {
            taken.push(Spectrum::from(*radiance).luminance());
        }
        taken
    });
    (samples, at_calls.collect())
}

/// The number of samples that a correct loop takes, and their number at each call of the rule.
fn counts(work: &AdaptivePixel) -> (u32, Vec<u32>) {
    // BEGIN SOLUTION(part5.task1)
    let mut taken = Tally::default();
    let mut calls = Vec::new();
    let mut samples = work.stream.iter().cycle().zip(1..=work.ns_aa);
    let stopped = samples.find_map(|(radiance, count)| {
        taken.push(Spectrum::from(*radiance).luminance());
        if !count.is_multiple_of(work.batch.max(1)) {
            return None;
        }
        calls.push(count);
        let enough = match work.rule {
            StopRule::From(least) => taken.count() >= least,
            StopRule::Plain => is_narrow(&taken, work.tolerance),
        };
        enough.then_some(count)
    });
    let counts = (stopped.unwrap_or(work.ns_aa), calls);
    packed_truth::record("part5.task1", "counts", work, counts)
    // STUB: packed_truth::find("part5.task1", "counts", work)
    // END SOLUTION(part5.task1)
}
