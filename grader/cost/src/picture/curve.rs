//! The results for pictures: error against samples and against seconds.

use crate::quartiles::Quartiles;
use pictures::tone::tone;
use serde::{Deserialize, Serialize};

/// The results of all experiments.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PictureReport {
    /// The experiments.
    pub experiments: Vec<Experiment>,
    /// Why there are none, if there are none.
    pub missing: Option<String>,
}

/// The results of methods that render the same picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Experiment {
    /// A short title.
    pub title: String,
    /// The scene's file name.
    pub scene: String,
    /// Width and height in pixels.
    pub film: [u32; 2],
    /// The part of it that is rendered: left, bottom, width, height.
    pub cell: [u32; 4],
    /// Pictures per point of a curve, with independent random numbers.
    pub seeds: u32,
    /// The flags of the converged picture. There are two, with independent random numbers.
    pub converged: String,
    /// Whether the methods aim at an equal relative error in every pixel; then the relative error
    /// is compared.
    pub is_relative: bool,
    /// What the axis of samples counts, such as "camera rays per pixel".
    pub samples_are: String,
    /// The converged picture. It is not part of the JSON.
    #[serde(skip)]
    pub reference: Option<Thumbnail>,
    /// The remaining error of the mean of the two converged pictures, relative to the picture's
    /// mean.
    pub converged_rmse: f64,
    /// One curve per method. Efficiency is relative to the first one.
    pub curves: Vec<Curve>,
    /// Why curves are missing, if some are.
    pub missing: Option<String>,
}

/// The results of one method with increasing numbers of samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// The name.
    pub name: String,
    /// The flags that select the method.
    pub flags: String,
    /// The points, by increasing number of samples.
    pub points: Vec<CurvePoint>,
    /// The slope of log(error) against log(samples), by least squares over the points that are
    /// random: -1/2 for independent samples. `None` with fewer than three such points.
    pub slope: Option<f64>,
    /// The point whose time is most like that of the other curves, and its picture. It is not part
    /// of the JSON.
    #[serde(skip)]
    pub at_equal_time: Option<(usize, Thumbnail)>,
}

/// A small picture in the colours of a screen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Thumbnail {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The pixels, in rows from the top.
    pub pixels: Vec<[u8; 3]>,
}

impl Thumbnail {
    /// Converts linear radiance, in rows from the top.
    pub fn of(size: [u32; 2], radiance: &[[f64; 3]]) -> Thumbnail {
        Thumbnail {
            size,
            pixels: radiance.iter().copied().map(tone).collect(),
        }
    }
}

/// The results for one number of samples. Errors are relative to the picture's mean value, over all
/// pixels and channels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurvePoint {
    /// The flags for the number of samples.
    pub flags: String,
    /// Mean number of samples per pixel.
    pub samples: f64,
    /// Seconds to render on one thread, without loading and tree construction, over the pictures.
    pub seconds: Quartiles,
    /// Root mean square error.
    pub rmse: ConfidenceInterval,
    /// Mean of the squared error over the squared value of each pixel: dark and bright pixels have
    /// the same weight.
    pub relative_mse: ConfidenceInterval,
    /// Variance of a picture; 0 if nothing is random.
    pub variance: f64,
    /// Root mean square bias: the difference of the pictures' mean from the converged picture.
    /// `None` if it is not significant, less than three standard errors from 0.
    pub bias: Option<f64>,
    /// The pictures' mean value, relative to that of the converged picture, minus 1.
    pub mean_difference: f64,
    /// 1/(MSE · seconds), where the mean squared error includes the squared bias: see
    /// [`efficiency`](super::efficiency). `None` if the estimate of the error is not positive.
    pub efficiency: Option<f64>,
    /// Ratio to the efficiency of the first method with its number of samples at the same place of
    /// its curve, over rounds. `None` if the first method has no such point.
    pub relative_efficiency: Option<Quartiles>,
}

/// A mean with its 95 % confidence interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConfidenceInterval {
    /// The mean.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// 97.5 % quantiles of Student's t for 1, 2, ... degrees of freedom; beyond, the normal
/// distribution is close enough.
const STUDENT: [f64; 9] = [
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262,
];

impl ConfidenceInterval {
    /// Returns the interval of the mean of non-negative quantities, by Student's t distribution.
    /// With a single value the interval has length 0.
    pub fn of_mean(values: &[f64]) -> ConfidenceInterval {
        let tally: kit::Tally = values.iter().copied().collect();
        let degrees = values.len().saturating_sub(1);
        let t = match degrees {
            0 => 0.0,
            _ => STUDENT.get(degrees - 1).copied().unwrap_or(1.96),
        };
        let half = t * tally.standard_error();
        ConfidenceInterval {
            value: tally.mean().max(0.0),
            low: (tally.mean() - half).max(0.0),
            high: (tally.mean() + half).max(0.0),
        }
    }

    /// Returns the interval of the square root.
    pub fn sqrt(self) -> ConfidenceInterval {
        ConfidenceInterval {
            value: self.value.sqrt(),
            low: self.low.sqrt(),
            high: self.high.sqrt(),
        }
    }
}

impl CurvePoint {
    /// Returns the error, relative to each pixel's own value or to the picture's mean.
    pub fn error(&self, is_relative: bool) -> ConfidenceInterval {
        if is_relative {
            self.relative_mse.sqrt()
        } else {
            self.rmse
        }
    }

    /// Whether the picture depends on the random numbers.
    pub fn is_random(&self) -> bool {
        self.variance > 0.0
    }
}

impl Curve {
    /// Returns samples and errors of the points that are random, for the fit of the slope.
    pub fn random_points(points: &[CurvePoint], is_relative: bool) -> Vec<(f64, f64)> {
        let random = points.iter().filter(|p| p.is_random());
        let errors = random.map(|p| (p.samples, p.error(is_relative).value));
        errors.filter(|(_, error)| *error > 0.0).collect()
    }

    /// Returns the quantity `x` at which `error` has fallen to `least`, by linear interpolation of
    /// logarithms between the points; `None` if the curve does not contain that error.
    pub fn at_error(
        &self,
        least: f64,
        error: impl Fn(&CurvePoint) -> f64,
        x: impl Fn(&CurvePoint) -> f64,
    ) -> Option<f64> {
        self.points.windows(2).find_map(|pair| {
            let [a, b] = pair else { return None };
            let (ea, eb) = (error(a), error(b));
            if !(eb <= least && least <= ea && eb > 0.0) {
                return None;
            }
            let share = if ea > eb {
                (ea / least).ln() / (ea / eb).ln()
            } else {
                0.0
            };
            Some(x(a) * (x(b) / x(a)).powf(share))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(samples: f64, rmse: f64) -> CurvePoint {
        CurvePoint {
            flags: String::new(),
            samples,
            seconds: Quartiles::of([samples]),
            rmse: ConfidenceInterval {
                value: rmse,
                low: rmse,
                high: rmse,
            },
            relative_mse: ConfidenceInterval::of_mean(&[rmse * rmse]),
            variance: 1.0,
            bias: None,
            mean_difference: 0.0,
            efficiency: None,
            relative_efficiency: None,
        }
    }

    #[test]
    fn the_interval_uses_students_t() {
        let interval = ConfidenceInterval::of_mean(&[1.0, 2.0, 3.0]);
        let half = 4.303 / 3.0_f64.sqrt();
        assert_eq!(interval.value, 2.0);
        assert!((interval.high - (2.0 + half)).abs() < 1e-12);
        assert_eq!(interval.low, 0.0, "an error cannot be negative");
    }

    #[test]
    fn interpolation_is_linear_in_logarithms() {
        let curve = Curve {
            name: String::new(),
            flags: String::new(),
            points: vec![point(1.0, 8.0), point(16.0, 2.0), point(64.0, 1.0)],
            slope: None,
            at_equal_time: None,
        };
        let samples_at = |error| curve.at_error(error, |p| p.rmse.value, |p| p.samples);
        assert!((samples_at(4.0).unwrap() - 4.0).abs() < 1e-12);
        assert_eq!(samples_at(0.5), None);
        assert_eq!(samples_at(9.0), None);
    }
}
