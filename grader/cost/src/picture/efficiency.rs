//! The efficiency of a rendering method, 1/(MSE · seconds), compared with another one's.
//!
//! At twice the efficiency, an unbiased method reaches the same error in half the time. The mean
//! squared error includes the squared bias, which more samples do not reduce: with the variance
//! instead, a method that is fast because it leaves light out would be the most efficient one.

use super::estimate::ConvergedPair;
use super::program::RenderedPicture;
use crate::quartiles::Quartiles;

/// Returns the efficiency for a mean squared error; `None` unless error and time are positive. (The
/// estimate of a very small error may be 0 or negative.)
pub(super) fn efficiency(mse: f64, seconds: f64) -> Option<f64> {
    (mse > 0.0 && seconds > 0.0).then(|| 1.0 / (mse * seconds))
}

/// Returns the ratio of the efficiencies of two methods. Each picture is compared with that of the
/// other method in the same round. `is_relative`: the error is relative to each pixel's own value.
pub fn relative_efficiency(
    converged: &ConvergedPair,
    pictures: &[RenderedPicture],
    base: &[RenderedPicture],
    is_relative: bool,
) -> Option<Quartiles> {
    let of = |picture: &RenderedPicture| {
        efficiency(converged.mse(&picture.pixels, is_relative), picture.seconds)
    };
    let rounds = pictures.iter().zip(base);
    let ratios: Vec<f64> = rounds
        .filter_map(|(own, base)| Some(of(own)? / of(base)?))
        .collect();
    (!ratios.is_empty()).then(|| Quartiles::of(ratios))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::simulated::{converged, pictures};

    /// Methods at two numbers of samples: the second takes 16 times as long and has a quarter of
    /// the noise.
    const STEPS: [f64; 2] = [1.0, 16.0];

    /// Renders a grey picture without bias, or in half the time a picture that lacks 43 % of the
    /// light, as `-m 1` does in a Cornell box.
    fn method(is_biased: bool, samples: f64) -> Vec<RenderedPicture> {
        let deviation = 1.6 / samples.sqrt();
        if is_biased {
            pictures(0.57 * deviation, -0.86, 0.25 * samples)
        } else {
            pictures(deviation, 0.0, 0.5 * samples)
        }
    }

    #[test]
    fn a_biased_method_does_not_come_out_best() {
        let compared = STEPS.map(|samples| {
            let [biased, unbiased] = [true, false].map(|biased| method(biased, samples));
            relative_efficiency(&converged(), &biased, &unbiased, false).expect("a ratio")
        });
        let [few, many] = compared;
        // With one sample a point of the two methods may be close: noise is the larger error. With
        // more samples the bias remains and every one of them is wasted.
        assert!(many.upper < 0.5 && many.upper < few.lower, "{compared:?}");
        // By the variance it would be 6 times as efficient, with any number of samples.
        let variance = |biased| {
            let point = converged().point("", 1.0, &method(biased, STEPS[1]), false);
            point.expect("a point").variance
        };
        assert!(2.0 * variance(false) / variance(true) > 5.0);
    }

    #[test]
    fn half_the_time_or_half_the_squared_error_is_twice_the_efficiency() {
        let of = |deviation: f64, seconds| {
            let [own, base] = [pictures(deviation, 0.0, seconds), pictures(0.2, 0.0, 0.5)];
            let ratio = relative_efficiency(&converged(), &own, &base, false);
            ratio.expect("a ratio").median
        };
        assert!((of(0.2, 0.25) - 2.0).abs() < 1e-9);
        assert!((of(0.2 / 2.0_f64.sqrt(), 0.5) - 2.0).abs() < 0.2);
    }

    #[test]
    fn without_a_positive_error_there_is_no_efficiency() {
        assert_eq!(efficiency(0.0, 1.0), None);
        assert_eq!(efficiency(-1e-9, 1.0), None);
        assert_eq!(efficiency(0.5, 0.5), Some(4.0));
    }
}
