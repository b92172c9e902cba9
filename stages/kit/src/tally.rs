//! Mean, variance and standard error of a stream of numbers.

/// Mean and variance of numbers, in one pass.
///
/// Welford's recurrence ("Note on a method for calculating corrected sums of squares and products",
/// 1962): summing squares and subtracting the squared mean loses all digits when the variance is
/// small against the mean.
///
/// ```
/// use kit::Tally;
/// let mut tally = Tally::default();
/// [1.0, 2.0, 3.0].into_iter().for_each(|x| tally.push(x));
/// assert_eq!((tally.count(), tally.mean(), tally.variance()), (3, 2.0, 1.0));
/// let mut both = Tally::of_equal(2.0, 3);
/// both.merge(&tally);
/// assert_eq!((both.count(), both.mean()), (6, 2.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    n: u64,
    mean: f64,
    /// Sum of the squared differences from the mean.
    m2: f64,
}

impl Tally {
    /// The tally of the finite number `x`, added `n` times.
    pub fn of_equal(x: f64, n: u64) -> Tally {
        Tally {
            n,
            mean: if n > 0 { x } else { 0.0 },
            m2: 0.0,
        }
    }

    /// Adds `x` to the numbers.
    #[inline]
    pub fn push(&mut self, x: f64) {
        self.n += 1;
        let difference = x - self.mean;
        self.mean += difference / self.n as f64;
        self.m2 += difference * (x - self.mean);
    }

    /// Adds all numbers of `other` (Chan, Golub, LeVeque, "Updating formulae and a pairwise
    /// algorithm for computing sample variances", 1979).
    pub fn merge(&mut self, other: &Tally) {
        let n = self.n + other.n;
        if n == 0 {
            return;
        }
        let difference = other.mean - self.mean;
        let share = other.n as f64 / n as f64;
        self.m2 += other.m2 + difference * difference * (self.n as f64 * share);
        self.mean += difference * share;
        self.n = n;
    }

    /// How many numbers there were.
    pub fn count(&self) -> u64 {
        self.n
    }

    /// Their mean, μ; 0 for none.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Their sample variance, σ² = Σ(x - μ)² / (n - 1); 0 for fewer than two.
    pub fn variance(&self) -> f64 {
        if self.n < 2 {
            return 0.0;
        }
        self.m2 / (self.n - 1) as f64
    }

    /// The standard error of the mean, σ/√n; 0 for none.
    pub fn standard_error(&self) -> f64 {
        if self.n == 0 {
            return 0.0;
        }
        (self.variance() / self.n as f64).sqrt()
    }

    /// How many standard errors the mean is above `truth`. With no spread at all: 0 if they are
    /// equal up to rounding (a relative 1e-12), else infinite.
    pub fn z_against(&self, truth: f64) -> f64 {
        z(self.mean - truth, self.standard_error(), truth.abs())
    }

    /// How many standard errors this mean is above `other`'s, by the pooled variance of both: two
    /// estimates of the same quantity.
    pub fn z_between(&self, other: &Tally) -> f64 {
        let degrees = (self.n + other.n).saturating_sub(2);
        let pooled = if degrees == 0 {
            0.0
        } else {
            (self.m2 + other.m2) / degrees as f64
        };
        let error = (pooled * (1.0 / self.n as f64 + 1.0 / other.n as f64)).sqrt();
        z(self.mean - other.mean, error, other.mean.abs())
    }
}

impl FromIterator<f64> for Tally {
    fn from_iter<I: IntoIterator<Item = f64>>(numbers: I) -> Tally {
        let mut tally = Tally::default();
        for x in numbers {
            tally.push(x);
        }
        tally
    }
}

impl Extend<f64> for Tally {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, numbers: I) {
        for x in numbers {
            self.push(x);
        }
    }
}

/// Rounding of a mean of numbers that are all the same.
const SAME: f64 = 1e-12;

fn z(difference: f64, error: f64, scale: f64) -> f64 {
    if difference.abs() <= SAME * scale {
        return 0.0;
    }
    difference / error
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tally_knows_mean_and_variance() {
        let tally: Tally = [1.0, 2.0, 3.0, 4.0].into_iter().collect();
        assert_eq!(tally.count(), 4);
        assert_eq!(tally.mean(), 2.5);
        assert!((tally.variance() - 5.0 / 3.0).abs() < 1e-15);
        assert!((tally.standard_error() - (5.0_f64 / 12.0).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn two_tallies_merge_into_one() {
        let numbers = [3.0, 1.0, 4.0, 1.0, 5.0, 9.0, 2.0];
        let whole: Tally = numbers.into_iter().collect();
        for cut in 0..=numbers.len() {
            let mut left: Tally = numbers[..cut].iter().copied().collect();
            left.merge(&numbers[cut..].iter().copied().collect());
            assert_eq!(left.count(), 7);
            assert!((left.mean() - whole.mean()).abs() < 1e-15);
            assert!((left.variance() - whole.variance()).abs() < 1e-13);
        }
    }

    #[test]
    fn equal_numbers_are_added_at_once() {
        for x in [0.0, 0.1, -3.7e9, 1e-310] {
            for n in 0..20 {
                let one_by_one: Tally = std::iter::repeat_n(x, n).collect();
                assert_eq!(Tally::of_equal(x, n as u64), one_by_one);
            }
        }
    }

    /// Sums of squares would give 0 or a negative variance here.
    #[test]
    fn small_variance_beside_a_large_mean_is_kept() {
        let tally: Tally = (0..1000).map(|i| 1e9 + f64::from(i % 2)).collect();
        assert!((tally.variance() - 0.25).abs() < 1e-3);
    }

    #[test]
    fn no_spread_is_no_excuse() {
        let one: Tally = [1.0, 1.0].into_iter().collect();
        let two: Tally = [2.0, 2.0].into_iter().collect();
        assert_eq!(one.z_against(1.0), 0.0);
        assert_eq!(two.z_between(&one), f64::INFINITY);
    }
}
