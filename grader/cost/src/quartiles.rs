//! Median and quartiles of measured times.

/// Quartiles by nearest rank. The distribution of times has a long tail, which affects a mean more
/// than a median.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

    /// Returns the interquartile range.
    pub fn spread(&self) -> f64 {
        self.upper - self.lower
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_slow_round_does_not_change_the_quartiles() {
        let of = |numbers: &[f64]| Quartiles::of(numbers.iter().copied());
        let quartiles = of(&[3.0, 1.0, 2.0, 4.0, 90.0]);
        assert_eq!((quartiles.median, quartiles.spread()), (3.0, 2.0));
        assert_eq!(of(&[5.0]).median, 5.0);
        assert_eq!(of(&[]), Quartiles::default());
    }
}
