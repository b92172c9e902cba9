//! Tone mapping: from radiance to bytes for a display.

use kit::Spectrum;
use kit::math::pow;

/// The colour of NaN, which no picture should have: magenta, because it is rare in pictures.
pub const NAN_COLOR: [u8; 3] = [255, 0, 255];

/// The display's exponent.
const GAMMA: f64 = 2.2;

/// The bytes of a pixel: `255·min(1, (c·√2)^(1/2.2))` for each channel, rounded down; negative
/// values are 0. [`NAN_COLOR`] if a channel is NaN.
///
/// The factor √2 is half a stop of exposure, as in the assignment's program.
pub fn to_bytes(radiance: Spectrum) -> [u8; 3] {
    let channels = radiance.to_array();
    if channels.iter().any(|c| c.is_nan()) {
        return NAN_COLOR;
    }
    channels.map(|c| {
        let encoded = pow(c.max(0.0) * std::f64::consts::SQRT_2, 1.0 / GAMMA);
        (255.0 * encoded.min(1.0)) as u8
    })
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

    #[test]
    fn nan_is_magenta() {
        assert_eq!(to_bytes(Spectrum::new(0.0, f64::NAN, 0.0)), NAN_COLOR);
    }
}
