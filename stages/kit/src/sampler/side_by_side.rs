//! Many samplers at once.

use super::{Pattern, PixelSampler};
use crate::sobol;

/// Several samplers of one pattern side by side, field by field. Their methods are loops over arrays, of which a compiler
/// makes one instruction for eight numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PixelSamplers<const N: usize> {
    pattern: Pattern,
    keys: [u64; N],
    samples_started: [u32; N],
    dimensions: [u32; N],
}

impl<const N: usize> PixelSamplers<N> {
    /// `samplers` side by side. All have the pattern of the first one.
    #[inline(always)]
    pub fn of(samplers: &[PixelSampler; N]) -> PixelSamplers<N> {
        let mut lanes = PixelSamplers {
            pattern: samplers[0].pattern,
            keys: [0; N],
            samples_started: [0; N],
            dimensions: [0; N],
        };
        for (i, sampler) in samplers.iter().enumerate() {
            lanes.set(i, sampler);
        }
        lanes
    }

    /// Sampler number `i`.
    #[inline(always)]
    pub fn get(&self, i: usize) -> PixelSampler {
        PixelSampler {
            pattern: self.pattern,
            key: self.keys[i],
            samples_started: self.samples_started[i],
            dimension: self.dimensions[i],
        }
    }

    /// Makes `sampler` number `i`.
    #[inline(always)]
    pub fn set(&mut self, i: usize, sampler: &PixelSampler) {
        debug_assert_eq!(sampler.pattern, self.pattern);
        self.keys[i] = sampler.key;
        self.samples_started[i] = sampler.samples_started;
        self.dimensions[i] = sampler.dimension;
    }

    /// Leaves out what [`PixelSamplers::next_1d`] would give.
    #[inline(always)]
    pub fn skip_1d(&mut self) {
        for dimension in &mut self.dimensions {
            *dimension += 1;
        }
    }

    /// Each sampler's [`PixelSampler::next_1d`].
    #[inline(always)]
    pub fn next_1d(&mut self) -> [f64; N] {
        if self.pattern == Pattern::Sobol {
            return self.sobol()[0];
        }
        let mut numbers = [0.0; N];
        for (i, number) in numbers.iter_mut().enumerate() {
            let mut sampler = self.get(i);
            *number = sampler.next_1d();
            self.set(i, &sampler);
        }
        numbers
    }

    /// Each sampler's [`PixelSampler::next_2d`]: all first numbers, all second ones.
    #[inline(always)]
    pub fn next_2d(&mut self) -> [[f64; N]; 2] {
        if self.pattern == Pattern::Sobol {
            return self.sobol();
        }
        let [mut first, mut second] = [[0.0; N]; 2];
        for (i, (x, y)) in first.iter_mut().zip(&mut second).enumerate() {
            let mut sampler = self.get(i);
            [*x, *y] = sampler.next_2d().to_array();
            self.set(i, &sampler);
        }
        [first, second]
    }

    #[inline(always)]
    fn sobol(&mut self) -> [[f64; N]; 2] {
        let (mut indices, mut keys) = ([0; N], [0; N]);
        for i in 0..N {
            (indices[i], keys[i]) = self.get(i).sample_and_key();
        }
        self.skip_1d();
        let points = sobol::points(&indices, &keys);
        let mut numbers = [[0.0; N]; 2];
        for (numbers, points) in numbers.iter_mut().zip(&points) {
            for (number, point) in numbers.iter_mut().zip(points) {
                *number = f64::from(*point) / (1_u64 << 32) as f64;
            }
        }
        numbers
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::all;
    use super::*;
    use crate::Vec2;

    #[test]
    fn samplers_side_by_side_give_what_each_gives() {
        for sampling in all() {
            let mut apart: [PixelSampler; 4] = std::array::from_fn(|i| {
                let mut sampler = PixelSampler::new(i as u32 / 2, 5, sampling);
                for _ in 0..=i {
                    sampler.start_sample();
                }
                sampler
            });
            let mut together = PixelSamplers::of(&apart);
            apart[3].skip_1d();
            together.set(3, &apart[3]);
            for _ in 0..50 {
                let points = together.next_2d();
                let numbers = together.next_1d();
                together.skip_1d();
                for (i, sampler) in apart.iter_mut().enumerate() {
                    assert_eq!(Vec2::new(points[0][i], points[1][i]), sampler.next_2d());
                    assert_eq!(numbers[i], sampler.next_1d());
                    sampler.skip_1d();
                    assert_eq!(together.get(i), *sampler);
                }
            }
        }
    }
}
