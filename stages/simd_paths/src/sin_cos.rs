// BEGIN SOLUTION(part6.task2)
//! Sine and cosine of eight angles.

use crate::lanes::lanes;
use fearless_simd::{Simd, f64x8, i64x8, mask64x8, prelude::*};
use kit::math;

/// π/2 rounded to 33 bits, so that small multiples of it are exact, and the remainder.
const HALF_PI: f64 = 1.570_796_326_734_125_6;
const HALF_PI_REMAINDER: f64 = 6.077_100_506_506_192e-11;

/// Sine and cosine of `radians` in [0, 2π]. Repeats the arithmetic of [`math::sin_cos`] (libm's,
/// from FreeBSD) operation by operation, and calls it for the few angles so close to a multiple of
/// π/2 that digits cancel.
#[inline(always)]
pub(crate) fn sin_cos<S: Simd>(simd: S, radians: f64x8<S>) -> (f64x8<S>, f64x8<S>) {
    let splat = |x| f64x8::splat(simd, x);
    // libm compares the upper 32 bits: an angle with equal upper bits is in the lower quadrant.
    let beyond = |high: u64| radians.simd_ge(splat(f64::from_bits((high + 1) << 32)));
    let one = splat(1.0);
    let zero = splat(0.0);
    let step = |high| beyond(high).select(one, zero);
    let quadrant = step(0x3fe9_21fb) + step(0x4002_d97c) + step(0x400f_6a7a) + step(0x4015_fdbc);
    let reduced = radians - quadrant * HALF_PI;
    let rest = quadrant * HALF_PI_REMAINDER;
    let x = reduced - rest;
    let y = (reduced - x) - rest;

    let z = x * x;
    let w = z * z;
    let r = (z * S4 + S3) * z + S2 + (z * S6 + S5) * (z * w);
    let v = z * x;
    // In the first quadrant nothing is subtracted, and libm uses a shorter formula.
    let unreduced = x + v * (z * r + S1);
    let sin = x - ((z * (y * 0.5 - v * r) - y) - v * S1);
    let sin = quadrant.simd_eq(zero).select(unreduced, sin);
    let r = z * ((z * C3 + C2) * z + C1) + (w * w) * ((z * C6 + C5) * z + C4);
    let hz = z * 0.5;
    let w = one - hz;
    let cos = w + (((one - w) - hz) + (z * r - x * y));

    let odd = quadrant.simd_eq(one) | quadrant.simd_eq(splat(3.0));
    let (s, c) = (odd.select(cos, sin), odd.select(sin, cos));
    let s_is_negative = quadrant.simd_eq(splat(2.0)) | quadrant.simd_eq(splat(3.0));
    let c_is_negative = quadrant.simd_eq(one) | quadrant.simd_eq(splat(2.0));
    let (mut s, mut c) = (s_is_negative.select(-s, s), c_is_negative.select(-c, c));

    for lane in lanes(near_multiples(simd, radians).to_bitmask()) {
        (s[lane], c[lane]) = math::sin_cos(radians[lane]);
    }
    (s, c)
}

/// The angles for which libm uses more digits of π.
#[inline(always)]
fn near_multiples<S: Simd>(simd: S, radians: f64x8<S>) -> mask64x8<S> {
    let bits = radians.bitcast::<i64x8<S>>() >> 32;
    let low = bits & i64x8::splat(simd, 0x000f_ffff);
    let is = |high: i64| bits.simd_eq(i64x8::splat(simd, high));
    let above = radians.simd_ge(f64x8::splat(simd, f64::from_bits(0x3fe9_21fc << 32)));
    (above & low.simd_eq(i64x8::splat(simd, 0x0009_21fb))) | is(0x4012_d97c) | is(0x4019_21fb)
}

// The coefficients of FreeBSD's msun: Copyright (C) 1993 by Sun Microsystems, Inc. All rights
// reserved. Developed at SunPro, a Sun Microsystems, Inc. business. Permission to use, copy,
// modify, and distribute this software is freely granted, provided that this notice is preserved.

const S1: f64 = -0.166_666_666_666_666_32;
const S2: f64 = 0.008_333_333_333_322_49;
const S3: f64 = -0.000_198_412_698_298_579_5;
const S4: f64 = 2.755_731_370_707_006_8e-06;
const S5: f64 = -2.505_076_025_340_686_3e-08;
const S6: f64 = 1.589_690_995_211_55e-10;

const C1: f64 = 0.041_666_666_666_666_6;
const C2: f64 = -0.001_388_888_888_887_411;
const C3: f64 = 2.480_158_728_947_673e-05;
const C4: f64 = -2.755_731_435_139_066_3e-07;
const C5: f64 = 2.087_572_321_298_175e-09;
const C6: f64 = -1.135_964_755_778_819_5e-11;

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};
    use std::f64::consts::{FRAC_PI_4, TAU};

    #[inline(always)]
    fn check<S: Simd>(simd: S, radians: [f64; 8]) {
        let (sin, cos) = sin_cos(simd, f64x8::load_array(simd, radians));
        for (lane, radians) in radians.into_iter().enumerate() {
            let result = [sin[lane], cos[lane]].map(f64::to_bits);
            let (sin, cos) = math::sin_cos(radians);
            assert_eq!(result, [sin, cos].map(f64::to_bits), "for {radians:?}");
        }
    }

    #[test]
    fn bits_equal_those_of_libm() {
        // The whole range, the multiples of π/4 from both sides, and close to 0.
        let around = (0..=1 << 20).map(|i| TAU * f64::from(i) / f64::from(1 << 20));
        let eighths = (0..=8).flat_map(|i| {
            let angle = f64::from(i) * FRAC_PI_4;
            (-600_i64..600).filter_map(move |k| {
                let step = f64::from_bits(1 << (k.unsigned_abs() % 60));
                let bits = angle.to_bits() as i64 + k.signum() * step.to_bits() as i64;
                let near = f64::from_bits(bits.max(0) as u64);
                (0.0..=TAU).contains(&near).then_some(near)
            })
        });
        let tiny = (0..1100).map(|k| 0.5_f64.powi(k));
        let all: Vec<f64> = around.chain(eighths).chain(tiny).collect();
        for level in [Level::new(), Level::baseline()] {
            for eight in all.chunks_exact(8) {
                let eight: [f64; 8] = eight.try_into().expect("eight");
                dispatch!(level, simd => check(simd, eight));
            }
        }
    }
}
// END SOLUTION(part6.task2)
