//! Several samplers in structure-of-arrays layout.

use super::{Pattern, PixelSampler, mix};
use crate::sobol;

/// Several samplers with the same pattern, stored field by field. Their methods are loops over
/// arrays, which a compiler turns into SIMD instructions.
///
/// ```
/// use kit::sampler::{PixelSampler, PixelSamplers};
/// let [mut left, right] = [0, 1].map(|x| PixelSampler::new(x, 0, 7));
/// let mut both = PixelSamplers::of(&[left.clone(), right]);
/// assert_eq!(both.next_1d()[0], left.next_1d());
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PixelSamplers<const N: usize> {
    pattern: Pattern,
    keys: [u64; N],
    samples_started: [u32; N],
    dimensions: [u32; N],
    points: [u32; N],
}

impl<const N: usize> PixelSamplers<N> {
    /// Combines `samplers`. All must have the pattern of the first one.
    #[inline(always)]
    pub fn of(samplers: &[PixelSampler; N]) -> PixelSamplers<N> {
        let mut lanes = PixelSamplers {
            pattern: samplers[0].pattern,
            keys: [0; N],
            samples_started: [0; N],
            dimensions: [0; N],
            points: [0; N],
        };
        for (i, sampler) in samplers.iter().enumerate() {
            lanes.set(i, sampler);
        }
        lanes
    }

    /// Sampler `i`.
    #[inline(always)]
    pub fn get(&self, i: usize) -> PixelSampler {
        PixelSampler {
            pattern: self.pattern,
            key: self.keys[i],
            samples_started: self.samples_started[i],
            dimension: self.dimensions[i],
            points: self.points[i],
        }
    }

    /// Replaces sampler `i` by `sampler`.
    #[inline(always)]
    pub fn set(&mut self, i: usize, sampler: &PixelSampler) {
        debug_assert_eq!(sampler.pattern, self.pattern);
        self.keys[i] = sampler.key;
        self.samples_started[i] = sampler.samples_started;
        self.dimensions[i] = sampler.dimension;
        self.points[i] = sampler.points;
    }

    /// Samplers at the same place whose numbers are others.
    #[inline(always)]
    #[must_use]
    pub fn branched(&self) -> PixelSamplers<N> {
        PixelSamplers {
            keys: self.keys.map(|key| mix(!key)),
            ..self.clone()
        }
    }

    /// Skips the number that [`PixelSamplers::next_1d`] would return, in each sampler.
    #[inline(always)]
    pub fn skip_1d(&mut self) {
        for dimension in &mut self.dimensions {
            *dimension += 1;
        }
    }

    /// Calls [`PixelSampler::next_1d`] on each sampler.
    #[inline(always)]
    pub fn next_1d(&mut self) -> [f64; N] {
        if matches!(self.pattern, Pattern::Sobol | Pattern::Sobol4) {
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

    /// Calls [`PixelSampler::next_2d`] on each sampler. Returns all first numbers, then all second
    /// ones.
    #[inline(always)]
    pub fn next_2d(&mut self) -> [[f64; N]; 2] {
        match self.pattern {
            Pattern::Sobol => return self.sobol(),
            Pattern::Sobol4 => return self.sobol4(),
            Pattern::Independent | Pattern::Stratified { .. } => {}
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
        fractions(sobol::points(&indices, &keys, &[0; N]))
    }

    #[inline(always)]
    fn sobol4(&mut self) -> [[f64; N]; 2] {
        let (mut indices, mut keys, mut halves) = ([0; N], [0; N], [0; N]);
        for i in 0..N {
            (indices[i], keys[i], halves[i]) = self.get(i).sample_and_pair();
        }
        for points in &mut self.points {
            *points += 1;
        }
        fractions(sobol::points(&indices, &keys, &halves))
    }
}

#[inline(always)]
fn fractions<const N: usize>(points: [[u32; N]; 2]) -> [[f64; N]; 2] {
    points.map(|coordinates| coordinates.map(sobol::fraction))
}

#[cfg(test)]
mod tests {
    use super::super::tests::all_patterns;
    use super::*;
    use crate::Vec2;

    #[test]
    fn combined_samplers_equal_single_samplers() {
        for sampling in all_patterns() {
            let mut single: [PixelSampler; 4] = std::array::from_fn(|i| {
                let mut sampler = PixelSampler::new(i as u32 / 2, 5, sampling);
                for _ in 0..=i {
                    sampler.start_sample();
                }
                sampler
            });
            let mut combined = PixelSamplers::of(&single);
            single[3].skip_1d();
            combined.set(3, &single[3]);
            for _ in 0..50 {
                let points = combined.next_2d();
                let numbers = combined.next_1d();
                combined.skip_1d();
                for (i, sampler) in single.iter_mut().enumerate() {
                    assert_eq!(Vec2::new(points[0][i], points[1][i]), sampler.next_2d());
                    assert_eq!(numbers[i], sampler.next_1d());
                    sampler.skip_1d();
                    assert_eq!(combined.get(i), *sampler);
                }
            }
        }
    }
}
