//! Estimates the error of random pictures against a reference that is also random.
//!
//! The reference is a pair of converged pictures `a` and `b` with independent random numbers. The
//! squared error of a picture `e` is estimated by the mean of `(e - a)(e - b)` over its pixels. Its
//! expected value is the variance of `e` plus its squared bias, because the errors of `a` and `b`
//! are independent and have mean 0. With a single converged picture, the estimate would include the
//! variance of that picture.

use super::curve::{ConfidenceInterval, CurvePoint};
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
    /// is the number of samples per pixel, used if the program does not print it. `None` if a
    /// picture has another size or a value that is not finite.
    pub fn point(
        &self,
        flags: &str,
        samples: f64,
        pictures: &[RenderedPicture],
    ) -> Option<CurvePoint> {
        let is_whole = |picture: &RenderedPicture| {
            picture.pixels.len() == self.a.len()
                && picture.pixels.iter().flatten().all(|c| c.is_finite())
        };
        if pictures.is_empty() || !pictures.iter().all(is_whole) {
            return None;
        }
        let squared = self.mean * self.mean;
        let mse: Vec<f64> = pictures
            .iter()
            .map(|s| self.mse(&s.pixels) / squared)
            .collect();
        let relative: Vec<f64> = pictures
            .iter()
            .map(|s| self.relative_mse(&s.pixels))
            .collect();
        let (variance, bias) = self.variance_and_bias(pictures);
        let variance = variance / squared;
        let seconds = Quartiles::of(pictures.iter().map(|picture| picture.seconds));
        let samples: Tally = pictures
            .iter()
            .map(|s| s.samples.unwrap_or(samples))
            .collect();
        Some(CurvePoint {
            flags: flags.into(),
            samples: samples.mean(),
            seconds: seconds.median,
            seconds_spread: seconds.spread(),
            rmse: ConfidenceInterval::of_mean(&mse).sqrt(),
            relative_mse: ConfidenceInterval::of_mean(&relative),
            variance,
            bias: bias.map(|bias| bias / self.mean),
            efficiency: (variance > 0.0 && seconds.median > 0.0)
                .then(|| 1.0 / (variance * seconds.median)),
        })
    }

    /// Returns `(e - a)(e - b)` and `(a + b)/2` for each value.
    fn products<'a>(&'a self, e: &'a [[f64; 3]]) -> impl Iterator<Item = (f64, f64)> + 'a {
        let converged = self.a.iter().flatten().zip(self.b.iter().flatten());
        let each = e.iter().flatten().zip(converged);
        each.map(|(e, (a, b))| ((e - a) * (e - b), 0.5 * (a + b)))
    }

    fn mse(&self, e: &[[f64; 3]]) -> f64 {
        self.products(e)
            .map(|(product, _)| product)
            .collect::<Tally>()
            .mean()
    }

    fn relative_mse(&self, e: &[[f64; 3]]) -> f64 {
        let dark = (DARK * self.mean).powi(2);
        let shares = self
            .products(e)
            .map(|(product, converged)| product / (converged * converged + dark));
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
    use kit::PixelSampler;

    /// Returns a grey picture with value 2 and uniform noise of this standard deviation.
    fn noisy(seed: u32, deviation: f64, offset: f64) -> Vec<[f64; 3]> {
        let mut random = PixelSampler::new(seed, 0, 7);
        let width = deviation * 12.0_f64.sqrt();
        let pixel = |_| [(); 3].map(|()| 2.0 + offset + width * (random.next_1d() - 0.5));
        (0..4000).map(pixel).collect()
    }

    fn pictures(deviation: f64, offset: f64) -> Vec<RenderedPicture> {
        let picture = |seed| RenderedPicture {
            pixels: noisy(seed, deviation, offset),
            seconds: 0.5,
            samples: None,
        };
        (10..15).map(picture).collect()
    }

    fn converged() -> ConvergedPair {
        ConvergedPair::new(noisy(1, 0.1, 0.0), noisy(2, 0.1, 0.0)).expect("pictures")
    }

    #[test]
    fn noise_is_variance_without_bias() {
        let point = converged()
            .point("-s 4", 4.0, &pictures(0.2, 0.0))
            .expect("a point");
        // A deviation of 0.2 in a picture whose mean is 2.
        assert!((point.rmse.value - 0.1).abs() < 0.002, "{point:?}");
        assert!(point.rmse.low < 0.1 && 0.1 < point.rmse.high);
        assert!((point.variance - 0.01).abs() < 0.0003);
        assert_eq!(point.bias, None);
        assert!((point.efficiency.expect("random") - 200.0).abs() < 6.0);
        assert!((point.relative_mse.value - 0.01).abs() < 0.0005);
    }

    /// The remaining error of the converged pictures does not bias the estimate.
    #[test]
    fn the_error_may_be_below_that_of_the_converged_pictures() {
        let point = converged()
            .point("-s 4", 4.0, &pictures(0.02, 0.0))
            .expect("a point");
        assert!((point.rmse.value - 0.01).abs() < 0.005, "{point:?}");
        assert!((converged().rmse() - 0.1 / 8.0_f64.sqrt()).abs() < 0.05);
    }

    #[test]
    fn an_offset_is_bias() {
        let point = converged()
            .point("-s 4", 4.0, &pictures(0.2, 0.1))
            .expect("a point");
        assert!(
            (point.bias.expect("a significant bias") - 0.05).abs() < 0.003,
            "{point:?}"
        );
        assert!((point.rmse.value - (0.01_f64 + 0.0025).sqrt()).abs() < 0.003);
    }

    #[test]
    fn pictures_without_noise_have_no_efficiency() {
        let mut all = pictures(0.2, 0.1);
        let first = all[0].clone();
        all.fill(first);
        let point = converged().point("-s 1", 1.0, &all).expect("a point");
        assert_eq!((point.variance, point.efficiency), (0.0, None));
    }

    #[test]
    fn pictures_with_nan_or_without_light_are_rejected() {
        let mut all = pictures(0.2, 0.0);
        all[1].pixels[7][1] = f64::NAN;
        assert_eq!(converged().point("-s 4", 4.0, &all), None);
        assert!(ConvergedPair::new(vec![[0.0; 3]], vec![[0.0; 3]]).is_none());
    }
}
