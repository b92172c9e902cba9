//! Median and quartiles of measured times.

use serde::{Deserialize, Serialize};

/// Quartiles by nearest rank. The distribution of times has a long tail, which affects a mean more
/// than a median. Of up to three numbers they are the minimum, the median and the maximum.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Quartiles {
    /// Lower quartile.
    pub lower: f64,
    /// Median.
    pub median: f64,
    /// Upper quartile.
    pub upper: f64,
}

impl Quartiles {
    /// Returns the quartiles of `numbers`; zeros if there are none.
    pub fn of(numbers: impl IntoIterator<Item = f64>) -> Quartiles {
        let mut sorted: Vec<f64> = numbers.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        let rank = |share: f64| {
            let rank = (share * sorted.len() as f64).ceil() as usize;
            sorted.get(rank.max(1) - 1).copied().unwrap_or(0.0)
        };
        Quartiles {
            lower: rank(0.25),
            median: rank(0.5),
            upper: rank(0.75),
        }
    }

    /// Returns the number after ± in tables: the distance from the median to the quartile that is
    /// farther away.
    pub fn plus_minus(&self) -> f64 {
        (self.upper - self.median).max(self.median - self.lower)
    }

    /// Returns all three times `factor`, which is not negative.
    pub fn scaled(&self, factor: f64) -> Quartiles {
        Quartiles {
            lower: factor * self.lower,
            median: factor * self.median,
            upper: factor * self.upper,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_slow_round_does_not_change_the_quartiles() {
        let of = |numbers: &[f64]| Quartiles::of(numbers.iter().copied());
        let quartiles = of(&[3.0, 1.0, 2.0, 4.0, 90.0]);
        assert_eq!((quartiles.median, quartiles.plus_minus()), (3.0, 1.0));
        assert_eq!(of(&[5.0]).median, 5.0);
        assert_eq!(of(&[]), Quartiles::default());
    }

    #[test]
    fn plus_minus_reaches_the_farther_quartile() {
        let skewed = Quartiles {
            lower: 1.0,
            median: 1.1,
            upper: 1.7,
        };
        assert!((skewed.plus_minus() - 0.6).abs() < 1e-12);
        assert!((skewed.scaled(10.0).plus_minus() - 6.0).abs() < 1e-12);
    }
}
