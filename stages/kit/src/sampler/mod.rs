//! Random numbers that depend on nothing but where they are used.
//!
//! A number is a function of (seed, pixel, sample, dimension): a counter goes through a hash, there is no
//! hidden state that threads could share. So a picture is the same for any number of threads and any order
//! of tiles.

mod side_by_side;

pub use side_by_side::PixelSamplers;

use crate::Vec2;
use crate::{sobol, stratified};

/// How the samples of a pixel lie to each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pattern {
    /// None knows of another.
    #[default]
    Independent,
    /// One in each of equal cells of the pixel.
    Stratified {
        /// How many cells: the samples of a pixel, best a square number. Further ones start over.
        samples: u32,
    },
    /// Scrambled Sobol points: in every pair of dimensions the samples of a pixel keep apart, which leaves less noise.
    /// Best with a power of two of them.
    Sobol,
}

/// Where the random numbers of a picture come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sampling {
    /// How the samples of a pixel lie to each other.
    pub pattern: Pattern,
    /// Different seeds give independent pictures.
    pub seed: u64,
    /// The first of the samples of a pixel that are drawn: a picture is continued by starting where it stopped.
    pub first_sample: u32,
}

impl From<u64> for Sampling {
    /// Independent samples.
    fn from(seed: u64) -> Sampling {
        Sampling {
            seed,
            ..Sampling::default()
        }
    }
}

/// The random numbers of one pixel, sample after sample, dimension after dimension.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PixelSampler {
    pattern: Pattern,
    key: u64,
    samples_started: u32,
    dimension: u32,
}

impl PixelSampler {
    /// The sampler of the pixel in column `x` and row `y`. `sampling` may be a seed alone.
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
        }
    }

    /// Starts the next camera sample of this pixel and gives its place inside the pixel: uniform in
    /// [0, 1)², with (0, 0) at the pixel's bottom left.
    pub fn get_sample(&mut self) -> Vec2 {
        self.start_sample();
        self.next_2d()
    }

    /// Starts the next camera sample without drawing its place: [`PixelSampler::get_sample`] is this and a
    /// [`PixelSampler::next_2d`].
    #[inline]
    pub fn start_sample(&mut self) {
        self.samples_started += 1;
        self.dimension = 0;
    }

    /// How many samples of the pixel have started, with those before [`Sampling::first_sample`].
    #[inline]
    pub fn samples_started(&self) -> u32 {
        self.samples_started
    }

    /// Leaves out what [`PixelSampler::next_1d`] would give.
    #[inline]
    pub fn skip_1d(&mut self) {
        self.dimension += 1;
    }

    /// The next number of the current sample: uniform in [0, 1).
    #[inline]
    pub fn next_1d(&mut self) -> f64 {
        match self.pattern {
            Pattern::Independent => self.independent(),
            Pattern::Stratified { samples } => {
                let (index, key) = self.sample_and_key();
                stratified::number(index, samples.max(1), key, self.independent())
            }
            Pattern::Sobol => self.sobol().x,
        }
    }

    /// The next two numbers of the current sample: uniform in [0, 1)².
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
                stratified::point(index, samples.max(1), key, jitter).into()
            }
            Pattern::Sobol => self.sobol(),
        }
    }

    #[inline]
    fn independent(&mut self) -> f64 {
        let counter = u64::from(self.samples_started) << 32 | u64::from(self.dimension);
        self.dimension += 1;
        // 53 bits: every result is a float below 1, exactly.
        (mix(self.key ^ mix(counter)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Which sample this is, counted from 0, and the key of this dimension: the same for all samples of the pixel.
    #[inline(always)]
    fn sample_and_key(&self) -> (u32, u64) {
        let key = mix(self.key ^ mix(u64::from(self.dimension)));
        // The first sample is number 1 here; before it, the numbers of a sample 0 are as good as any.
        (self.samples_started.wrapping_sub(1), key)
    }

    /// A point of this dimension's own sequence; its number is that of the sample.
    #[inline]
    fn sobol(&mut self) -> Vec2 {
        let (index, key) = self.sample_and_key();
        self.dimension += 1;
        let [x, y] = sobol::point(index, key);
        Vec2::new(f64::from(x), f64::from(y)) / (1_u64 << 32) as f64
    }
}

/// A hash of 64 bits to 64 bits, the same on every platform: the finaliser of SplitMix64
/// (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
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

    pub(super) fn all() -> [Sampling; 3] {
        let stratified = Pattern::Stratified { samples: 256 };
        [Pattern::Independent, stratified, Pattern::Sobol].map(|pattern| Sampling {
            pattern,
            seed: 3,
            first_sample: 0,
        })
    }

    #[test]
    fn numbers_are_uniform_and_below_one() {
        for sampling in all() {
            let mut sampler = PixelSampler::new(4, 2, sampling);
            let mut numbers = Tally::default();
            for _ in 0..4096 {
                let p = sampler.get_sample();
                for x in [p.x, p.y, sampler.next_1d()] {
                    assert!((0.0..1.0).contains(&x));
                    numbers.push(x);
                }
            }
            // Standard error 0.0026 at most.
            assert!((numbers.mean() - 0.5).abs() < 0.013);
            assert!((numbers.variance() - 1.0 / 12.0).abs() < 0.005);
        }
    }

    /// A number depends on where it is used, not on what was drawn before in other samples.
    #[test]
    fn samples_do_not_know_how_many_numbers_the_others_took() {
        for sampling in all() {
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
    fn a_picture_goes_on_where_it_stopped() {
        for sampling in all() {
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
    fn pixels_and_seeds_differ() {
        for sampling in all() {
            let first = |x, y, sampling: Sampling| PixelSampler::new(x, y, sampling).get_sample();
            let other = Sampling {
                seed: 4,
                ..sampling
            };
            assert_ne!(first(1, 2, sampling), first(2, 1, sampling));
            assert_ne!(first(1, 2, sampling), first(1, 2, other));
        }
    }

    /// What they are for: the mean of a smooth function over 256 samples, in a later dimension. Independent samples have a
    /// standard error of 0.018 here; in cells 16 a side 1/16 of that is left or less.
    #[test]
    fn sobol_points_and_cells_leave_less_noise() {
        let error = |sampling| {
            let means: Tally = (0..64)
                .map(|x| {
                    let mut sampler = PixelSampler::new(x, 0, sampling);
                    let values = (0..256).map(|_| {
                        sampler.get_sample();
                        sampler.next_1d();
                        let p = sampler.next_2d();
                        p.x + p.y * p.y
                    });
                    values.collect::<Tally>().mean()
                })
                .collect();
            means.variance().sqrt()
        };
        let [independent, stratified, sobol] = all().map(error);
        assert!(sobol < 0.02 * independent, "{sobol} {independent}");
        assert!(
            (0.02..0.1).contains(&(stratified / independent)),
            "{stratified} {independent}"
        );
    }

    /// Two dimensions know nothing of each other.
    #[test]
    fn dimensions_are_not_correlated() {
        for sampling in all() {
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
