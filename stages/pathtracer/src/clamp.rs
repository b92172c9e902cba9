//! Clamping indirect light (`--clamp`), and what it removes.
//!
//! A firefly is a path that has found a strong light in a direction that is seldom sampled, such as
//! a lamp through glass. Its radiance is right, divided by a small probability: without it the
//! picture is darker. So clamping has a bias, which is measured here.

use crate::exact_sum::PixelSum;
use kit::Spectrum;
use std::cell::Cell;

/// `radiance` of a sample, with indirect light of at most the luminance `limit` in the same colour.
///
/// `direct` is the part that its first surface that is neither a mirror nor smooth glass has from
/// the lights; `None` if there is no such surface, and all light is direct. What is removed is
/// added to `removed`. Radiance that is not finite stays: it is a fault to be seen.
#[inline]
pub(crate) fn clamp_indirect(
    limit: f64,
    radiance: Spectrum,
    direct: Option<Spectrum>,
    removed: &Cell<PixelSum>,
) -> Spectrum {
    let indirect = radiance - direct.unwrap_or(radiance);
    let luminance = indirect.luminance();
    let excess = match luminance > limit && indirect.is_finite() {
        true => indirect * (1.0 - limit / luminance),
        false => Spectrum::BLACK,
    };
    let mut sum = removed.get();
    sum.push(excess);
    removed.set(sum);
    radiance - excess
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clamp(limit: f64, radiance: f64, direct: Option<f64>) -> [f64; 2] {
        let (red, removed) = (Spectrum::new(1.0, 0.0, 0.0), Cell::default());
        let direct = direct.map(|direct| red * direct);
        let kept = clamp_indirect(limit * red.luminance(), red * radiance, direct, &removed);
        assert_eq!((kept.g, kept.b), (0.0, 0.0), "the colour changes");
        [kept.r, removed.get().mean().radiance.r]
    }

    #[test]
    fn only_indirect_light_above_the_limit_is_removed() {
        assert_eq!(clamp(2.0, 9.0, Some(5.0)), [7.0, 2.0]);
        assert_eq!(clamp(4.0, 9.0, Some(5.0)), [9.0, 0.0]);
        assert_eq!(clamp(2.0, 9.0, Some(9.0)), [9.0, 0.0]);
        assert_eq!(clamp(2.0, 9.0, None), [9.0, 0.0]);
    }

    #[test]
    fn radiance_that_is_not_finite_stays() {
        for radiance in [f64::INFINITY, f64::NAN] {
            let radiance = Spectrum::new(radiance, 1.0, 0.0);
            let (direct, removed) = (Some(Spectrum::BLACK), Cell::default());
            let kept = clamp_indirect(0.1, radiance, direct, &removed);
            let bits = |spectrum: Spectrum| spectrum.to_array().map(f64::to_bits);
            assert_eq!(bits(kept), bits(radiance));
        }
    }
}
