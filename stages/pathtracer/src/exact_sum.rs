//! Sums of radiances without rounding, so that the order of the samples does not matter.
//!
//! A sum of `f64` depends on the order of its terms. A picture that is rendered in several passes,
//! or by several machines, adds its samples in another order than one that is rendered at once, so
//! its last bits would differ. Here the sum is an integer, as in Kulisch, "Computer Arithmetic and
//! Validity" (2008), with fewer bits: those that radiance needs.

use crate::rendered::mean;
use kit::{PixelEstimate, Spectrum};

/// The number of bits of a sum behind the binary point.
const FRACTION_BITS: i32 = 100;

/// Terms have to be below `2^MAX_EXPONENT`, so that 2³⁰ of them fit.
const MAX_EXPONENT: i32 = 60;

/// The number of words of a sum.
const WORDS: usize = 3;

/// The exact sum of numbers: an integer of 192 bits in units of 2⁻¹⁰⁰, in two's complement, the
/// lowest word first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExactSum {
    words: [u64; WORDS],
}

impl ExactSum {
    /// Adds `x`. Returns false, and adds nothing, if `x` is NaN or at least 2⁶⁰ in size.
    ///
    /// A number of at least 2⁻⁴⁸ is added as it is. Of a smaller one the bits below 2⁻¹⁰⁰ are cut
    /// off: the same bits in every order.
    #[inline]
    #[must_use]
    pub fn add(&mut self, x: f64) -> bool {
        let bits = x.to_bits();
        let exponent = (bits >> 52 & 0x7ff) as i32;
        if exponent - 1023 >= MAX_EXPONENT {
            return false;
        }
        let fraction = bits & ((1 << 52) - 1);
        // x = ±mantissa·2^(exponent - 1075); subnormal numbers have no leading 1.
        let mantissa = if exponent == 0 {
            fraction
        } else {
            fraction | 1 << 52
        };
        let shift = exponent.max(1) - 1075 + FRACTION_BITS;
        // Most radiances, those from 2⁻⁴⁸ to 2¹⁶: without an index that is known only at run time.
        if (0..64).contains(&shift) {
            let wide = u128::from(mantissa) << shift;
            self.add_words([wide as u64, (wide >> 64) as u64, 0], x.is_sign_negative());
            return true;
        }
        let mut term = [0; WORDS];
        if shift < 0 {
            term[0] = mantissa.checked_shr(shift.unsigned_abs()).unwrap_or(0);
        } else {
            let (word, bit) = (shift as usize / 64, shift as u32 % 64);
            let wide = u128::from(mantissa) << bit;
            term[word] = wide as u64;
            if let Some(next) = term.get_mut(word + 1) {
                *next = (wide >> 64) as u64;
            }
        }
        self.add_words(term, x.is_sign_negative());
        true
    }

    /// Adds all terms of `other`.
    pub fn merge(&mut self, other: &ExactSum) {
        self.add_words(other.words, false);
    }

    /// Adds `term`, or subtracts it.
    #[inline]
    fn add_words(&mut self, term: [u64; WORDS], is_negative: bool) {
        // -term is the complement of its bits, plus 1.
        let mut carry = is_negative;
        for (word, term) in self.words.iter_mut().zip(term) {
            let term = if is_negative { !term } else { term };
            let (sum, over) = word.overflowing_add(term);
            let (sum, over_by_carry) = sum.overflowing_add(u64::from(carry));
            *word = sum;
            carry = over | over_by_carry;
        }
    }

    /// The sum, rounded to the nearest `f64`, ties to even.
    pub fn to_f64(self) -> f64 {
        let is_negative = self.words[WORDS - 1] >> 63 == 1;
        let mut size = ExactSum::default();
        size.add_words(self.words, is_negative);
        let Some(top) = size.words.iter().rposition(|&word| word != 0) else {
            return 0.0;
        };
        // The two highest words that are not zero have at least 65 bits, or are the whole number.
        // The lowest bit of them stands for all words below: it decides ties only.
        let low = top.saturating_sub(1);
        let high = if top > 0 { size.words[top] } else { 0 };
        let mut leading = u128::from(high) << 64 | u128::from(size.words[low]);
        leading |= u128::from(size.words[..low].iter().any(|&word| word != 0));
        let unit = f64::from_bits(((1023 - FRACTION_BITS + 64 * low as i32) as u64) << 52);
        // The cast rounds, the product is exact: `unit` is a power of two.
        let sum = leading as f64 * unit;
        if is_negative { -sum } else { sum }
    }

    /// The 24 bytes of the sum, the lowest first.
    pub fn to_le_bytes(self) -> [u8; 8 * WORDS] {
        let mut bytes = [0; 8 * WORDS];
        for (bytes, word) in bytes.chunks_exact_mut(8).zip(self.words) {
            bytes.copy_from_slice(&word.to_le_bytes());
        }
        bytes
    }

    /// The sum with these bytes.
    pub fn from_le_bytes(bytes: [u8; 8 * WORDS]) -> ExactSum {
        let word = |i: usize| std::array::from_fn(|j| bytes[8 * i + j]);
        ExactSum {
            words: std::array::from_fn(|i| u64::from_le_bytes(word(i))),
        }
    }
}

/// The samples of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PixelSum {
    /// Their exact sum, channel by channel, and their number.
    Exact {
        /// Red, green and blue.
        sums: [ExactSum; 3],
        /// How many there are.
        samples: u32,
    },
    /// Their mean with rounding: a sample was NaN or too large for an exact sum, or the sampling
    /// loop returned something other than the mean.
    Rounded(PixelEstimate),
}

impl Default for PixelSum {
    /// No samples.
    fn default() -> PixelSum {
        PixelSum::black(0)
    }
}

impl PixelSum {
    /// This many black samples.
    pub fn black(samples: u32) -> PixelSum {
        PixelSum::Exact {
            sums: Default::default(),
            samples,
        }
    }

    /// Adds a sample.
    #[inline]
    pub fn push(&mut self, radiance: Spectrum) {
        let PixelSum::Exact { sums, samples } = self else {
            return;
        };
        *samples += 1;
        let added = sums.iter_mut().zip(radiance.to_array());
        if !added.fold(true, |all, (sum, c)| sum.add(c) && all) {
            *self = PixelSum::Rounded(PixelEstimate::default());
        }
    }

    /// The samples whose mean a sampling loop estimated as `estimate`: their exact sum if the
    /// estimate is their mean up to rounding, else the estimate. So an exact sum never hides what
    /// is wrong in a sampling loop.
    pub fn of_loop(self, estimate: PixelEstimate) -> PixelSum {
        let mean = self.mean();
        // Each addition rounds the sum of nonnegative terms by at most half an ulp of the result.
        let tolerance = f64::EPSILON * (f64::from(estimate.samples) + 1.0);
        let is_near = |a: f64, b: f64| (a - b).abs() <= tolerance * b.abs();
        let channels = estimate.radiance.to_array().into_iter();
        let mut channels = channels.zip(mean.radiance.to_array());
        let is_mean = matches!(self, PixelSum::Exact { .. })
            && estimate.samples == mean.samples
            && channels.all(|(a, b)| is_near(a, b));
        if is_mean {
            self
        } else {
            PixelSum::Rounded(estimate)
        }
    }

    /// Adds the samples of `other`.
    pub fn merge(&mut self, other: &PixelSum) {
        match (&mut *self, other) {
            (
                PixelSum::Exact { sums, samples },
                PixelSum::Exact {
                    sums: more,
                    samples: count,
                },
            ) => {
                // A damaged file may say any number.
                *samples = samples.saturating_add(*count);
                sums.iter_mut()
                    .zip(more)
                    .for_each(|(sum, more)| sum.merge(more));
            }
            _ => *self = PixelSum::Rounded(mean(self.mean(), other.mean()).unwrap_or_default()),
        }
    }

    /// The mean of the samples: the exact sum, rounded, divided by their number. Black without
    /// samples.
    pub fn mean(&self) -> PixelEstimate {
        match *self {
            PixelSum::Exact { sums, samples } => {
                let sum = Spectrum::from(sums.map(ExactSum::to_f64));
                PixelEstimate {
                    radiance: sum / f64::from(samples.max(1)),
                    samples,
                }
            }
            PixelSum::Rounded(estimate) => estimate,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of very different sizes.
    fn numbers() -> Vec<f64> {
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            state >> 11
        };
        (0..2000)
            .map(|i| (next() as f64 / 9e15) * 2_f64.powi((next() % 60) as i32 - 40 + i % 3))
            .collect()
    }

    fn sum_of(numbers: impl IntoIterator<Item = f64>) -> ExactSum {
        let mut sum = ExactSum::default();
        for x in numbers {
            assert!(sum.add(x), "{x}");
        }
        sum
    }

    #[test]
    fn one_number_is_its_own_sum() {
        for x in numbers() {
            assert_eq!(sum_of([x]).to_f64(), x);
            assert_eq!(sum_of([-x]).to_f64(), -x);
            assert_eq!(sum_of([x, -x]), ExactSum::default());
        }
        let largest = 2_f64.powi(60).next_down();
        for x in [0.0, 1.0, largest, 2_f64.powi(-100)] {
            assert_eq!(sum_of([x]).to_f64(), x);
        }
        assert_eq!(sum_of([2_f64.powi(-101), f64::MIN_POSITIVE]).to_f64(), 0.0);
    }

    #[test]
    fn order_and_grouping_do_not_matter() {
        let numbers = numbers();
        let whole = sum_of(numbers.iter().copied());
        assert_eq!(sum_of(numbers.iter().rev().copied()), whole);
        for cut in [1, 7, 1024, 1999] {
            let mut left = sum_of(numbers[..cut].iter().copied());
            left.merge(&sum_of(numbers[cut..].iter().copied()));
            assert_eq!(left, whole);
        }
        // The naive sum depends on the order, so the numbers are a test.
        let forward: f64 = numbers.iter().sum();
        let backward: f64 = numbers.iter().rev().sum();
        assert_ne!(forward, backward);
        assert!((whole.to_f64() / forward - 1.0).abs() < 1e-12);
        assert_eq!(ExactSum::from_le_bytes(whole.to_le_bytes()), whole);
    }

    /// Ties go to the even neighbour, unless a bit far below decides.
    #[test]
    fn sums_round_to_nearest() {
        let (one, half_ulp) = (1.0, 2_f64.powi(-53));
        assert_eq!(sum_of([one, half_ulp]).to_f64(), 1.0);
        let above = sum_of([one, half_ulp, 2_f64.powi(-100)]);
        assert_eq!(above.to_f64(), 1.0 + f64::EPSILON);
        let odd = sum_of([one, f64::EPSILON, half_ulp]);
        assert_eq!(odd.to_f64(), 1.0 + 2.0 * f64::EPSILON);
        // The same with the leading bit in the highest word.
        let large = 2_f64.powi(59);
        assert_eq!(sum_of([large, 64.0]).to_f64(), large);
        assert_eq!(sum_of([large, 64.0, 1e-20]).to_f64(), large + 128.0);
        assert_eq!(sum_of([-large, -64.0, -1e-20]).to_f64(), -large - 128.0);
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let mut sum = sum_of([1.0]);
        for x in [f64::NAN, f64::INFINITY, -f64::INFINITY, 2_f64.powi(60)] {
            assert!(!sum.add(x), "{x}");
        }
        assert_eq!(sum.to_f64(), 1.0);
    }

    fn pixel(samples: &[f64]) -> PixelSum {
        let mut pixel = PixelSum::default();
        samples.iter().for_each(|&c| pixel.push(Spectrum::grey(c)));
        pixel
    }

    fn estimate(radiance: f64, samples: u32) -> PixelEstimate {
        PixelEstimate {
            radiance: Spectrum::grey(radiance),
            samples,
        }
    }

    /// A loop that forgets to divide, or that counts wrongly, is visible in its picture.
    #[test]
    fn a_wrong_loop_keeps_its_result() {
        let sum = pixel(&[0.1, 0.2, 0.3]);
        assert_eq!(sum.of_loop(estimate(0.6 / 3.0, 3)), sum);
        for wrong in [estimate(0.6, 3), estimate(0.2, 2), estimate(f64::NAN, 3)] {
            let PixelSum::Rounded(kept) = sum.of_loop(wrong) else {
                panic!("{wrong:?} is not the mean");
            };
            assert_eq!(kept.samples, wrong.samples);
            assert_eq!(kept.radiance.r.to_bits(), wrong.radiance.r.to_bits());
        }
    }

    #[test]
    fn a_sample_that_is_not_finite_is_rounded() {
        let mut bad = pixel(&[1.0, f64::INFINITY, 2.0]).of_loop(estimate(f64::INFINITY, 3));
        assert_eq!(bad.mean(), estimate(f64::INFINITY, 3));
        bad.merge(&pixel(&[1.0]));
        assert_eq!(bad.mean(), estimate(f64::INFINITY, 4));
        let mut none = PixelSum::default();
        none.merge(&bad);
        assert_eq!(none.mean(), bad.mean());
        assert_eq!(PixelSum::default().mean(), PixelEstimate::default());
    }
}
