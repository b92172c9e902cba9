//! Statistical tests: how random answers are compared.
//!
//! A Monte Carlo estimate has no right value to the last digit, so no fixed threshold is fair: with many samples it
//! lets errors pass, with few it marks right answers down. A test here computes instead how often a right answer would
//! look this wrong, and fails below a probability that is fixed beforehand.
//!
//! This page has the normal distribution; [`chi_square`] compares directions with their density. Means and variances
//! are [`kit::Tally`].

pub mod chi_square;

use std::f64::consts::SQRT_2;

/// How often a normal variable is at least `z` standard deviations from its mean, on either side.
pub fn two_sided(z: f64) -> f64 {
    libm::erfc(z.abs() / SQRT_2)
}

/// The chance of a false alarm that each of `tests` independent tests may have, so that all of them together have at
/// most `family` (Šidák 1967): `1 - (1 - family)^(1/tests)`.
pub fn sidak(family: f64, tests: usize) -> f64 {
    -libm::expm1(libm::log1p(-family) / tests.max(1) as f64)
}

/// The `z` that a right answer exceeds, on either side, with the chance `alarm`: the inverse of [`two_sided`].
pub fn z_of_alarm(alarm: f64) -> f64 {
    // Beyond 40 the chance is 0 in f64. Halving 60 times reaches the last digit.
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

/// The smallest bias that a z-test with this chance of a false alarm is sure to see, in the units of `standard_error`:
/// an estimate that is off by as much stays unseen no more often than a right one is accused.
pub fn smallest_sure_bias(standard_error: f64, alarm: f64) -> f64 {
    2.0 * z_of_alarm(alarm) * standard_error
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_of_the_normal_distribution() {
        assert!((two_sided(1.959_963_984_540_054) - 0.05).abs() < 1e-12);
        assert_eq!(two_sided(0.0), 1.0);
        assert!((z_of_alarm(0.05) - 1.959_963_984_540_054).abs() < 1e-12);
        assert!((smallest_sure_bias(0.5, 0.05) - z_of_alarm(0.05)).abs() < 1e-12);
        assert!((sidak(0.05, 10) - 0.005_116_196_891_823_743).abs() < 1e-12);
    }
}
