//! How the mean of a pixel's samples settles.

use kit::Tally;
use pathtracer::replay::PixelReplay;

/// The mean of the first samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settling {
    /// The number of samples.
    pub samples: u64,
    /// The mean of their luminances.
    pub mean: f64,
    /// The standard error of the mean.
    pub error: f64,
}

/// The most points of a curve.
const MAX_POINTS: usize = 64;

/// The mean after each batch of samples; without batches after as many as a curve shows.
pub fn settling(replay: &PixelReplay, batch: Option<u32>) -> Vec<Settling> {
    let count = replay.samples.len();
    let step = match batch {
        Some(batch) => batch.max(1) as usize,
        None => count.div_ceil(MAX_POINTS).max(1),
    };
    let mut tally = Tally::default();
    let mut points = Vec::new();
    for (i, sample) in replay.samples.iter().enumerate() {
        tally.push(sample.radiance.luminance());
        // The last batch may be smaller.
        if (i + 1) % step == 0 || i + 1 == count {
            points.push(Settling {
                samples: tally.count(),
                mean: tally.mean(),
                error: tally.standard_error(),
            });
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{PixelEstimate, Spectrum, Vec2};
    use pathtracer::replay::SampleRecord;

    fn replay(luminances: &[f64]) -> PixelReplay {
        let sample = |&luminance: &f64| SampleRecord {
            sensor: Vec2::ZERO,
            of_path: Spectrum::grey(luminance),
            radiance: Spectrum::grey(luminance),
            rays: Vec::new(),
            roulettes: Vec::new(),
        };
        PixelReplay {
            pixel: (0, 0),
            estimate: PixelEstimate::default(),
            luminance: None,
            counters: Default::default(),
            samples: luminances.iter().map(sample).collect(),
        }
    }

    #[test]
    fn every_batch_has_a_point_and_the_last_samples_too() {
        let replay = replay(&[1.0, 3.0, 2.0, 2.0, 7.0]);
        let points = settling(&replay, Some(2));
        let samples: Vec<u64> = points.iter().map(|point| point.samples).collect();
        assert_eq!(samples, [2, 4, 5]);
        assert!((points[1].mean - 2.0).abs() < 1e-12);
        assert!((points[2].mean - 3.0).abs() < 1e-12);
        // The variance of 1 and 3 is 2, that of their mean 1.
        assert!((points[0].error - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_curve_of_many_samples_stays_short() {
        let points = settling(&replay(&[0.5; 1000]), None);
        assert!(points.len() <= MAX_POINTS);
        assert_eq!(points.last().map(|point| point.samples), Some(1000));
    }
}
