//! Beyond the course: glossy (rough) mirrors.
//!
//! A rough surface consists of microfacets, tiny mirrors. A facet whose normal is the half vector
//! of `wo` and `wi` reflects one into the other:
//!
//! ```text
//! f = ρ · D(h) · G(wo, wi) / (4 · |cos θo| · |cos θi|)      h = (wo + wi) / |wo + wi|
//! ```
//!
//! Light that is reflected more than once between facets is lost: at normal incidence 1/40 with a
//! shininess of 100, 1/4 with 10, 2/3 with 0. Both sides of the surface are the same. Directions
//! are unit vectors in the local space of the surface; the normal is +z.

use crate::microfacets::{self, MIN_ALPHA};
use kit::{BsdfSample, Spectrum, Vec2, Vec3};

/// The roughness α of a surface with the Phong exponent `shininess`: `α² = 2 / (shininess + 2)`.
/// This gives the highlights of both models the same width at their peak (Walter and others 2007,
/// section 5.2, equation for Beckmann's α, which equals that of GGX at the peak). The largest value
/// is α = 1, for a shininess of 0.
pub fn roughness_of(shininess: f64) -> f64 {
    (2.0 / (shininess.max(0.0) + 2.0)).sqrt().max(MIN_ALPHA)
}

/// The half vector on the side of +z; `None` if the directions are on different sides.
fn half_vector(wo: Vec3, wi: Vec3) -> Option<Vec3> {
    if wo.z * wi.z <= 0.0 {
        return None;
    }
    let h = (wo + wi).try_normalize()?;
    Some(if h.z < 0.0 { -h } else { h })
}

/// The BSDF in 1/sr; black if `wo` and `wi` are not on the same side.
pub fn glossy_f(reflectance: Spectrum, shininess: f64, wo: Vec3, wi: Vec3) -> Spectrum {
    let Some(h) = half_vector(wo, wi) else {
        return Spectrum::BLACK;
    };
    let a = roughness_of(shininess);
    let masking = 1.0 / (1.0 + microfacets::lambda(wo, a) + microfacets::lambda(wi, a));
    reflectance * (microfacets::distribution(h, a) * masking / (4.0 * wo.z * wi.z))
}

/// The density with which [`glossy_sample`] samples `wi`, in 1/sr.
pub fn glossy_pdf(shininess: f64, wo: Vec3, wi: Vec3) -> f64 {
    let a = roughness_of(shininess);
    half_vector(wo, wi).map_or(0.0, |h| {
        microfacets::distribution(h, a) / ((1.0 + microfacets::lambda(wo, a)) * 4.0 * wo.z.abs())
    })
}

/// Samples a direction on the side of `wo`: samples a facet that is visible from `wo`, and reflects
/// `wo` at it.
///
/// `u` is uniform in [0, 1)². `None` if `wo` is in the plane of the surface, or if the reflected
/// direction points into the surface: that light is lost.
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
    let h = microfacets::sample_visible(up, a, u)?;
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

    /// Hard case 89. The significance level of all tests together is 1e-6. They detect every
    /// deviation of 10 % (root mean square), so also another shininess.
    #[test]
    fn samples_follow_the_pdf() {
        let significance = sidak(1e-6, 12);
        for shininess in [0.0, 3.0, 20.0] {
            for wo in views() {
                let fit_to = |other: f64| {
                    let white = Spectrum::WHITE;
                    let sample = |u, _| glossy_sample(white, shininess, wo, u).map(|s| s.wi);
                    chi_square::fit_samples(50_000, 7, sample, |wi| glossy_pdf(other, wo, wi))
                };
                let fit = fit_to(shininess);
                assert!(fit.p > significance, "shininess {shininess}, {wo}: {fit:?}");
                assert!(fit.detectable_deviation(significance) < 0.1, "{fit:?}");
                assert!(fit_to(1.3 * shininess + 0.3).p < significance);
            }
        }
    }

    #[test]
    fn bsdf_is_reciprocal() {
        let mut sampler = PixelSampler::new(0, 0, 1);
        for _ in 0..1000 {
            let [a, b] = [sampler.get_sample(), sampler.next_2d()].map(kit::warp::uniform_sphere);
            let (forward, reverse) = (
                glossy_f(Spectrum::WHITE, 10.0, a, b).g,
                glossy_f(Spectrum::WHITE, 10.0, b, a).g,
            );
            assert!((forward - reverse).abs() <= 1e-12 * forward.abs());
        }
    }

    /// Hard case 83 for rough mirrors: the albedo is at most 1, and approaches 1 for smooth
    /// surfaces.
    #[test]
    fn albedo_is_at_most_one() {
        let albedo = |shininess: f64, wo: Vec3| {
            let mut sampler = PixelSampler::new(0, 0, 2);
            (0..20_000)
                .map(|_| {
                    glossy_sample(Spectrum::WHITE, shininess, wo, sampler.get_sample())
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

    /// The estimate with samples equals the integral with uniform directions, so `f` and the pdf
    /// are consistent.
    #[test]
    fn mean_sample_weight_is_the_integral_of_f() {
        let wo = views()[1];
        let mut sampler = PixelSampler::new(0, 0, 3);
        let (mut by_samples, mut uniform) = (Tally::default(), Tally::default());
        for _ in 0..200_000 {
            let u = sampler.get_sample();
            let s = glossy_sample(Spectrum::WHITE, 5.0, wo, u);
            by_samples.push(s.map_or(0.0, |s| s.weight().g));
            let wi = kit::warp::uniform_hemisphere(sampler.next_2d());
            uniform.push(glossy_f(Spectrum::WHITE, 5.0, wo, wi).g * wi.z * TAU);
        }
        let error = by_samples.standard_error().hypot(uniform.standard_error());
        let z = (by_samples.mean() - uniform.mean()) / error;
        // Five standard errors: a probability of 6e-7. A bias of 3 % is detected.
        assert!(z.abs() < 5.0, "{} {}", by_samples.mean(), uniform.mean());
        assert!(10.0 * error < 0.03, "{error}");
    }

    #[test]
    fn special_directions_give_no_nan() {
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
