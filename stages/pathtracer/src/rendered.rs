//! What is rendered, and what came of it.

use crate::Counters;
use kit::effects::EffectCounts;
use kit::film::Cell;
use kit::sampler::Sampling;
use kit::{Camera, Film, FilmSize, PixelEstimate, Tally};

/// What to render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Job {
    /// From where.
    pub camera: Camera,
    /// The whole picture's size.
    pub film: FilmSize,
    /// The part of it that is rendered.
    pub cell: Cell,
    /// Camera rays a pixel.
    pub samples: u32,
    /// Where the random numbers come from.
    pub sampling: Sampling,
}

/// A picture and what it took.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// The whole film; black outside the cell.
    pub film: Film,
    /// The samples' luminances for each pixel of the film, as [`Film::pixels`] has them; empty for normals.
    pub luminance: Vec<Tally>,
    /// What was counted.
    pub counters: Counters,
    /// What light transport took.
    pub effects: EffectCounts,
}

impl Rendered {
    /// Pixels with a NaN in them. There should be none.
    pub fn nan_pixels(&self) -> usize {
        let pixels = self.film.pixels().iter();
        pixels
            .filter(|pixel| pixel.radiance.to_array().iter().any(|c| c.is_nan()))
            .count()
    }

    /// All camera samples of the picture.
    pub fn samples(&self) -> u64 {
        let pixels = self.film.pixels().iter();
        pixels.map(|pixel| u64::from(pixel.samples)).sum()
    }

    /// Takes in another picture of the same job, made with other samples: every sample counts the same.
    pub fn add(&mut self, other: &Rendered) {
        let size = self.film.size();
        for (x, y) in size.whole().pixels() {
            let (a, b) = (self.film.get(x, y), other.film.get(x, y));
            let samples = a.samples + b.samples;
            if samples > 0 {
                let sum = a.radiance * f64::from(a.samples) + b.radiance * f64::from(b.samples);
                let radiance = sum / f64::from(samples);
                self.film.set(x, y, PixelEstimate { radiance, samples });
            }
        }
        for (mine, theirs) in self.luminance.iter_mut().zip(&other.luminance) {
            mine.merge(theirs);
        }
        self.counters = self.counters + other.counters;
        self.effects = self.effects + other.effects;
    }

    /// How noisy the picture is: the standard error of a pixel's luminance (root mean square over the pixels that have at
    /// least two samples: one knows no spread) as a share of the mean luminance. `None` without such a pixel, 0 for a
    /// black picture. For Sobol samples it is an upper bound.
    pub fn relative_error(&self) -> Option<f64> {
        let mut mean = Tally::default();
        let mut squared = Tally::default();
        for pixel in self.luminance.iter().filter(|tally| tally.count() > 1) {
            mean.push(pixel.mean());
            squared.push(pixel.standard_error().powi(2));
        }
        (mean.count() > 0).then(|| {
            if mean.mean() > 0.0 {
                squared.mean().sqrt() / mean.mean()
            } else {
                0.0
            }
        })
    }
}
