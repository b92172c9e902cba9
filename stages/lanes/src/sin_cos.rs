//! Sine and cosine, in the steps of [`kit::math::sin_cos`] (libm's, from FreeBSD).

use crate::real::{Mask, Real};

/// π/2 rounded to 33 bits, so that small multiples of it are exact, and the remainder.
const HALF_PI: f64 = 1.570_796_326_734_125_6;
const HALF_PI_REMAINDER: f64 = 6.077_100_506_506_192e-11;

/// The upper 32 bits of π/4, 3π/4, 5π/4 and 7π/4: libm compares these bits, so an angle with equal
/// ones is in the lower quadrant.
const QUADRANT_ENDS: [u64; 4] = [0x3fe9_21fb, 0x4002_d97c, 0x400f_6a7a, 0x4015_fdbc];

/// Those of π/2, π, 3π/2 and 2π. So close to them libm uses more digits of π.
const CANCELLING: [u64; 4] = [0x3ff9_21fb, 0x4009_21fb, 0x4012_d97c, 0x4019_21fb];

/// Sine and cosine of `radians` in [0, 2π], and whether they have the bits of
/// [`kit::math::sin_cos`]: not for the few angles so close to a multiple of π/2 that digits cancel.
/// For numbers in `f64`.
#[inline(always)]
pub fn sin_cos<R: Real>(radians: R) -> (R, R, R::Mask) {
    let (zero, one) = (radians.constant(0.0), radians.constant(1.0));
    let (two, three) = (radians.constant(2.0), radians.constant(3.0));
    let half = radians.constant(0.5);
    let [first, second, third, fourth] = QUADRANT_ENDS;
    let quadrant = beyond(radians, first)
        + beyond(radians, second)
        + beyond(radians, third)
        + beyond(radians, fourth);
    let reduced = radians - quadrant * radians.constant(HALF_PI);
    let rest = quadrant * radians.constant(HALF_PI_REMAINDER);
    let x = reduced - rest;
    let y = (reduced - x) - rest;

    let [s1, s2, s3] = constants(radians, [S1, S2, S3]);
    let [s4, s5, s6] = constants(radians, [S4, S5, S6]);
    let z = x * x;
    let w = z * z;
    let r = (z * s4 + s3) * z + s2 + (z * s6 + s5) * (z * w);
    let v = z * x;
    // In the first quadrant nothing is subtracted, and libm uses a shorter formula.
    let unreduced = x + v * (z * r + s1);
    let sin = x - ((z * (y * half - v * r) - y) - v * s1);
    let sin = quadrant.equals(zero).choose(unreduced, sin);
    let [c1, c2, c3] = constants(radians, [C1, C2, C3]);
    let [c4, c5, c6] = constants(radians, [C4, C5, C6]);
    let r = z * ((z * c3 + c2) * z + c1) + (w * w) * ((z * c6 + c5) * z + c4);
    let hz = z * half;
    let w = one - hz;
    let cos = w + (((one - w) - hz) + (z * r - x * y));

    let odd = quadrant.equals(one) | quadrant.equals(three);
    let (s, c) = (odd.choose(cos, sin), odd.choose(sin, cos));
    let s_is_negative = quadrant.equals(two) | quadrant.equals(three);
    let c_is_negative = quadrant.equals(one) | quadrant.equals(two);
    (
        s_is_negative.choose(-s, s),
        c_is_negative.choose(-c, c),
        !cancels(radians),
    )
}

/// 1 for angles whose upper 32 bits are larger than `upper`, 0 for others.
#[inline(always)]
fn beyond<R: Real>(radians: R, upper: u64) -> R {
    let is_beyond = radians.constant(after(upper)).at_most(radians);
    is_beyond.choose(radians.constant(1.0), radians.constant(0.0))
}

/// Whether the angle is close to a multiple of π/2.
#[inline(always)]
fn cancels<R: Real>(radians: R) -> R::Mask {
    let [quarter, half, three_quarters, full] = CANCELLING;
    (is_at(radians, quarter) | is_at(radians, half))
        | (is_at(radians, three_quarters) | is_at(radians, full))
}

/// The constants in as many lanes as `like` has.
#[inline(always)]
fn constants<R: Real>(like: R, [a, b, c]: [f64; 3]) -> [R; 3] {
    [like.constant(a), like.constant(b), like.constant(c)]
}

/// Whether the upper 32 bits of the angle are `upper`.
#[inline(always)]
fn is_at<R: Real>(radians: R, upper: u64) -> R::Mask {
    let first = f64::from_bits(upper << 32);
    radians.constant(first).at_most(radians) & radians.less(radians.constant(after(upper)))
}

/// The smallest number whose upper 32 bits are larger than `upper`.
#[inline(always)]
fn after(upper: u64) -> f64 {
    f64::from_bits((upper + 1) << 32)
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
