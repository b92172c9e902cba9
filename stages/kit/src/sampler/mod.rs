//! Samplers: random numbers that depend only on where they are used.
//!
//! A number is a hash of (seed, pixel, sample, dimension). There is no state that threads could
//! share, so an image is the same for any number of threads and any order of tiles.

mod pixel_samplers;

pub use pixel_samplers::PixelSamplers;

use crate::Vec2;
use crate::{sobol, stratified};

/// How the samples of a pixel are distributed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pattern {
    /// Independent samples.
    #[default]
    Independent,
    /// One sample in each of `samples` equal cells of the pixel.
    Stratified {
        /// Number of cells: the number of samples per pixel, preferably a square number. Further
        /// samples start again with the first cell of a new order.
        samples: u32,
    },
    /// Owen-scrambled Sobol points. The samples are well distributed in each pair of dimensions,
    /// which reduces noise. Best with a power of two of samples.
    Sobol,
    /// The same, but two calls of [`PixelSampler::next_2d`] that follow each other share points
    /// that are well distributed in four dimensions: the place in a pixel, and the point on a light
    /// that is sampled there.
    Sobol4,
}

/// Parameters of the samplers of an image.
///
/// ```
/// use kit::sampler::{PixelSampler, Sampling};
/// let mut whole = PixelSampler::new(0, 0, Sampling::from(7));
/// let later = Sampling { first_sample: 1, ..Sampling::from(7) };
/// let mut rest = PixelSampler::new(0, 0, later);
/// whole.get_sample();
/// assert_eq!(whole.get_sample(), rest.get_sample());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sampling {
    /// How the samples of a pixel are distributed.
    pub pattern: Pattern,
    /// Images with different seeds are independent.
    pub seed: u64,
    /// Index of the first sample of each pixel. To continue an image, start with the number of
    /// samples that it already has.
    pub first_sample: u32,
}

impl From<u64> for Sampling {
    /// Independent samples with this seed.
    fn from(seed: u64) -> Sampling {
        Sampling {
            seed,
            ..Sampling::default()
        }
    }
}

/// The random numbers of one pixel, by sample and dimension.
///
/// ```
/// use kit::PixelSampler;
/// let points = |x| {
///     let mut sampler = PixelSampler::new(x, 0, 7);
///     [sampler.get_sample(), sampler.next_2d()]
/// };
/// // The numbers depend on the pixel and the seed alone.
/// assert_eq!(points(3), points(3));
/// assert_ne!(points(3), points(4));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PixelSampler {
    pattern: Pattern,
    key: u64,
    samples_started: u32,
    dimension: u32,
    /// The number of points that [`PixelSampler::next_2d`] has returned of the current sample.
    points: u32,
}

impl PixelSampler {
    /// The sampler of the pixel in column `x` and row `y`. A seed alone means independent samples.
    pub fn new(x: u32, y: u32, sampling: impl Into<Sampling>) -> PixelSampler {
        let Sampling {
            pattern,
            seed,
            first_sample,
        } = sampling.into();
        let pixel = u64::from(y) << 32 | u64::from(x);
        PixelSampler {
            pattern,
            key: mix(pixel ^ mix(seed)),
            samples_started: first_sample,
            dimension: 0,
            points: 0,
        }
    }

    /// Starts the next camera sample of this pixel. Returns its position in the pixel: uniform in
    /// [0, 1)², with (0, 0) at the bottom left of the pixel.
    pub fn get_sample(&mut self) -> Vec2 {
        self.start_sample();
        self.next_2d()
    }

    /// Starts the next camera sample without computing its position. [`PixelSampler::get_sample`]
    /// is this followed by [`PixelSampler::next_2d`].
    #[inline]
    pub fn start_sample(&mut self) {
        self.start_samples(1);
    }

    /// Starts the next `count` camera samples, at least 1, of which the last is the current one.
    #[inline]
    pub fn start_samples(&mut self, count: u32) {
        self.samples_started += count;
        (self.dimension, self.points) = (0, 0);
    }

    /// Number of samples of the pixel that have started, including those before
    /// [`Sampling::first_sample`].
    #[inline]
    pub fn samples_started(&self) -> u32 {
        self.samples_started
    }

    /// Skips the number that [`PixelSampler::next_1d`] would return.
    #[inline]
    pub fn skip_1d(&mut self) {
        self.dimension += 1;
    }

    /// Returns the next number of the current sample: uniform in [0, 1).
    #[inline]
    pub fn next_1d(&mut self) -> f64 {
        match self.pattern {
            Pattern::Independent => self.independent(),
            Pattern::Stratified { samples } => {
                let (index, key) = self.sample_and_key();
                stratified::sample_1d(index, samples.max(1), key, self.independent())
            }
            Pattern::Sobol | Pattern::Sobol4 => self.sobol().x,
        }
    }

    /// Returns the next two numbers of the current sample: uniform in [0, 1)².
    #[inline]
    pub fn next_2d(&mut self) -> Vec2 {
        match self.pattern {
            Pattern::Independent => {
                let x = self.independent();
                Vec2::new(x, self.independent())
            }
            Pattern::Stratified { samples } => {
                let (index, key) = self.sample_and_key();
                let jitter = [self.independent(), self.independent()];
                stratified::sample_2d(index, samples.max(1), key, jitter).into()
            }
            Pattern::Sobol => self.sobol(),
            Pattern::Sobol4 => self.sobol4(),
        }
    }

    #[inline]
    fn independent(&mut self) -> f64 {
        let counter = u64::from(self.samples_started) << 32 | u64::from(self.dimension);
        self.dimension += 1;
        // 53 bits: the result is exact and below 1.
        (mix(self.key ^ mix(counter)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The index of the current sample, from 0, and the key of the current dimension, which all
    /// samples of the pixel share.
    #[inline(always)]
    fn sample_and_key(&self) -> (u32, u64) {
        let key = mix(self.key ^ mix(u64::from(self.dimension)));
        // The counter of the first sample is 1. If no sample has started, the result is still a
        // valid index.
        (self.samples_started.wrapping_sub(1), key)
    }

    /// The next Sobol point of the current sample. Each pair of dimensions has its own sequence.
    #[inline]
    fn sobol(&mut self) -> Vec2 {
        let (index, key) = self.sample_and_key();
        self.dimension += 1;
        sobol::point(index, key, 0).map(sobol::fraction).into()
    }

    /// The index of the current sample, the key of the current pair of points, and which of them is
    /// next.
    #[inline(always)]
    fn sample_and_pair(&self) -> (u32, u64, sobol::Half) {
        // No dimension has this key.
        let key = mix(self.key ^ mix(!u64::from(self.points / 2)));
        let half = 0_u32.wrapping_sub(self.points % 2);
        (self.samples_started.wrapping_sub(1), key, half)
    }

    #[inline]
    fn sobol4(&mut self) -> Vec2 {
        let (index, key, half) = self.sample_and_pair();
        self.points += 1;
        sobol::point(index, key, half).map(sobol::fraction).into()
    }
}

/// A 64-bit hash, the same on every platform: the finalizer of SplitMix64 (Steele, Lea, Flood,
/// "Fast splittable pseudorandom number generators", 2014).
#[inline]
pub fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Tally;

    pub(super) fn all_patterns() -> [Sampling; 4] {
        let stratified = Pattern::Stratified { samples: 256 };
        [
            Pattern::Independent,
            stratified,
            Pattern::Sobol,
            Pattern::Sobol4,
        ]
        .map(|pattern| Sampling {
            pattern,
            seed: 3,
            first_sample: 0,
        })
    }

    #[test]
    fn numbers_are_uniform_and_below_one() {
        for sampling in all_patterns() {
            let mut sampler = PixelSampler::new(4, 2, sampling);
            let mut numbers = Tally::default();
            for _ in 0..4096 {
                let p = sampler.get_sample();
                for x in [p.x, p.y, sampler.next_1d()] {
                    assert!((0.0..1.0).contains(&x));
                    numbers.push(x);
                }
            }
            // The standard error is at most 0.0026.
            assert!((numbers.mean() - 0.5).abs() < 0.013);
            assert!((numbers.variance() - 1.0 / 12.0).abs() < 0.005);
        }
    }

    /// A number does not depend on how many numbers other samples used.
    #[test]
    fn samples_do_not_depend_on_the_dimensions_used_by_others() {
        for sampling in all_patterns() {
            let (mut a, mut b) = (
                PixelSampler::new(1, 2, sampling),
                PixelSampler::new(1, 2, sampling),
            );
            a.get_sample();
            b.get_sample();
            a.next_2d();
            assert_eq!(a.get_sample(), b.get_sample());
            assert_eq!(a.next_1d(), b.next_1d());
        }
    }

    #[test]
    fn first_sample_continues_the_sequence() {
        for sampling in all_patterns() {
            let mut whole = PixelSampler::new(1, 2, sampling);
            let mut rest = PixelSampler::new(
                1,
                2,
                Sampling {
                    first_sample: 5,
                    ..sampling
                },
            );
            for _ in 0..5 {
                whole.get_sample();
            }
            assert_eq!(whole.get_sample(), rest.get_sample());
            assert_eq!(whole.next_2d(), rest.next_2d());
        }
    }

    #[test]
    fn pixels_and_seeds_give_different_samples() {
        for sampling in all_patterns() {
            let first = |x, y, sampling: Sampling| PixelSampler::new(x, y, sampling).get_sample();
            let other = Sampling {
                seed: 4,
                ..sampling
            };
            assert_ne!(first(1, 2, sampling), first(2, 1, sampling));
            assert_ne!(first(1, 2, sampling), first(1, 2, other));
        }
    }

    /// The variance of the means of a function over so many samples of a pixel, of 64 pixels.
    fn variance_of_means(
        sampling: Sampling,
        samples: u32,
        mut value: impl FnMut(&mut PixelSampler) -> f64,
    ) -> f64 {
        let mean = |x| {
            let mut sampler = PixelSampler::new(x, 0, sampling);
            let values = (0..samples).map(|_| value(&mut sampler));
            values.collect::<Tally>().mean()
        };
        (0..64).map(mean).collect::<Tally>().variance()
    }

    /// The mean of a smooth function over 256 samples, in later dimensions. The standard error of
    /// independent samples is 0.018 here. With 16 x 16 cells it is about 1/16 of that.
    #[test]
    fn sobol_and_stratified_samples_reduce_noise() {
        let error = |sampling| {
            let variance = variance_of_means(sampling, 256, |sampler| {
                sampler.get_sample();
                sampler.next_1d();
                let p = sampler.next_2d();
                p.x + p.y * p.y
            });
            variance.sqrt()
        };
        let [independent, stratified, sobol, sobol4] = all_patterns().map(error);
        assert!(
            sobol.max(sobol4) < 0.02 * independent,
            "{sobol} {sobol4} {independent}"
        );
        assert!(
            (0.02..0.1).contains(&(stratified / independent)),
            "{stratified} {independent}"
        );
    }

    /// Products of a place in the pixel and a point on a light, as in a penumbra. Points that are
    /// well distributed in two dimensions only help little there.
    #[test]
    fn two_points_together_are_well_distributed() {
        let variance = |sampling| {
            variance_of_means(sampling, 64, |sampler| {
                let (p, q) = (sampler.get_sample(), sampler.next_2d());
                f64::from(u8::from(p.x + q.x > 1.0) + u8::from(p.y + q.y > 1.0))
            })
        };
        let [_, _, sobol, sobol4] = all_patterns().map(variance);
        assert!(sobol4 < 0.6 * sobol, "{sobol4} {sobol}");
    }

    /// Numbers of different dimensions are not correlated.
    #[test]
    fn dimensions_are_not_correlated() {
        for sampling in all_patterns() {
            let mut sampler = PixelSampler::new(0, 0, sampling);
            let products: Tally = (0..4096)
                .map(|_| {
                    let p = sampler.get_sample();
                    (p.x - 0.5) * (sampler.next_1d() - 0.5)
                })
                .collect();
            assert!(
                products.mean().abs() < 5.0 / 12.0 / 64.0,
                "{}",
                products.mean()
            );
        }
    }
}
