//! Statistical tests for random results.
//!
//! A Monte Carlo estimate is random, so no fixed threshold is right for it: with many samples a
//! fixed threshold accepts wrong results, with few it rejects correct ones. A test computes a
//! p-value instead, the probability that a correct result deviates at least this much, and fails
//! below a significance level that is fixed beforehand.
//!
//! This module has the normal distribution; [`chi_square`] compares sampled directions with a
//! density. Means and variances are computed by [`kit::Tally`].

pub mod chi_square;

use std::f64::consts::SQRT_2;

/// Returns the probability that a normal variable is at least `z` standard deviations from its
/// mean, on either side: the two-sided p-value of `z`.
///
/// ```
/// assert_eq!(statistics::two_sided(0.0), 1.0);
/// assert!((statistics::two_sided(1.96) - 0.05).abs() < 1e-4);
/// ```
pub fn two_sided(z: f64) -> f64 {
    libm::erfc(z.abs() / SQRT_2)
}

/// Returns the significance level of each of `tests` independent tests for which the probability
/// that any of them rejects a correct result is `family` (Šidák 1967):
/// `1 - (1 - family)^(1/tests)`.
///
/// ```
/// // A picture of a million pixels: each is tested at a much smaller level.
/// let each = statistics::sidak(0.01, 1_000_000);
/// assert!((each - 1.005e-8).abs() < 1e-11);
/// assert!((1.0 - (1.0 - each).powi(1_000_000) - 0.01).abs() < 1e-6);
/// ```
pub fn sidak(family: f64, tests: usize) -> f64 {
    -libm::expm1(libm::log1p(-family) / tests.max(1) as f64)
}

/// Returns the `z` that a correct result exceeds, on either side, with probability `alarm`: the
/// inverse of [`two_sided`].
///
/// ```
/// let z = statistics::critical_z(0.05);
/// assert!((statistics::two_sided(z) - 0.05).abs() < 1e-12);
/// ```
pub fn critical_z(alarm: f64) -> f64 {
    // Beyond 40 the probability is 0 in f64. 60 bisections reach the last digit.
    let (mut low, mut high) = (0.0, 40.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if two_sided(middle) > alarm {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Returns the smallest bias that a z-test reliably detects, in the units of `standard_error`.
/// `alarm` is the probability of a false alarm: a biased estimate passes the test no more often
/// than a correct one fails it.
///
/// ```
/// let mut tally = kit::Tally::default();
/// (0..100).for_each(|i| tally.push(f64::from(i % 2)));
/// let bias = statistics::detectable_bias(tally.standard_error(), 0.01);
/// assert!((0.25..0.27).contains(&bias));
/// ```
pub fn detectable_bias(standard_error: f64, alarm: f64) -> f64 {
    2.0 * critical_z(alarm) * standard_error
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normal_tails_match_known_values() {
        assert!((two_sided(1.959_963_984_540_054) - 0.05).abs() < 1e-12);
        assert_eq!(two_sided(0.0), 1.0);
        assert!((critical_z(0.05) - 1.959_963_984_540_054).abs() < 1e-12);
        assert!((detectable_bias(0.5, 0.05) - critical_z(0.05)).abs() < 1e-12);
        assert!((sidak(0.05, 10) - 0.005_116_196_891_823_743).abs() < 1e-12);
    }
}
