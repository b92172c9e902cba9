//! Random inputs for the kernels, ordinary and hard ones.

use kit::{PixelSampler, Vec3};

/// A stream of numbers, the same in each run.
pub(super) struct Inputs {
    sampler: PixelSampler,
}

impl Inputs {
    pub(super) fn new(seed: u64) -> Inputs {
        Inputs {
            sampler: PixelSampler::new(0, 0, seed),
        }
    }

    /// Uniform in [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        self.sampler.start_sample();
        self.sampler.next_1d()
    }

    pub(super) fn below(&mut self, n: u32) -> u32 {
        (self.unit() * f64::from(n)) as u32
    }

    pub(super) fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    /// Between -4 and 4 in steps of a half, as the figures' points are: edges and ties are frequent.
    pub(super) fn small(&mut self) -> f64 {
        let sign = if self.unit() < 0.5 { -1.0 } else { 1.0 };
        // Also -0.
        sign * f64::from(self.below(9)) * 0.5
    }

    /// Of any magnitude between 2^-range and 2^range.
    pub(super) fn wild(&mut self, range: f64) -> f64 {
        let exponent = self.between(-range, range).floor();
        self.between(-2.0, 2.0) * exponent.exp2()
    }

    /// A coordinate: small, ordinary, or wild within 2^-60 to 2^60.
    fn coordinate(&mut self, kind: u32) -> f64 {
        match kind {
            0 => self.small(),
            1 | 2 => self.between(-4.0, 4.0),
            _ => self.wild(60.0),
        }
    }

    /// A number of [`Inputs::vec3`]'s kinds.
    pub(super) fn kind(&mut self) -> u32 {
        self.below(4)
    }

    pub(super) fn vec3(&mut self, kind: u32) -> Vec3 {
        Vec3::new(
            self.coordinate(kind),
            self.coordinate(kind),
            self.coordinate(kind),
        )
    }
}
