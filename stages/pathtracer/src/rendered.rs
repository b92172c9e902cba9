//! A render job and its result.

use crate::Counters;
use crate::exact_sum::PixelSum;
use kit::effects::EffectCounts;
use kit::film::Cell;
use kit::sampler::{Pattern, Sampling};
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

/// A part of a picture and its statistics.
#[derive(Clone, Debug)]
pub struct RenderedTile {
    /// The pixels of the tile in the film.
    pub cell: Cell,
    /// The estimates, in the order of [`Cell::pixels`].
    pub pixels: Vec<PixelEstimate>,
    /// Tallies of the luminances of each pixel's samples, in the same order; empty for normals.
    pub luminance: Vec<Tally>,
    /// The sums of each pixel's samples, in the same order.
    pub sums: Vec<PixelSum>,
    /// The sums of what clamping has removed from them; empty without clamping.
    pub removed: Vec<PixelSum>,
    /// Rays and tests.
    pub counters: Counters,
    /// Operations of each effect.
    pub effects: EffectCounts,
}

/// A picture and its statistics.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// The whole film; black outside the cell.
    pub film: Film,
    /// Tallies of the luminances of each pixel's samples, in the order of [`Film::pixels`]; empty
    /// for normals.
    pub luminance: Vec<Tally>,
    /// The exact sums of each pixel's samples, in the order of [`Film::pixels`]; empty if passes
    /// are averaged instead, with rounding.
    pub sums: Vec<PixelSum>,
    /// The exact sums of what clamping has removed from each pixel's samples; empty without
    /// clamping.
    pub removed: Vec<PixelSum>,
    /// Rays and tests.
    pub counters: Counters,
    /// Operations of each effect.
    pub effects: EffectCounts,
}

impl Rendered {
    /// A black picture without samples. `is_lit` says whether pixels have tallies of luminances.
    pub fn black(size: FilmSize, is_lit: bool) -> Rendered {
        let film = Film::new(size);
        let tallies = if is_lit { film.pixels().len() } else { 0 };
        Rendered {
            film,
            luminance: vec![Tally::default(); tallies],
            sums: Vec::new(),
            removed: Vec::new(),
            counters: Counters::default(),
            effects: EffectCounts::default(),
        }
    }

    /// Like [`Rendered::black`], but the pixels do not depend on how their samples are divided into
    /// passes, not even in their last bits: exact sums are kept.
    pub fn exact(size: FilmSize, is_lit: bool) -> Rendered {
        let mut rendered = Rendered::black(size, is_lit);
        rendered.sums = vec![PixelSum::default(); rendered.film.pixels().len()];
        rendered
    }

    /// Averages the pixels of a tile with those of the picture, each sample with the same weight. A
    /// pixel without samples is replaced.
    ///
    /// If exact sums are kept, the film stays as it is until [`Rendered::update_film`].
    pub fn add_tile(&mut self, tile: &RenderedTile) {
        let width = self.film.size().w as usize;
        if !tile.removed.is_empty() {
            let pixels = self.film.pixels().len();
            self.removed.resize(pixels, PixelSum::default());
        }
        for (i, (x, y)) in tile.cell.pixels().enumerate() {
            let pixel = y as usize * width + x as usize;
            if let Some(sum) = self.sums.get_mut(pixel) {
                sum.merge(&tile.sums[i]);
            } else if let Some(mean) = mean(self.film.get(x, y), tile.pixels[i]) {
                self.film.set(x, y, mean);
            }
            if let Some(tally) = tile.luminance.get(i) {
                self.luminance[pixel].merge(tally);
            }
            if let Some(removed) = tile.removed.get(i) {
                self.removed[pixel].merge(removed);
            }
        }
        self.counters += tile.counters;
        self.effects = self.effects + tile.effects;
    }

    /// Sets the film to the means of the exact sums, if they are kept. One by one for each tile this
    /// would wait for memory.
    pub fn update_film(&mut self) {
        for ((x, y), sum) in self.film.size().whole().pixels().zip(&self.sums) {
            self.film.set(x, y, sum.mean());
        }
    }

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

    /// Copies the pixels that `other`, a picture of the same size, has and this one has not.
    pub fn fill_from(&mut self, other: &Rendered) {
        for (i, (x, y)) in self.film.size().whole().pixels().enumerate() {
            if self.film.get(x, y).samples == 0 {
                self.film.set(x, y, other.film.get(x, y));
                copy(&mut self.luminance, &other.luminance, i);
                copy(&mut self.sums, &other.sums, i);
                copy(&mut self.removed, &other.removed, i);
            }
        }
        self.counters += other.counters;
        self.effects = self.effects + other.effects;
    }

    /// The number of pixels with samples.
    pub fn rendered_pixels(&self) -> u64 {
        let pixels = self.film.pixels().iter();
        pixels.filter(|pixel| pixel.samples > 0).count() as u64
    }

    /// The mean luminance that clamping has removed from the rendered pixels; `None` without
    /// clamping. With [`Rendered::mean_luminance`] it is the mean of the same samples without
    /// clamping.
    pub fn removed_luminance(&self) -> Option<f64> {
        let pixels = self.film.pixels().iter().zip(&self.removed);
        let rendered = pixels.filter(|(pixel, _)| pixel.samples > 0);
        let removed: Tally = rendered
            .map(|(_, removed)| removed.mean().radiance.luminance())
            .collect();
        (removed.count() > 0).then(|| removed.mean())
    }

    /// The mean luminance of the rendered pixels; 0 without any.
    pub fn mean_luminance(&self) -> f64 {
        let pixels = self.film.pixels().iter();
        let rendered = pixels.filter(|pixel| pixel.samples > 0);
        let luminances: Tally = rendered.map(|pixel| pixel.radiance.luminance()).collect();
        luminances.mean()
    }

    /// The noise of the picture: the root mean square of the standard errors of the pixels'
    /// luminances, relative to the mean luminance, over the pixels with at least two samples.
    /// `None` without such a pixel, 0 for a black picture. An upper bound unless the samples are
    /// independent.
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

    /// [`Rendered::relative_error`] of samples with this `pattern`, in words and in percent.
    pub fn noise(&self, pattern: Pattern) -> Option<String> {
        // The samples of other patterns are spread more evenly than their variance tells.
        let bound = match pattern {
            Pattern::Independent => "",
            _ => "at most ",
        };
        let error = self.relative_error()?;
        Some(format!("{bound}{:.2} %", 100.0 * error))
    }
}

/// Copies item `i`, if both lists have it.
fn copy<T: Copy>(to: &mut [T], from: &[T], i: usize) {
    if let (Some(to), Some(from)) = (to.get_mut(i), from.get(i)) {
        *to = *from;
    }
}

/// The mean of two estimates, each sample with the same weight; `None` without samples. An estimate
/// without samples leaves the other one as it is, bit for bit.
pub(crate) fn mean(a: PixelEstimate, b: PixelEstimate) -> Option<PixelEstimate> {
    match (a.samples, b.samples) {
        (0, 0) => None,
        (0, _) => Some(b),
        (_, 0) => Some(a),
        (n, m) => {
            let sum = a.radiance * f64::from(n) + b.radiance * f64::from(m);
            Some(PixelEstimate {
                radiance: sum / (f64::from(n) + f64::from(m)),
                samples: n.saturating_add(m),
            })
        }
    }
}
