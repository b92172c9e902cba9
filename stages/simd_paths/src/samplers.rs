//! The random numbers of eight paths.
//!
//! They are drawn in many places and take many instructions: they are compiled once for each
//! instruction set, not once for each place.

use crate::vec3x8::LANES;
use fearless_simd::{Simd, f64x8, prelude::*};
use kit::sampler::PixelSamplers;

/// The next number of each path.
#[inline(never)]
pub(crate) fn next_1d<S: Simd>(simd: S, samplers: &mut PixelSamplers<LANES>) -> f64x8<S> {
    simd.vectorize(
        #[inline(always)]
        || f64x8::load_array(simd, samplers.next_1d()),
    )
}

/// The next point of each path.
#[inline(never)]
pub(crate) fn next_2d<S: Simd>(simd: S, samplers: &mut PixelSamplers<LANES>) -> [f64x8<S>; 2] {
    simd.vectorize(
        #[inline(always)]
        || {
            let [x, y] = samplers.next_2d();
            [f64x8::load_array(simd, x), f64x8::load_array(simd, y)]
        },
    )
}
