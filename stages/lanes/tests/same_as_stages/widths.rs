//! Computes a formula with one number and with eight.

use fearless_simd::{Simd, f32x8, f64x8, prelude::*};
use lanes::{Mask, Real, dispatch, instruction_sets};

/// A formula with `I` numbers as input and `O` as result.
pub(crate) trait Formula<const I: usize, const O: usize> {
    fn compute<R: Real>(&self, input: [R; I]) -> [R; O];
}

/// Whether two numbers are the same: all NaN are, zeros of different sign are not.
pub(crate) fn same(a: f64, b: f64) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// The results of the formula for `inputs`, computed with one `f64`. Fails if eight at a time give
/// others, in double or in single precision.
pub(crate) fn at_every_width<F, const I: usize, const O: usize>(
    formula: &F,
    inputs: &[[f64; I]],
) -> Vec<[f64; O]>
where
    F: Formula<I, O>,
{
    for level in instruction_sets() {
        for eight in inputs.chunks(8) {
            dispatch!(level, simd => compare(simd, formula, eight));
        }
    }
    inputs.iter().map(|&input| formula.compute(input)).collect()
}

#[inline(always)]
fn compare<S: Simd, F: Formula<I, O>, const I: usize, const O: usize>(
    simd: S,
    formula: &F,
    inputs: &[[f64; I]],
) {
    let of = |lane: usize| &inputs[lane.min(inputs.len() - 1)];
    let double: [f64x8<S>; O] = formula.compute(std::array::from_fn(|i| {
        f64x8::from_fn(simd, |lane| of(lane)[i])
    }));
    let single: [f32x8<S>; O] = formula.compute(std::array::from_fn(|i| {
        f32x8::from_fn(simd, |lane| of(lane)[i] as f32)
    }));
    for (lane, input) in inputs.iter().enumerate() {
        let one = formula.compute(*input);
        let one_single = formula.compute(input.map(|x| x as f32));
        for i in 0..O {
            assert!(
                same(double[i][lane], one[i]),
                "result {i} is {:?} in eight lanes of {simd:?}, {:?} alone, for {input:?}",
                double[i][lane],
                one[i]
            );
            assert!(
                same(f64::from(single[i][lane]), f64::from(one_single[i])),
                "result {i} in single precision is {:?} in eight lanes of {simd:?}, {:?} alone, for {input:?}",
                single[i][lane],
                one_single[i]
            );
        }
    }
}

/// 1 in the lanes of `mask`, 0 elsewhere.
#[inline(always)]
pub(crate) fn as_number<R: Real>(mask: R::Mask, like: R) -> R {
    mask.choose(like.constant(1.0), like.constant(0.0))
}
