//! Part 5, tasks 1 and 2: when a pixel has had enough samples.
//!
//! The mean μ of n samples is off from the truth by about the standard error σ/√n, where σ² is the variance of the
//! samples. By the central limit theorem the truth lies within 1.96 standard errors of μ with a confidence of 95 %.

use kit::Tally;

// BEGIN SOLUTION(part5.task1)
/// Half the width of the middle 95 % of a normal distribution, in standard deviations.
const Z95: f64 = 1.96;
// END SOLUTION(part5.task1)

/// Whether the mean of `samples` (the luminances of a pixel's samples) is known to within `tolerance`, a share of it:
/// `1.96 · σ/√n <= tolerance · μ`. Equality counts.
///
/// This is the rule of the assignment, to the letter. It has two blind spots, which task 2 mends: samples that happen
/// to be all the same have σ = 0 and stop at once, and black ones satisfy 0 <= 0. No samples are never enough.
pub fn has_converged(samples: &Tally, tolerance: f64) -> bool {
    // BEGIN SOLUTION(part5.task1)
    samples.count() > 0 && Z95 * samples.standard_error() <= tolerance * samples.mean()
    // STUB: kit::hole!("part5.task1", samples, tolerance)
    // END SOLUTION(part5.task1)
}

/// Fewest samples after which [`has_surely_converged`] may say yes.
pub const FEWEST_SAMPLES: u64 = 256;

/// The rule of task 1 without its bias: says yes only if `rule` does, at least [`FEWEST_SAMPLES`] went in, and at
/// least one of them had light.
///
/// A rule that looks at the same samples as the estimate stops more often when they happen to agree, and samples agree
/// when all of them missed a light that few of them find. A lamp that one sample in a thousand finds leaves 97 % of
/// first batches of 32 black; stopped there, the picture is about 20 times too dark. So black is never enough: it
/// may be that nothing was found yet. And n is large before anybody looks at σ, since the σ of a few samples is a
/// guess, too small more often than too large.
///
/// So a pixel whose most samples (`-s`) are fewer than [`FEWEST_SAMPLES`] takes them all, and so does a black one.
///
/// What is left is small: to pass at a tolerance of 5 % an estimate of a light with hit probability p needs
/// `n·p >= (1.96/0.05)² ≈ 1537` hits, whose mean is off by far less than its tolerance. `rule` is [`has_converged`], or
/// another with its signature.
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
    fn spread_against_the_mean_decides() {
        // σ² = 1/3 · 4 · 0.25, standard error √(1/12) = 0.2887, times 1.96: 0.5658 of a mean of 1.5.
        let samples = tally(&[1.0, 2.0, 1.0, 2.0]);
        assert!(has_converged(&samples, 0.378));
        assert!(!has_converged(&samples, 0.377));
    }

    #[test]
    fn no_spread_is_enough_and_no_samples_are_not() {
        assert!(has_converged(&tally(&[3.0, 3.0]), 0.0));
        assert!(!has_converged(&Tally::default(), 1.0));
    }

    /// What task 2 is for.
    #[test]
    fn black_stops_at_once() {
        assert!(has_converged(&tally(&[0.0; 32]), 0.05));
    }
}
// END SOLUTION(part5.task1)

// BEGIN SOLUTION(part5.task2)
#[cfg(test)]
mod mended_tests {
    use super::*;

    fn constant(value: f64, n: usize) -> Tally {
        std::iter::repeat_n(value, n).collect()
    }

    /// Hard case 86.
    #[test]
    fn black_is_never_enough() {
        let always = &mut |_: &Tally, _: f64| true;
        assert!(!has_surely_converged(&constant(0.0, 100_000), 0.5, always));
        assert!(has_surely_converged(&constant(1e-9, 256), 0.5, always));
    }

    #[test]
    fn few_are_never_enough() {
        let always = &mut |_: &Tally, _: f64| true;
        assert!(!has_surely_converged(&constant(1.0, 255), 0.5, always));
        assert!(has_surely_converged(&constant(1.0, 256), 0.5, always));
    }

    #[test]
    fn the_rule_is_asked_and_has_the_last_word() {
        let mut asked = Vec::new();
        assert!(!has_surely_converged(
            &constant(1.0, 300),
            0.25,
            &mut |samples: &Tally, tolerance| {
                asked.push((samples.count(), tolerance));
                false
            }
        ));
        assert_eq!(asked, [(300, 0.25)]);
    }
}
// END SOLUTION(part5.task2)
