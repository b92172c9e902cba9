//! The image of the sampling rate.

use kit::Spectrum;

/// The colour of a pixel with `samples` of at most `ns_aa` samples: blue for 0, green for half, red
/// for all of them, interpolated linearly. The values are written as bytes (times 255) without a
/// tone curve.
///
/// This function is given. The original program colours `NAME_rate.png` in the same way.
pub fn rate_colour(samples: u32, ns_aa: u32) -> Spectrum {
    let rate = (f64::from(samples) / f64::from(ns_aa.max(1))).min(1.0);
    let (blue, green, red) = (
        Spectrum::new(0.0, 0.0, 1.0),
        Spectrum::new(0.0, 1.0, 0.0),
        Spectrum::new(1.0, 0.0, 0.0),
    );
    let blend = |a: Spectrum, b: Spectrum, share: f64| a * (1.0 - share) + b * share;
    if rate <= 0.5 {
        blend(blue, green, 2.0 * rate)
    } else {
        blend(green, red, 2.0 * rate - 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_goes_from_blue_over_green_to_red() {
        assert_eq!(rate_colour(0, 64), Spectrum::new(0.0, 0.0, 1.0));
        assert_eq!(rate_colour(16, 64), Spectrum::new(0.0, 0.5, 0.5));
        assert_eq!(rate_colour(32, 64), Spectrum::new(0.0, 1.0, 0.0));
        assert_eq!(rate_colour(64, 64), Spectrum::new(1.0, 0.0, 0.0));
        assert_eq!(rate_colour(0, 0), Spectrum::new(0.0, 0.0, 1.0));
    }
}
