//! Part 5, tasks 1 and 2: the criterion for enough samples.
//!
//! The error of the mean μ of n samples is about the standard error σ/√n, where σ² is the variance
//! of the samples. By the central limit theorem the exact value is within 1.96 standard errors of μ
//! with a confidence of 95 %.

use kit::Tally;

// BEGIN SOLUTION(part5.task1)
/// Half width of the central 95 % of a normal distribution, in standard deviations.
const Z95: f64 = 1.96;
// END SOLUTION(part5.task1)

/// Whether the mean of `samples` (the luminances of a pixel's samples) has a relative error of at
/// most `tolerance`, with a confidence of 95 %. This holds if half of the confidence interval, 1.96
/// standard errors, is at most this fraction of the mean. Equality counts.
///
/// Chapter: stages/book/src/part5/task1.md
///
/// This is exactly the criterion of the assignment. It fails in two cases, which task 2 corrects.
/// If all samples happen to be equal, σ = 0 and sampling stops at once. Black samples satisfy
/// `0 <= 0`. Without samples the result is false.
///
/// See it: `cargo grader picture part5.task1`.
pub fn has_converged(samples: &Tally, tolerance: f64) -> bool {
    // BEGIN SOLUTION(part5.task1)
    samples.count() > 0 && Z95 * samples.standard_error() <= tolerance * samples.mean()
    // STUB: kit::hole!("part5.task1", samples, tolerance)
    // END SOLUTION(part5.task1)
}

/// Minimum number of samples for [`has_surely_converged`] to return true.
pub const FEWEST_SAMPLES: u64 = 256;

/// The criterion of task 1 with little of its bias: true only if `rule` returns true, there are at
/// least [`FEWEST_SAMPLES`] samples, and at least one of them is not black.
///
/// Chapter: stages/book/src/part5/task2.md
///
/// A criterion that uses the same samples as the estimate stops more often when these samples
/// happen to be similar. Samples are similar when all of them missed a light that few samples hit.
/// With a lamp that one sample in a thousand hits, 97 % of the first batches of 32 samples are
/// black. If the pixels stopped there, an image of at most 2048 samples a pixel would be about 20
/// times too dark.
///
/// So black samples are never enough, because the light may not have been hit yet. And n must be
/// large before σ is used, because the σ of a few samples is unreliable, and more often too small
/// than too large.
///
/// So a pixel whose maximum number of samples (`-s`) is below [`FEWEST_SAMPLES`] takes all of them,
/// and so does a black pixel.
///
/// The remaining bias is small. With a tolerance of 5 %, an estimate of a light with a small hit
/// probability p needs `n·p >= (1.96/0.05)² ≈ 1537` hits; the bias is then far below the tolerance.
/// `rule` is [`has_converged`], or another function with the same signature.
///
/// See it: `cargo grader picture part5.task2`.
pub fn has_surely_converged(
    samples: &Tally,
    tolerance: f64,
    rule: &mut impl FnMut(&Tally, f64) -> bool,
) -> bool {
    // BEGIN SOLUTION(part5.task2)
    samples.count() >= FEWEST_SAMPLES && samples.mean() > 0.0 && rule(samples, tolerance)
    // STUB: kit::hole!("part5.task2", samples, tolerance, rule)
    // END SOLUTION(part5.task2)
}

// BEGIN SOLUTION(part5.task1)
#[cfg(test)]
mod rule_tests {
    use super::*;

    fn tally(samples: &[f64]) -> Tally {
        samples.iter().copied().collect()
    }

    #[test]
    fn standard_error_is_compared_with_the_mean() {
        // σ² = 1/3 · 4 · 0.25 and the standard error is √(1/12) = 0.2887. Times 1.96 this is
        // 0.5658; the mean is 1.5.
        let samples = tally(&[1.0, 2.0, 1.0, 2.0]);
        assert!(has_converged(&samples, 0.378));
        assert!(!has_converged(&samples, 0.377));
    }

    #[test]
    fn equal_samples_converge_and_no_samples_do_not() {
        assert!(has_converged(&tally(&[3.0, 3.0]), 0.0));
        assert!(!has_converged(&Tally::default(), 1.0));
    }

    /// The failure that task 2 corrects.
    #[test]
    fn black_stops_at_once() {
        assert!(has_converged(&tally(&[0.0; 32]), 0.05));
    }
}
// END SOLUTION(part5.task1)

// BEGIN SOLUTION(part5.task2)
#[cfg(test)]
mod unbiased_rule_tests {
    use super::*;

    fn constant(value: f64, n: usize) -> Tally {
        std::iter::repeat_n(value, n).collect()
    }

    /// Hard case 86.
    #[test]
    fn black_samples_never_converge() {
        let always = &mut |_: &Tally, _: f64| true;
        assert!(!has_surely_converged(&constant(0.0, 100_000), 0.5, always));
        assert!(has_surely_converged(&constant(1e-9, 256), 0.5, always));
    }

    #[test]
    fn few_samples_never_converge() {
        let always = &mut |_: &Tally, _: f64| true;
        assert!(!has_surely_converged(&constant(1.0, 255), 0.5, always));
        assert!(has_surely_converged(&constant(1.0, 256), 0.5, always));
    }

    #[test]
    fn rule_is_called_and_must_agree() {
        let mut calls = Vec::new();
        assert!(!has_surely_converged(
            &constant(1.0, 300),
            0.25,
            &mut |samples: &Tally, tolerance| {
                calls.push((samples.count(), tolerance));
                false
            }
        ));
        assert_eq!(calls, [(300, 0.25)]);
    }
}
// END SOLUTION(part5.task2)
