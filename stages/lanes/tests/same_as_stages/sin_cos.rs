//! `lanes::sin_cos` and `kit::math::sin_cos`.

use crate::widths::{Formula, as_number, at_every_width, same};
use kit::math;
use lanes::Real;
use std::f64::consts::{FRAC_PI_4, TAU};

/// Sine and cosine, and whether they are those of libm.
struct SinCos;

impl Formula<1, 3> for SinCos {
    #[inline(always)]
    fn compute<R: Real>(&self, [radians]: [R; 1]) -> [R; 3] {
        let (sin, cos, is_exact) = lanes::sin_cos::sin_cos(radians);
        [sin, cos, as_number(is_exact, sin)]
    }
}

#[test]
fn bits_are_those_of_libm() {
    // The whole range, the multiples of π/4 from both sides, and close to 0.
    let around = (0..=1 << 19).map(|i| TAU * f64::from(i) / f64::from(1 << 19));
    let eighths = (0..=8).flat_map(|i| {
        let angle = f64::from(i) * FRAC_PI_4;
        (-600_i64..600).filter_map(move |k| {
            let step = 1_i64 << (k.unsigned_abs() % 53);
            let bits = angle.to_bits() as i64 + k.signum() * step;
            let near = f64::from_bits(bits.max(0) as u64);
            (0.0..=TAU).contains(&near).then_some(near)
        })
    });
    let tiny = (0..1100).map(|k| 0.5_f64.powi(k));
    let inputs: Vec<[f64; 1]> = around.chain(eighths).chain(tiny).map(|x| [x]).collect();
    let mut inexact = 0;
    for (&[radians], [sin, cos, is_exact]) in inputs.iter().zip(at_every_width(&SinCos, &inputs)) {
        if is_exact == 0.0 {
            inexact += 1;
            continue;
        }
        let expected = math::sin_cos(radians);
        let is_same = same(sin, expected.0) && same(cos, expected.1);
        assert!(
            is_same,
            "{sin} {cos}, expected {expected:?} for {radians:?}"
        );
    }
    assert!(inexact < inputs.len() / 100, "{inexact} are not exact");
}
