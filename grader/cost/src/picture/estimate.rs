//! Estimates the error of random pictures against a reference that is also random.
//!
//! The reference is a pair of converged pictures `a` and `b` with independent random numbers. The
//! squared error of a picture `e` is estimated by the mean of `(e - a)(e - b)` over its pixels. Its
//! expected value is the variance of `e` plus its squared bias, because the errors of `a` and `b`
//! are independent and have mean 0. With a single converged picture, the estimate would include the
//! variance of that picture.

use super::curve::{ConfidenceInterval, CurvePoint};
use super::efficiency::efficiency;
use super::program::RenderedPicture;
use crate::quartiles::Quartiles;
use kit::Tally;

/// Fraction of the picture's mean that is added to the denominator of a pixel's relative error,
/// because a black pixel has no relative error.
const DARK: f64 = 0.1;

/// A bias is significant if it is this many standard errors from 0.
const BIAS_STANDARD_ERRORS: f64 = 3.0;

/// The two converged pictures that replace the true one.
#[derive(Clone, Debug)]
pub struct ConvergedPair {
    a: Vec<[f64; 3]>,
    b: Vec<[f64; 3]>,
    /// Mean of all pixels and channels.
    mean: f64,
}

impl ConvergedPair {
    /// Creates the pair from two pictures of one size; `None` if the sizes differ, the pictures are
    /// black, or a value is not finite.
    pub fn new(a: Vec<[f64; 3]>, b: Vec<[f64; 3]>) -> Option<ConvergedPair> {
        let both: Tally = a.iter().chain(&b).flatten().copied().collect();
        let mean = both.mean();
        (a.len() == b.len() && mean.is_finite() && mean > 0.0).then_some(ConvergedPair {
            a,
            b,
            mean,
        })
    }

    /// Returns the root mean square error of the mean of both pictures, relative to its mean.
    pub fn rmse(&self) -> f64 {
        let halves = self.a.iter().flatten().zip(self.b.iter().flatten());
        let squared: Tally = halves.map(|(a, b)| (a - b).powi(2) / 4.0).collect();
        squared.mean().sqrt() / self.mean
    }

    /// Estimates errors, variance and bias from pictures with independent random numbers. `samples`
    /// is the number of samples per pixel, used if the program does not print it. `is_relative`:
    /// the efficiency is that of the relative error. `None` if a picture has another size or a
    /// value that is not finite.
    pub fn point(
        &self,
        flags: &str,
        samples: f64,
        pictures: &[RenderedPicture],
        is_relative: bool,
    ) -> Option<CurvePoint> {
        let is_whole = |picture: &RenderedPicture| {
            picture.pixels.len() == self.a.len()
                && picture.pixels.iter().flatten().all(|c| c.is_finite())
        };
        if pictures.is_empty() || !pictures.iter().all(is_whole) {
            return None;
        }
        let [mse, relative_mse] = [false, true].map(|is_relative| {
            let each = pictures.iter().map(|p| self.mse(&p.pixels, is_relative));
            ConfidenceInterval::of_mean(&each.collect::<Vec<f64>>())
        });
        let (variance, bias) = self.variance_and_bias(pictures);
        let values = pictures.iter().flat_map(|picture| picture.pixels.iter());
        let mean = values.flatten().copied().collect::<Tally>().mean();
        let seconds = Quartiles::of(pictures.iter().map(|picture| picture.seconds));
        let samples: Tally = pictures
            .iter()
            .map(|s| s.samples.unwrap_or(samples))
            .collect();
        Some(CurvePoint {
            flags: flags.into(),
            samples: samples.mean(),
            seconds,
            rmse: mse.sqrt(),
            relative_mse,
            variance: variance / (self.mean * self.mean),
            bias: bias.map(|bias| bias / self.mean),
            mean_difference: mean / self.mean - 1.0,
            efficiency: efficiency(
                if is_relative { relative_mse } else { mse }.value,
                seconds.median,
            ),
            relative_efficiency: None,
        })
    }

    /// Returns `(e - a)(e - b)` and `(a + b)/2` for each value.
    fn products<'a>(&'a self, e: &'a [[f64; 3]]) -> impl Iterator<Item = (f64, f64)> + 'a {
        let converged = self.a.iter().flatten().zip(self.b.iter().flatten());
        let each = e.iter().flatten().zip(converged);
        each.map(|(e, (a, b))| ((e - a) * (e - b), 0.5 * (a + b)))
    }

    /// Estimates the mean squared error of a picture, relative to the squared mean of all pixels or
    /// to the squared value of each.
    pub(super) fn mse(&self, e: &[[f64; 3]], is_relative: bool) -> f64 {
        let squared = self.mean * self.mean;
        let dark = DARK * DARK * squared;
        let shares = self.products(e).map(|(product, converged)| {
            product
                / if is_relative {
                    converged * converged + dark
                } else {
                    squared
                }
        });
        shares.collect::<Tally>().mean()
    }

    /// Returns the variance of a picture, from the sample variance of the pictures, and the bias of
    /// their mean, if it is significant.
    fn variance_and_bias(&self, pictures: &[RenderedPicture]) -> (f64, Option<f64>) {
        let n = pictures.len() as f64;
        let mut variances = Tally::default();
        // The squared bias of each pixel; their scatter gives the standard error of the mean.
        let mut biases = Tally::default();
        for (i, (a, b)) in self.a.iter().zip(&self.b).enumerate() {
            let mut of_pixel = 0.0;
            for channel in 0..3 {
                let values: Tally = pictures.iter().map(|s| s.pixels[i][channel]).collect();
                let (mean, variance) = (values.mean(), values.variance());
                variances.push(variance);
                of_pixel += (mean - a[channel]) * (mean - b[channel]) - variance / n;
            }
            biases.push(of_pixel / 3.0);
        }
        let is_significant = biases.mean() > BIAS_STANDARD_ERRORS * biases.standard_error();
        // The variance cannot be estimated from one picture.
        let bias = (is_significant && n > 1.0).then(|| biases.mean().sqrt());
        (variances.mean(), bias)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::simulated;
    use crate::picture::simulated::converged;

    fn pictures(deviation: f64, offset: f64) -> Vec<RenderedPicture> {
        simulated::pictures(deviation, offset, 0.5)
    }

    #[test]
    fn noise_is_variance_without_bias() {
        let point = converged()
            .point("-s 4", 4.0, &pictures(0.2, 0.0), false)
            .expect("a point");
        // A deviation of 0.2 in a picture whose mean is 2.
        assert!((point.rmse.value - 0.1).abs() < 0.002, "{point:?}");
        assert!(point.rmse.low < 0.1 && 0.1 < point.rmse.high);
        assert!((point.variance - 0.01).abs() < 0.0003);
        assert_eq!(point.bias, None);
        assert!((point.efficiency.expect("an error") - 200.0).abs() < 8.0);
        assert!((point.relative_mse.value - 0.01).abs() < 0.0005);
    }

    /// The remaining error of the converged pictures does not bias the estimate.
    #[test]
    fn the_error_may_be_below_that_of_the_converged_pictures() {
        let point = converged()
            .point("-s 4", 4.0, &pictures(0.02, 0.0), false)
            .expect("a point");
        assert!((point.rmse.value - 0.01).abs() < 0.005, "{point:?}");
        assert!((converged().rmse() - 0.1 / 8.0_f64.sqrt()).abs() < 0.05);
    }

    #[test]
    fn an_offset_is_bias() {
        let point = converged()
            .point("-s 4", 4.0, &pictures(0.2, 0.1), false)
            .expect("a point");
        assert!(
            (point.bias.expect("a significant bias") - 0.05).abs() < 0.003,
            "{point:?}"
        );
        let mean = point.mean_difference;
        assert!((mean - 0.05).abs() < 0.003, "{mean}");
        let mse: f64 = 0.01 + 0.05 * 0.05;
        assert!((point.rmse.value - mse.sqrt()).abs() < 0.003);
        assert!((point.efficiency.expect("an error") - 2.0 / mse).abs() < 6.0);
    }

    #[test]
    fn the_bias_of_pictures_without_noise_is_an_error() {
        let mut all = pictures(0.2, 0.1);
        let first = all[0].clone();
        all.fill(first);
        let point = converged().point("-s 1", 1.0, &all, false);
        let point = point.expect("a point");
        assert_eq!((point.variance, point.is_random()), (0.0, false));
        assert!(point.efficiency.expect("an error") < 200.0);
    }

    #[test]
    fn pictures_with_nan_or_without_light_are_rejected() {
        let mut all = pictures(0.2, 0.0);
        all[1].pixels[7][1] = f64::NAN;
        assert_eq!(converged().point("-s 4", 4.0, &all, false), None);
        assert!(ConvergedPair::new(vec![[0.0; 3]], vec![[0.0; 3]]).is_none());
    }
}
