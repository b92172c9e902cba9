//! The middle of a few times, and how far they scatter.

/// Quartiles of numbers, by nearest rank. Times have a long tail on one side: a mean would follow it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quartiles {
    /// A quarter is at most this.
    pub lower: f64,
    /// Half are at most this.
    pub median: f64,
    /// Three quarters are at most this.
    pub upper: f64,
}

impl Quartiles {
    /// Of `numbers`; zeros of none.
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

    /// Distance between the outer two.
    pub fn spread(&self) -> f64 {
        self.upper - self.lower
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_slow_round_moves_nothing() {
        let of = |numbers: &[f64]| Quartiles::of(numbers.iter().copied());
        let quartiles = of(&[3.0, 1.0, 2.0, 4.0, 90.0]);
        assert_eq!((quartiles.median, quartiles.spread()), (3.0, 2.0));
        assert_eq!(of(&[5.0]).median, 5.0);
        assert_eq!(of(&[]), Quartiles::default());
    }
}
