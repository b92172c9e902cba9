//! The error of pictures that are random, against a picture that is random, too.
//!
//! Two converged pictures `a` and `b` with random numbers of their own take the place of the truth. The error of a picture
//! `e`, squared, is estimated by the mean of `(e - a)(e - b)` over its pixels: on average that is the variance of `e` and
//! its squared bias and nothing else, because the errors of `a` and `b` are as often of one sign as of the other. With one
//! converged picture its own error would be counted, too, and a good picture would seem no better than the converged one.

use super::curve::{Interval, Point};
use super::program::Shot;
use crate::quartiles::Quartiles;
use kit::Tally;

/// Below this share of the picture's mean a pixel's relative error is taken to that: a black pixel has none.
const DARK: f64 = 0.1;

/// A bias is told from noise by so many of its standard errors.
const TOLD_FROM_NOISE: f64 = 3.0;

/// The two converged pictures.
#[derive(Clone, Debug)]
pub struct Truth {
    a: Vec<[f64; 3]>,
    b: Vec<[f64; 3]>,
    /// Mean of all pixels and channels.
    mean: f64,
}

impl Truth {
    /// From two pictures of one size that have light in them; `None` from others.
    pub fn new(a: Vec<[f64; 3]>, b: Vec<[f64; 3]>) -> Option<Truth> {
        let both: Tally = a.iter().chain(&b).flatten().copied().collect();
        let mean = both.mean();
        (a.len() == b.len() && mean.is_finite() && mean > 0.0).then_some(Truth { a, b, mean })
    }

    /// The root mean square error of the mean of both, as a share of the picture's mean.
    pub fn rmse(&self) -> f64 {
        let halves = self.a.iter().flatten().zip(self.b.iter().flatten());
        let squared: Tally = halves.map(|(a, b)| (a - b).powi(2) / 4.0).collect();
        squared.mean().sqrt() / self.mean
    }

    /// What pictures of one kind show, rendered with random numbers of their own each: `samples` is how many each pixel took
    /// where the program does not tell. `None` if one has not this picture's size, or a value that is not a number.
    pub fn judge(&self, flags: &str, samples: f64, shots: &[Shot]) -> Option<Point> {
        let is_whole = |shot: &Shot| {
            shot.pixels.len() == self.a.len() && shot.pixels.iter().flatten().all(|c| c.is_finite())
        };
        if shots.is_empty() || !shots.iter().all(is_whole) {
            return None;
        }
        let squared = self.mean * self.mean;
        let mse: Vec<f64> = shots
            .iter()
            .map(|s| self.mse(&s.pixels) / squared)
            .collect();
        let relative: Vec<f64> = shots.iter().map(|s| self.relative_mse(&s.pixels)).collect();
        let (variance, bias) = self.variance_and_bias(shots);
        let variance = variance / squared;
        let seconds = Quartiles::of(shots.iter().map(|shot| shot.seconds));
        let samples: Tally = shots.iter().map(|s| s.samples.unwrap_or(samples)).collect();
        Some(Point {
            flags: flags.into(),
            samples: samples.mean(),
            seconds: seconds.median,
            seconds_spread: seconds.spread(),
            rmse: Interval::of_mean(&mse).sqrt(),
            relative_mse: Interval::of_mean(&relative),
            variance,
            bias: bias.map(|bias| bias / self.mean),
            efficiency: (variance > 0.0 && seconds.median > 0.0)
                .then(|| 1.0 / (variance * seconds.median)),
        })
    }

    /// `(e - a)(e - b)` and `(a + b)/2`, value by value.
    fn products<'a>(&'a self, e: &'a [[f64; 3]]) -> impl Iterator<Item = (f64, f64)> + 'a {
        let truth = self.a.iter().flatten().zip(self.b.iter().flatten());
        let each = e.iter().flatten().zip(truth);
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
            .map(|(product, truth)| product / (truth * truth + dark));
        shares.collect::<Tally>().mean()
    }

    /// The variance of a picture, from how far the pictures scatter; and how far their mean is from the truth, if that can be
    /// told from noise.
    fn variance_and_bias(&self, shots: &[Shot]) -> (f64, Option<f64>) {
        let n = shots.len() as f64;
        let mut variances = Tally::default();
        // The squared bias, pixel by pixel: each is off by chance, and how far they scatter says how far their mean is.
        let mut biases = Tally::default();
        for (i, (a, b)) in self.a.iter().zip(&self.b).enumerate() {
            let mut of_pixel = 0.0;
            for channel in 0..3 {
                let values: Tally = shots.iter().map(|s| s.pixels[i][channel]).collect();
                let (mean, variance) = (values.mean(), values.variance());
                variances.push(variance);
                of_pixel += (mean - a[channel]) * (mean - b[channel]) - variance / n;
            }
            biases.push(of_pixel / 3.0);
        }
        let told = biases.mean() > TOLD_FROM_NOISE * biases.standard_error();
        // From one picture alone nobody knows its variance.
        let bias = (told && n > 1.0).then(|| biases.mean().sqrt());
        (variances.mean(), bias)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::PixelSampler;

    /// A grey picture of 2, with uniform noise of this standard deviation.
    fn noisy(seed: u32, deviation: f64, offset: f64) -> Vec<[f64; 3]> {
        let mut random = PixelSampler::new(seed, 0, 7);
        let width = deviation * 12.0_f64.sqrt();
        let pixel = |_| [(); 3].map(|()| 2.0 + offset + width * (random.next_1d() - 0.5));
        (0..4000).map(pixel).collect()
    }

    fn shots(deviation: f64, offset: f64) -> Vec<Shot> {
        let shot = |seed| Shot {
            pixels: noisy(seed, deviation, offset),
            seconds: 0.5,
            samples: None,
        };
        (10..15).map(shot).collect()
    }

    fn truth() -> Truth {
        Truth::new(noisy(1, 0.1, 0.0), noisy(2, 0.1, 0.0)).expect("pictures")
    }

    #[test]
    fn noise_is_variance_and_no_bias() {
        let point = truth()
            .judge("-s 4", 4.0, &shots(0.2, 0.0))
            .expect("a point");
        // 0.2 of a picture whose mean is 2.
        assert!((point.rmse.value - 0.1).abs() < 0.002, "{point:?}");
        assert!(point.rmse.low < 0.1 && 0.1 < point.rmse.high);
        assert!((point.variance - 0.01).abs() < 0.0003);
        assert_eq!(point.bias, None);
        assert!((point.efficiency.expect("random") - 200.0).abs() < 6.0);
        assert!((point.relative_mse.value - 0.01).abs() < 0.0005);
    }

    /// The error that is left in the converged pictures is not taken for the error of the picture.
    #[test]
    fn a_picture_may_be_better_than_the_converged_one() {
        let point = truth()
            .judge("-s 4", 4.0, &shots(0.02, 0.0))
            .expect("a point");
        assert!((point.rmse.value - 0.01).abs() < 0.005, "{point:?}");
        assert!((truth().rmse() - 0.1 / 8.0_f64.sqrt()).abs() < 0.05);
    }

    #[test]
    fn what_does_not_average_out_is_bias() {
        let point = truth()
            .judge("-s 4", 4.0, &shots(0.2, 0.1))
            .expect("a point");
        assert!(
            (point.bias.expect("it is seen") - 0.05).abs() < 0.003,
            "{point:?}"
        );
        assert!((point.rmse.value - (0.01_f64 + 0.0025).sqrt()).abs() < 0.003);
    }

    #[test]
    fn what_is_not_random_has_no_efficiency() {
        let mut all = shots(0.2, 0.1);
        let first = all[0].clone();
        all.fill(first);
        let point = truth().judge("-s 1", 1.0, &all).expect("a point");
        assert_eq!((point.variance, point.efficiency), (0.0, None));
    }

    #[test]
    fn pictures_that_are_no_pictures_are_refused() {
        let mut all = shots(0.2, 0.0);
        all[1].pixels[7][1] = f64::NAN;
        assert_eq!(truth().judge("-s 4", 4.0, &all), None);
        assert!(Truth::new(vec![[0.0; 3]], vec![[0.0; 3]]).is_none());
    }
}
