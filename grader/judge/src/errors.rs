//! How far off the numbers of answers are, as a distribution.

use serde::Serialize;

/// How far off one number is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NumberError {
    /// In units in the last place of the right number.
    pub ulps: f64,
    /// As a share of what is allowed; over 1 is wrong.
    pub of_bound: f64,
}

/// How far off many numbers are, in units in the last place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ErrorSpread {
    /// Half of the numbers are no farther off.
    pub p50: f64,
    /// Of a hundred numbers, 99 are no farther off.
    pub p99: f64,
    /// None is farther off.
    pub max: f64,
    /// The largest share of its bound that an error makes; over 1 is wrong.
    pub of_bound: f64,
}

impl ErrorSpread {
    /// The spread of `errors`; `None` without any. NaN counts as infinitely far off.
    pub fn of<'a>(errors: impl IntoIterator<Item = &'a NumberError>) -> Option<ErrorSpread> {
        let sized = |x: f64| if x.is_nan() { f64::INFINITY } else { x };
        let (mut ulps, shares): (Vec<f64>, Vec<f64>) = errors
            .into_iter()
            .map(|error| (sized(error.ulps), sized(error.of_bound)))
            .unzip();
        ulps.sort_by(f64::total_cmp);
        let max = *ulps.last()?;
        // The smallest that at least this share of the numbers does not exceed (nearest rank).
        let quantile = |share: f64| ulps[((share * ulps.len() as f64).ceil() as usize).max(1) - 1];
        Some(ErrorSpread {
            p50: quantile(0.5),
            p99: quantile(0.99),
            max,
            of_bound: shares.into_iter().fold(0.0, f64::max),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_nearest_ranks() {
        let errors: Vec<NumberError> = (1..=200)
            .rev()
            .map(|i| NumberError {
                ulps: f64::from(i),
                of_bound: f64::from(i) / 400.0,
            })
            .collect();
        let spread = ErrorSpread::of(&errors).expect("there are errors");
        assert_eq!((spread.p50, spread.p99, spread.max), (100.0, 198.0, 200.0));
        assert_eq!(spread.of_bound, 0.5);
        assert_eq!(ErrorSpread::of(&[]), None);
    }

    #[test]
    fn nan_is_infinitely_far_off() {
        let nan = NumberError {
            ulps: f64::NAN,
            of_bound: f64::NAN,
        };
        let spread = ErrorSpread::of(&[nan]).expect("there is one");
        assert_eq!(
            (spread.p50, spread.of_bound),
            (f64::INFINITY, f64::INFINITY)
        );
    }
}
