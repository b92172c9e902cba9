//! Random numbers that depend on nothing but where they are used.
//!
//! A number is a function of (seed, pixel, sample, dimension): a counter goes through a hash, there is no
//! hidden state that threads could share. So a picture is the same for any number of threads and any order
//! of tiles.

use crate::Vec2;

/// The random numbers of one pixel, sample after sample, dimension after dimension.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PixelSampler {
    key: u64,
    samples_started: u32,
    dimension: u32,
}

impl PixelSampler {
    /// The sampler of the pixel in column `x` and row `y`. Different seeds give independent pictures.
    pub fn new(x: u32, y: u32, seed: u64) -> PixelSampler {
        let pixel = u64::from(y) << 32 | u64::from(x);
        PixelSampler {
            key: mix(pixel ^ mix(seed)),
            samples_started: 0,
            dimension: 0,
        }
    }

    /// Starts the next camera sample of this pixel and gives its place inside the pixel: uniform in
    /// [0, 1)², with (0, 0) at the pixel's bottom left.
    pub fn get_sample(&mut self) -> Vec2 {
        self.samples_started += 1;
        self.dimension = 0;
        self.next_2d()
    }

    /// The next number of the current sample: uniform in [0, 1).
    #[inline]
    pub fn next_1d(&mut self) -> f64 {
        let counter = u64::from(self.samples_started) << 32 | u64::from(self.dimension);
        self.dimension += 1;
        // 53 bits: every result is a float below 1, exactly.
        (mix(self.key ^ mix(counter)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The next two numbers of the current sample: uniform in [0, 1)².
    #[inline]
    pub fn next_2d(&mut self) -> Vec2 {
        let x = self.next_1d();
        Vec2::new(x, self.next_1d())
    }
}

/// The finaliser of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
#[inline]
fn mix(x: u64) -> u64 {
    let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
