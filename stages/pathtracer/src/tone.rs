//! Tone mapping: from radiance to bytes for a display.

use kit::Spectrum;
use kit::math::{ln, pow};
use std::f64::consts::{LOG2_E, SQRT_2};

/// The colour of NaN, which no picture should have: magenta, because it is rare in pictures.
pub const NAN_COLOR: [u8; 3] = [255, 0, 255];

/// The display's exponent.
const GAMMA: f64 = 2.2;

/// How radiance becomes bytes. The default is the assignment's curve without more exposure.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tone {
    /// Exposure in stops: radiance is multiplied by `2^exposure` first.
    pub exposure: f64,
    /// The curve.
    pub curve: ToneCurve,
}

/// A tone curve: which radiance is shown as which brightness.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneCurve {
    /// The assignment's: a power of the radiance, cut off at white.
    #[default]
    Assignment,
    /// Contrast of film: bright parts approach white without reaching it. The fit by Narkowicz,
    /// "ACES filmic tone mapping curve" (2015), to each channel.
    Filmic,
    /// AgX (Sobotka, 2022): like film, and bright colours fade to white instead of turning into
    /// yellow, cyan and magenta, which happens if channels are cut off one by one.
    Agx,
}

impl Tone {
    /// The bytes of a pixel. [`NAN_COLOR`] if a channel is NaN; negative values count as 0, and
    /// infinite ones are white in their channel.
    ///
    /// With the assignment's curve `255·min(1, (c·√2)^(1/2.2))` for each channel, rounded down. The
    /// factor √2 is half a stop of exposure, as in the assignment's program. The other curves round
    /// to the nearest byte.
    pub fn to_bytes(&self, radiance: Spectrum) -> [u8; 3] {
        let channels = radiance.to_array();
        if channels.iter().any(|c| c.is_nan()) {
            return NAN_COLOR;
        }
        let gain = pow(2.0, self.exposure);
        // A finite limit: an infinite channel would make NaN of the others in a product with a
        // matrix.
        let exposed = channels.map(|c| (c.max(0.0) * gain).min(f64::from(f32::MAX)));
        let to_nearest = |c: f64| (255.0 * c.clamp(0.0, 1.0)).round() as u8;
        match self.curve {
            ToneCurve::Assignment => exposed.map(|c| {
                let encoded = pow(c * SQRT_2, 1.0 / GAMMA);
                (255.0 * encoded.min(1.0)) as u8
            }),
            ToneCurve::Filmic => exposed.map(|c| to_nearest(pow(filmic(c), 1.0 / GAMMA))),
            ToneCurve::Agx => agx(exposed).map(to_nearest),
        }
    }
}

/// The bytes of a pixel with the default [`Tone`].
pub fn to_bytes(radiance: Spectrum) -> [u8; 3] {
    Tone::default().to_bytes(radiance)
}

/// Narkowicz's curve: 0 for 0, 0.67 for 1, at most 1. The result is linear: not encoded yet.
fn filmic(c: f64) -> f64 {
    // The author's factor, with which the fit is as bright as the ACES curve.
    let c = 0.6 * c;
    (c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14)).min(1.0)
}

/// The range of AgX in stops: log2 of the radiances that become black and white.
const AGX_STOPS: [f64; 2] = [-12.473_93, 4.026_069];

/// Mixes the channels before the curve of AgX, row by row: each bright channel lifts the others.
const AGX_INSET: [[f64; 3]; 3] = [
    [
        0.842_479_062_253_094,
        0.078_433_599_999_999_2,
        0.079_223_745_147_764_3,
    ],
    [
        0.042_328_242_261_012_3,
        0.878_468_636_469_772,
        0.079_166_127_460_543_4,
    ],
    [0.042_375_654_905_705_1, 0.078_433_6, 0.879_142_973_793_104],
];

/// Separates the channels after the curve: the inverse of [`AGX_INSET`].
const AGX_OUTSET: [[f64; 3]; 3] = [
    [
        1.196_879_005_120_17,
        -0.098_020_881_140_136_8,
        -0.099_029_744_079_720_5,
    ],
    [
        -0.052_896_851_757_456_2,
        1.151_903_129_904_17,
        -0.098_961_176_844_843_3,
    ],
    [
        -0.052_971_635_514_443_8,
        -0.098_043_450_117_124_1,
        1.151_073_672_641_16,
    ],
];

/// Wrensch's fit to the contrast curve of AgX ("Minimal AgX implementation", 2023), by powers of
/// its argument in [0, 1], from the sixth to the constant.
const AGX_CONTRAST: [f64; 7] = [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.002_32];

/// AgX, encoded for a display with the exponent [`GAMMA`].
fn agx(radiance: [f64; 3]) -> [f64; 3] {
    let [black, white] = AGX_STOPS;
    let curved = times(&AGX_INSET, radiance).map(|c| {
        let x = ((LOG2_E * ln(c) - black) / (white - black)).clamp(0.0, 1.0);
        AGX_CONTRAST
            .iter()
            .fold(0.0, |sum, factor| sum * x + factor)
    });
    times(&AGX_OUTSET, curved)
}

fn times(matrix: &[[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_white_and_grey() {
        assert_eq!(to_bytes(Spectrum::BLACK), [0; 3]);
        assert_eq!(to_bytes(Spectrum::WHITE), [255; 3]);
        // Half a stop below 1 is already white.
        assert_eq!(to_bytes(Spectrum::grey(0.7072)), [255; 3]);
        // (0.5 √2)^(1/2.2) = 0.854.
        assert_eq!(to_bytes(Spectrum::grey(0.5)), [217; 3]);
    }

    #[test]
    fn out_of_range_is_clamped() {
        let odd = Spectrum::new(-1.0, f64::INFINITY, f64::NEG_INFINITY);
        assert_eq!(to_bytes(odd), [0, 255, 0]);
    }

    const CURVES: [ToneCurve; 3] = [ToneCurve::Assignment, ToneCurve::Filmic, ToneCurve::Agx];

    fn grey(curve: ToneCurve, exposure: f64, radiance: f64) -> [u8; 3] {
        Tone { exposure, curve }.to_bytes(Spectrum::grey(radiance))
    }

    #[test]
    fn nan_is_magenta() {
        for curve in CURVES {
            let tone = Tone {
                exposure: 1.0,
                curve,
            };
            assert_eq!(tone.to_bytes(Spectrum::new(0.0, f64::NAN, 0.0)), NAN_COLOR);
        }
    }

    #[test]
    fn every_curve_goes_from_black_to_white_and_keeps_grey_grey() {
        for curve in CURVES {
            assert_eq!(grey(curve, 0.0, 0.0), [0; 3], "{curve:?}");
            assert_eq!(grey(curve, 0.0, 1e6), [255; 3], "{curve:?}");
            assert_eq!(grey(curve, 0.0, f64::INFINITY), [255; 3], "{curve:?}");
            let mut last = 0;
            for step in 0..200 {
                let [r, g, b] = grey(curve, 0.0, 1e-4 * 1.1_f64.powi(step));
                // The matrices of AgX are rounded.
                let is_grey = g.abs_diff(r) <= 1 && b.abs_diff(r) <= 1;
                assert!(
                    is_grey && r >= last,
                    "{curve:?} at step {step}: {r} {g} {b}"
                );
                last = r;
            }
        }
    }

    /// A stop more of exposure is twice the radiance.
    #[test]
    fn exposure_is_in_stops() {
        for curve in CURVES {
            assert_eq!(grey(curve, 3.0, 0.02), grey(curve, 0.0, 0.16), "{curve:?}");
            assert_ne!(grey(curve, 0.0, 0.02), grey(curve, 0.0, 0.16), "{curve:?}");
        }
    }

    /// Twice what is white with the assignment's curve is not white yet with the others.
    #[test]
    fn film_keeps_detail_in_bright_parts() {
        assert_eq!(grey(ToneCurve::Assignment, 0.0, 1.4), [255; 3]);
        for curve in [ToneCurve::Filmic, ToneCurve::Agx] {
            assert!((180..253).contains(&grey(curve, 0.0, 1.4)[0]), "{curve:?}");
        }
        // A bright orange: cut off channel by channel it turns yellow, with AgX it fades.
        let orange = Spectrum::new(8.0, 4.0, 0.4);
        assert_eq!(to_bytes(orange)[..2], [255, 255]);
        let [r, g, b] = Tone {
            exposure: 0.0,
            curve: ToneCurve::Agx,
        }
        .to_bytes(orange);
        assert!(r > g && g > b && b > 150, "{r} {g} {b}");
    }

    #[test]
    fn the_matrices_of_agx_are_inverse() {
        for i in 0..3 {
            let unit: [f64; 3] = std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 });
            let back = times(&AGX_OUTSET, times(&AGX_INSET, unit));
            for (back, unit) in back.iter().zip(unit) {
                assert!((back - unit).abs() < 1e-4, "{back} {unit}");
            }
        }
    }
}
