//! The distribution of the errors of numbers.

use serde::Serialize;

/// The error of one number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NumberError {
    /// In units in the last place of the right number.
    pub ulps: f64,
    /// Relative to the allowed error; above 1 is wrong.
    pub of_bound: f64,
}

/// The distribution of the errors of many numbers, in units in the last place.
///
/// ```
/// use judge::errors::{ErrorSpread, NumberError};
/// let errors = [1.0, 2.0, 8.0].map(|ulps| NumberError { ulps, of_bound: ulps / 4.0 });
/// let spread = ErrorSpread::of(&errors).unwrap();
/// assert_eq!((spread.p50, spread.of_bound), (2.0, 2.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ErrorSpread {
    /// The median.
    pub p50: f64,
    /// The 99th percentile.
    pub p99: f64,
    /// The largest error.
    pub max: f64,
    /// The largest ratio of an error to its bound; above 1 is wrong.
    pub of_bound: f64,
}

impl ErrorSpread {
    /// The distribution of `errors`; `None` if there are none. NaN counts as an infinite error.
    pub fn of<'a>(errors: impl IntoIterator<Item = &'a NumberError>) -> Option<ErrorSpread> {
        let or_infinite = |x: f64| if x.is_nan() { f64::INFINITY } else { x };
        let (mut ulps, shares): (Vec<f64>, Vec<f64>) = errors
            .into_iter()
            .map(|error| (or_infinite(error.ulps), or_infinite(error.of_bound)))
            .unzip();
        ulps.sort_by(f64::total_cmp);
        let max = *ulps.last()?;
        // The smallest number that at least this share of the numbers does not exceed (nearest
        // rank).
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
    fn nan_is_an_infinite_error() {
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
