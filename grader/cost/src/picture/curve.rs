//! What is said of pictures: error against samples and against seconds.

use serde::{Deserialize, Serialize};

/// All that is compared.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pictures {
    /// A question each.
    pub experiments: Vec<Experiment>,
    /// Why there are none, if there are none.
    pub missing: Option<String>,
}

/// Ways to render the same picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Experiment {
    /// What is compared, in a few words.
    pub title: String,
    /// The scene's file name.
    pub scene: String,
    /// Pixels across and up.
    pub film: [u32; 2],
    /// The part of it that is rendered: left, bottom, width, height.
    pub cell: [u32; 4],
    /// Pictures a point, each with random numbers of its own.
    pub seeds: u32,
    /// What the converged picture was rendered with. There are two of it, with random numbers of their own.
    pub converged: String,
    /// Whether the ways aim at an equal share of error in every pixel: then the relative error is what to look at.
    pub is_relative: bool,
    /// The error that is left in the mean of the two, as a share of the picture's mean.
    pub converged_rmse: f64,
    /// A way each. Efficiency is compared to the first one's.
    pub curves: Vec<Curve>,
    /// Why curves are missing, if some are.
    pub missing: Option<String>,
}

/// One way to render, with more and more samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Its name.
    pub name: String,
    /// The flags of the program that choose it.
    pub flags: String,
    /// From few samples to many.
    pub points: Vec<Point>,
    /// The error falls as the samples to this power (least squares in logarithms, over the points with something random):
    /// -1/2 for independent samples. `None` with fewer than three such points.
    pub slope: Option<f64>,
}

/// Pictures with so many samples. Errors are shares of the picture's mean value, over all pixels and channels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The flags that say how many.
    pub flags: String,
    /// Samples a pixel that were taken, on average.
    pub samples: f64,
    /// Seconds to render on one thread, loading and building left aside: the median of the pictures.
    pub seconds: f64,
    /// Distance between the quartiles of the seconds.
    pub seconds_spread: f64,
    /// Root mean square error.
    pub rmse: Interval,
    /// Mean of the squared error over the squared value of each pixel: dark pixels count as much as bright ones.
    pub relative_mse: Interval,
    /// How far pictures scatter around their mean, squared. 0 where nothing is random.
    pub variance: f64,
    /// How far their mean is from the converged picture (root mean square), where that can be told from noise: it is at least
    /// three of its standard errors from 0.
    pub bias: Option<f64>,
    /// 1/(variance · seconds): twice of it is as good a picture in half of the time. `None` where nothing is random.
    pub efficiency: Option<f64>,
}

/// A mean and where the true one lies: in 95 of 100 runs between `low` and `high`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// The mean.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// 97.5 % quantiles of Student's t for 1, 2, ... degrees of freedom; beyond, the normal distribution is near enough.
const STUDENT: [f64; 9] = [
    12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262,
];

impl Interval {
    /// Of the mean of quantities that cannot be negative, by Student's t distribution. With one alone the interval is that
    /// number and all below and above it.
    pub fn of_mean(values: &[f64]) -> Interval {
        let tally: kit::Tally = values.iter().copied().collect();
        let degrees = values.len().saturating_sub(1);
        let t = match degrees {
            0 => 0.0,
            _ => STUDENT.get(degrees - 1).copied().unwrap_or(1.96),
        };
        let half = t * tally.standard_error();
        Interval {
            value: tally.mean().max(0.0),
            low: (tally.mean() - half).max(0.0),
            high: (tally.mean() + half).max(0.0),
        }
    }

    /// Of the square root.
    pub fn sqrt(self) -> Interval {
        Interval {
            value: self.value.sqrt(),
            low: self.low.sqrt(),
            high: self.high.sqrt(),
        }
    }
}

impl Point {
    /// What its error is measured by: relative to each pixel's own value, or to the picture's mean.
    pub fn error(&self, is_relative: bool) -> Interval {
        if is_relative {
            self.relative_mse.sqrt()
        } else {
            self.rmse
        }
    }

    /// Whether other random numbers give another picture.
    pub fn is_random(&self) -> bool {
        self.variance > 0.0
    }
}

impl Curve {
    /// Samples and errors of the points where something is random: what a line can be laid through.
    pub fn falling(points: &[Point], is_relative: bool) -> Vec<(f64, f64)> {
        let random = points.iter().filter(|p| p.is_random());
        let errors = random.map(|p| (p.samples, p.error(is_relative).value));
        errors.filter(|(_, error)| *error > 0.0).collect()
    }

    /// The quantity `x` at which `error` has come down to `least`, between the points, straight in logarithms; `None` if the
    /// curve does not go through it.
    pub fn at_error(
        &self,
        least: f64,
        error: impl Fn(&Point) -> f64,
        x: impl Fn(&Point) -> f64,
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

    fn point(samples: f64, rmse: f64) -> Point {
        Point {
            flags: String::new(),
            samples,
            seconds: samples,
            seconds_spread: 0.0,
            rmse: Interval {
                value: rmse,
                low: rmse,
                high: rmse,
            },
            relative_mse: Interval::of_mean(&[rmse * rmse]),
            variance: 1.0,
            bias: None,
            efficiency: None,
        }
    }

    #[test]
    fn the_interval_is_students() {
        let interval = Interval::of_mean(&[1.0, 2.0, 3.0]);
        let half = 4.303 / 3.0_f64.sqrt();
        assert_eq!(interval.value, 2.0);
        assert!((interval.high - (2.0 + half)).abs() < 1e-12);
        assert_eq!(interval.low, 0.0, "an error is not negative");
    }

    #[test]
    fn between_points_the_curve_is_straight_in_logarithms() {
        let curve = Curve {
            name: String::new(),
            flags: String::new(),
            points: vec![point(1.0, 8.0), point(16.0, 2.0), point(64.0, 1.0)],
            slope: None,
        };
        let samples_at = |error| curve.at_error(error, |p| p.rmse.value, |p| p.samples);
        assert!((samples_at(4.0).unwrap() - 4.0).abs() < 1e-12);
        assert_eq!(samples_at(0.5), None);
        assert_eq!(samples_at(9.0), None);
    }
}
