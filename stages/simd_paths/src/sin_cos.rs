//! Sine and cosine of eight angles.

use crate::lane_mask::lanes;
use fearless_simd::{Simd, f64x8, prelude::*};
use kit::math;

/// The bits of [`math::sin_cos`] for `radians` in [0, 2π].
#[inline(always)]
pub(crate) fn sin_cos<S: Simd>(radians: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
    let (mut sin, mut cos, is_exact) = lanes::sin_cos::sin_cos(radians);
    for lane in lanes((!is_exact).to_bitmask()) {
        (sin[lane], cos[lane]) = math::sin_cos(radians[lane]);
    }
    (sin, cos)
}
