//! A render job and its result.

use crate::Counters;
use kit::effects::EffectCounts;
use kit::film::Cell;
use kit::sampler::Sampling;
use kit::{Camera, Film, FilmSize, PixelEstimate, Tally};

/// What to render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Job {
    /// The camera.
    pub camera: Camera,
    /// The size of the whole picture.
    pub film: FilmSize,
    /// The part of the picture that is rendered.
    pub cell: Cell,
    /// Camera rays per pixel.
    pub samples: u32,
    /// The source of random numbers.
    pub sampling: Sampling,
}

/// A picture and its statistics.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// The whole film; black outside the cell.
    pub film: Film,
    /// Tallies of the luminances of each pixel's samples, in the order of [`Film::pixels`]; empty
    /// for normals.
    pub luminance: Vec<Tally>,
    /// Rays and tests.
    pub counters: Counters,
    /// Operations of each effect.
    pub effects: EffectCounts,
}

impl Rendered {
    /// The number of pixels with a NaN. There should be none.
    pub fn nan_pixels(&self) -> usize {
        let pixels = self.film.pixels().iter();
        pixels
            .filter(|pixel| pixel.radiance.to_array().iter().any(|c| c.is_nan()))
            .count()
    }

    /// The number of camera samples of the whole picture.
    pub fn samples(&self) -> u64 {
        let pixels = self.film.pixels().iter();
        pixels.map(|pixel| u64::from(pixel.samples)).sum()
    }

    /// Averages with another picture of the same job that was rendered with other samples. Every
    /// sample has the same weight.
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
        for (tally, other) in self.luminance.iter_mut().zip(&other.luminance) {
            tally.merge(other);
        }
        self.counters += other.counters;
        self.effects = self.effects + other.effects;
    }

    /// The noise of the picture: the root mean square of the standard errors of the pixels'
    /// luminances, relative to the mean luminance, over the pixels with at least two samples.
    /// `None` without such a pixel, 0 for a black picture. An upper bound for Sobol samples.
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
