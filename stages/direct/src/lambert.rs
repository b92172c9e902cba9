//! Part 3, task 1: diffuse (Lambertian) surfaces.
//!
//! Directions are unit vectors in the local space of the surface and point away from it. The normal
//! is +z, so `w.z` is the cosine of the angle to the normal. Both sides of the surface are diffuse:
//! light from below is reflected below. No light is transmitted.

// BEGIN SOLUTION(part3.task1)
use kit::math;
use std::f64::consts::{FRAC_1_PI, TAU};
// END SOLUTION(part3.task1)

use kit::{BsdfSample, Spectrum, Vec2, Vec3};

/// The BSDF of a diffuse surface, in 1/sr: `ρ/π` if `wo` and `wi` are on the same side of the
/// surface, otherwise black.
///
/// Chapter: stages/book/src/part3/task1.md
///
/// The factor 1/π makes `ρ` the fraction of the light that is reflected: the integral of
/// `ρ/π · cos θ` over a hemisphere is `ρ`. A direction in the plane of the surface (`z = 0`) is on
/// neither side.
///
/// See it: `cargo grader picture part3.task1`.
pub fn lambert_f(reflectance: Spectrum, wo: Vec3, wi: Vec3) -> Spectrum {
    // BEGIN SOLUTION(part3.task1)
    if wo.z * wi.z > 0.0 {
        reflectance * FRAC_1_PI
    } else {
        Spectrum::BLACK
    }
    // STUB: kit::hole!("part3.task1", reflectance, wo, wi)
    // END SOLUTION(part3.task1)
}

/// The density with which [`lambert_sample`] samples `wi`, in 1/sr: in proportion to the cosine of
/// the angle to the normal on the side of `wo`, otherwise 0.
///
/// Chapter: stages/book/src/part3/task1.md
///
/// See it: `cargo grader picture part3.task1`.
pub fn lambert_pdf(wo: Vec3, wi: Vec3) -> f64 {
    // BEGIN SOLUTION(part3.task1)
    if wo.z * wi.z > 0.0 {
        wi.z.abs() * FRAC_1_PI
    } else {
        0.0
    }
    // STUB: kit::hole!("part3.task1", wo, wi)
    // END SOLUTION(part3.task1)
}

/// Samples a direction on the side of `wo` with a density in proportion to the cosine of the angle
/// to the normal.
///
/// Chapter: stages/book/src/part3/task1.md
///
/// `u` is uniform in [0, 1)². With this density `f · cos θ / pdf` is `ρ` for every direction, so all
/// samples have the same weight. How `u` becomes a direction is open. `None` if `wo` is in the
/// plane of the surface, where no light leaves.
///
/// See it: `cargo grader picture part3.task1`.
pub fn lambert_sample(reflectance: Spectrum, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
    // BEGIN SOLUTION(part3.task1)
    if wo.z == 0.0 {
        return None;
    }
    let (sin, cos) = math::sin_cos(TAU * u.y);
    let r = u.x.sqrt();
    // u.x < 1, so the height and the density are above 0.
    let z = (1.0 - u.x).sqrt();
    let wi = Vec3::new(r * cos, r * sin, z.copysign(wo.z));
    Some(BsdfSample {
        wi,
        f: reflectance * FRAC_1_PI,
        pdf: z * FRAC_1_PI,
        delta: false,
    })
    // STUB: kit::hole!("part3.task1", reflectance, wo, u)
    // END SOLUTION(part3.task1)
}

// BEGIN SOLUTION(part3.task1)
#[cfg(test)]
mod tests {
    use super::*;
    use kit::PixelSampler;
    use statistics::chi_square;
    use statistics::sidak;

    const RHO: Spectrum = Spectrum::new(0.9, 0.5, 0.0);
    /// Three rounding errors.
    const ROUNDING: f64 = 1e-15;

    fn wo_above() -> Vec3 {
        Vec3::new(0.48, -0.6, 0.64)
    }

    #[test]
    fn bsdf_is_constant_and_symmetric() {
        let f = lambert_f(RHO, wo_above(), Vec3::Z);
        assert_eq!(f, RHO * FRAC_1_PI);
        assert_eq!(f, lambert_f(RHO, Vec3::Z, wo_above()));
    }

    #[test]
    fn both_sides_are_diffuse_and_opaque() {
        assert_eq!(lambert_f(RHO, -wo_above(), -Vec3::Z), RHO * FRAC_1_PI);
        assert!(lambert_f(RHO, wo_above(), -Vec3::Z).is_black());
        assert_eq!(lambert_pdf(wo_above(), -Vec3::Z), 0.0);
        let below = lambert_sample(RHO, -wo_above(), Vec2::new(0.3, 0.7)).unwrap();
        assert!(below.wi.z < 0.0);
    }

    /// Hard case 75: 0/0 if `wo` is perpendicular to the normal.
    #[test]
    fn directions_in_the_plane_of_the_surface_are_black() {
        assert!(lambert_f(RHO, Vec3::X, Vec3::Z).is_black());
        assert!(lambert_f(RHO, Vec3::Z, Vec3::X).is_black());
        assert_eq!(lambert_pdf(Vec3::Z, Vec3::Y), 0.0);
        assert_eq!(lambert_sample(RHO, Vec3::X, Vec2::splat(0.5)), None);
    }

    #[test]
    fn samples_are_unit_and_agree_with_f_and_pdf() {
        let mut sampler = PixelSampler::new(0, 0, 7);
        let corners = [0.0, 1.0 - f64::EPSILON / 2.0];
        let extremes = corners
            .iter()
            .flat_map(|&x| corners.map(|y| Vec2::new(x, y)));
        for u in extremes.chain((0..1000).map(|_| sampler.get_sample())) {
            let s = lambert_sample(RHO, wo_above(), u).unwrap();
            assert!((s.wi.length() - 1.0).abs() < ROUNDING);
            assert!(s.pdf > 0.0 && !s.delta);
            assert_eq!(s.f, lambert_f(RHO, wo_above(), s.wi));
            assert!((s.pdf - lambert_pdf(wo_above(), s.wi)).abs() < ROUNDING);
            assert!((s.weight().r - RHO.r).abs() < ROUNDING);
        }
    }

    /// Hard case 89. The significance level of both tests together is 1e-6. They detect every
    /// deviation of 5 % (root mean square), so also samples that do not follow the density.
    #[test]
    fn samples_follow_the_pdf() {
        let significance = sidak(1e-6, 2);
        for wo in [wo_above(), -wo_above()] {
            let fit_to = |pdf: &dyn Fn(Vec3) -> f64| {
                let sample = |u, _| lambert_sample(RHO, wo, u).map(|s| s.wi);
                chi_square::fit_samples(200_000, 11, sample, pdf)
            };
            let fit = fit_to(&|wi| lambert_pdf(wo, wi));
            assert!(fit.p > significance, "p = {:e}", fit.p);
            assert!(fit.detectable_deviation(significance) < 0.05);
            let uniform = fit_to(&|wi| {
                if lambert_pdf(wo, wi) > 0.0 {
                    1.0 / TAU
                } else {
                    0.0
                }
            });
            let half = fit_to(&|wi| 0.5 * lambert_pdf(wo, wi));
            assert!(uniform.p < 1e-30 && half.p < 1e-30);
        }
    }
}
// END SOLUTION(part3.task1)
