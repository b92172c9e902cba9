//! Beyond the course: rough mirrors.
//!
//! A rough surface is made of `microfacets`, mirrors too small to see. One that faces the half-way direction of
//! `wo` and `wi` sends one to the other:
//!
//! ```text
//! f = ρ · D(h) · G(wo, wi) / (4 · |cos θo| · |cos θi|)      h = (wo + wi) / |wo + wi|
//! ```
//!
//! Light that is reflected more than once between the mirrors is lost: seen head-on a fortieth with a shininess of 100, a
//! quarter with 10, two thirds with 0. Both sides of the surface are the same. Directions are unit vectors in the local space of the surface, the
//! normal is +z.

use crate::microfacets::{self, SMOOTHEST};
use kit::{BsdfSample, Spectrum, Vec2, Vec3};

/// The roughness α of a surface with the Phong exponent `shininess`: `α² = 2 / (shininess + 2)`, which gives both
/// highlights the same width at their peak (Walter and others 2007, section 5.2, equation for Beckmann's α, to which
/// that of GGX is equal at the peak). 0 is as rough as can be, α = 1.
pub fn roughness_of(shininess: f64) -> f64 {
    (2.0 / (shininess.max(0.0) + 2.0)).sqrt().max(SMOOTHEST)
}

/// Whether both directions are on one side, and the half-way direction on that of +z.
fn half_way(wo: Vec3, wi: Vec3) -> Option<Vec3> {
    if wo.z * wi.z <= 0.0 {
        return None;
    }
    let h = (wo + wi).try_normalize()?;
    Some(if h.z < 0.0 { -h } else { h })
}

/// The BSDF in 1/sr; black if `wo` and `wi` are not on the same side.
pub fn glossy_f(reflectance: Spectrum, shininess: f64, wo: Vec3, wi: Vec3) -> Spectrum {
    let Some(h) = half_way(wo, wi) else {
        return Spectrum::BLACK;
    };
    let a = roughness_of(shininess);
    let seen = 1.0 / (1.0 + microfacets::hidden(wo, a) + microfacets::hidden(wi, a));
    reflectance * (microfacets::facing(h, a) * seen / (4.0 * wo.z * wi.z))
}

/// The density with which [`glossy_sample`] draws `wi`, in 1/sr.
pub fn glossy_pdf(shininess: f64, wo: Vec3, wi: Vec3) -> f64 {
    let a = roughness_of(shininess);
    half_way(wo, wi).map_or(0.0, |h| {
        microfacets::facing(h, a) / ((1.0 + microfacets::hidden(wo, a)) * 4.0 * wo.z.abs())
    })
}

/// Draws a direction on the side of `wo`: a small mirror among those that are seen from `wo`, and what it reflects.
///
/// `u` is uniform in [0, 1)². `None` if `wo` lies in the plane of the surface, or if the mirror sends the light into the
/// surface: that light is lost.
pub fn glossy_sample(
    reflectance: Spectrum,
    shininess: f64,
    wo: Vec3,
    u: Vec2,
) -> Option<BsdfSample> {
    if wo.z == 0.0 {
        return None;
    }
    let a = roughness_of(shininess);
    let up = if wo.z < 0.0 { -wo } else { wo };
    let h = microfacets::visible(up, a, u)?;
    let up_wi = 2.0 * up.dot(h) * h - up;
    if up_wi.z <= 0.0 {
        return None;
    }
    let wi = if wo.z < 0.0 { -up_wi } else { up_wi };
    let pdf = glossy_pdf(shininess, wo, wi);
    (pdf > 0.0).then(|| BsdfSample {
        wi,
        f: glossy_f(reflectance, shininess, wo, wi),
        pdf,
        delta: false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{PixelSampler, Tally};
    use statistics::chi_square;
    use statistics::sidak;
    use std::f64::consts::TAU;

    fn views() -> [Vec3; 4] {
        [
            Vec3::Z,
            Vec3::new(0.48, -0.6, 0.64),
            Vec3::new(-0.98, 0.0, -0.04_f64.sqrt()).normalize(),
            Vec3::new(0.0, 0.999, 0.05).normalize(),
        ]
    }

    /// Hard case 89. All false alarms together have a chance of 1e-6; a deviation of 10 % (root mean square) is sure to be
    /// seen, as that of another shininess is.
    #[test]
    fn samples_fall_where_the_pdf_says() {
        let alarm = sidak(1e-6, 12);
        for shininess in [0.0, 3.0, 20.0] {
            for wo in views() {
                let fit_to = |other: f64| {
                    let white = Spectrum::WHITE;
                    let sample = |u, _| glossy_sample(white, shininess, wo, u).map(|s| s.wi);
                    chi_square::fit_samples(50_000, 7, sample, |wi| glossy_pdf(other, wo, wi))
                };
                let fit = fit_to(shininess);
                assert!(fit.p > alarm, "shininess {shininess}, {wo}: {fit:?}");
                assert!(fit.detectable_deviation(alarm) < 0.1, "{fit:?}");
                assert!(fit_to(1.3 * shininess + 0.3).p < alarm);
            }
        }
    }

    #[test]
    fn light_runs_both_ways() {
        let mut numbers = PixelSampler::new(0, 0, 1);
        for _ in 0..1000 {
            let [a, b] = [numbers.get_sample(), numbers.next_2d()].map(kit::warp::uniform_sphere);
            let (there, back) = (
                glossy_f(Spectrum::WHITE, 10.0, a, b).g,
                glossy_f(Spectrum::WHITE, 10.0, b, a).g,
            );
            assert!((there - back).abs() <= 1e-12 * there.abs());
        }
    }

    /// Hard case 83 for rough mirrors: never more light than comes in, and all of it as they get smooth.
    #[test]
    fn a_furnace_is_not_outshone() {
        let albedo = |shininess: f64, wo: Vec3| {
            let mut numbers = PixelSampler::new(0, 0, 2);
            (0..20_000)
                .map(|_| {
                    glossy_sample(Spectrum::WHITE, shininess, wo, numbers.get_sample())
                        .map_or(0.0, |s| s.weight().g)
                })
                .collect::<Tally>()
                .mean()
        };
        for wo in views() {
            for shininess in [0.0, 1.0, 10.0, 100.0, 1e4, 1e300] {
                let a = albedo(shininess, wo);
                assert!((0.3..=1.0 + 1e-12).contains(&a), "{shininess} {wo}: {a}");
            }
            assert!(albedo(1e4, Vec3::Z) > 0.999);
        }
    }

    /// The estimate by samples equals the integral by uniform directions: f and pdf belong together.
    #[test]
    fn the_weight_of_samples_is_the_integral_of_f() {
        let wo = views()[1];
        let mut numbers = PixelSampler::new(0, 0, 3);
        let (mut by_samples, mut uniformly) = (Tally::default(), Tally::default());
        for _ in 0..200_000 {
            let u = numbers.get_sample();
            let s = glossy_sample(Spectrum::WHITE, 5.0, wo, u);
            by_samples.push(s.map_or(0.0, |s| s.weight().g));
            let wi = kit::warp::uniform_hemisphere(numbers.next_2d());
            uniformly.push(glossy_f(Spectrum::WHITE, 5.0, wo, wi).g * wi.z * TAU);
        }
        let error = by_samples
            .standard_error()
            .hypot(uniformly.standard_error());
        let z = (by_samples.mean() - uniformly.mean()) / error;
        // Five standard errors: a chance of 6e-7. A bias of 3 % is sure to be seen.
        assert!(z.abs() < 5.0, "{} {}", by_samples.mean(), uniformly.mean());
        assert!(10.0 * error < 0.03, "{error}");
    }

    #[test]
    fn odd_directions_are_no_nan() {
        assert_eq!(
            glossy_sample(Spectrum::WHITE, 5.0, Vec3::X, Vec2::ZERO),
            None
        );
        assert!(glossy_f(Spectrum::WHITE, 5.0, Vec3::X, Vec3::Z).is_black());
        assert!(glossy_f(Spectrum::WHITE, 5.0, Vec3::Z, -Vec3::Z).is_black());
        assert_eq!(glossy_pdf(5.0, Vec3::Z, Vec3::Y), 0.0);
        assert!(glossy_f(Spectrum::WHITE, 1e300, Vec3::Z, Vec3::Z).is_finite());
    }
}
