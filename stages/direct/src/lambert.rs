//! Part 3, task 1: surfaces that look the same from everywhere.
//!
//! Directions are unit vectors in the local space of the surface, pointing away from it: the normal is +z, so
//! `w.z` is the cosine to the normal. Both sides of the surface are matte: light that comes from below leaves
//! below. None passes through.

// BEGIN SOLUTION(part3.task1)
use kit::math;
use std::f64::consts::{FRAC_1_PI, TAU};
// END SOLUTION(part3.task1)

use kit::{BsdfSample, Spectrum, Vec2, Vec3};

/// The BSDF of a matte surface, in 1/sr: `ρ/π` if `wo` and `wi` are on the same side of the surface, else black.
///
/// The π makes `ρ` the share of light that leaves again: the integral of `ρ/π · cos θ` over a hemisphere is `ρ`.
/// A direction in the plane of the surface (`z = 0`) is on no side.
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

/// The density with which [`lambert_sample`] draws `wi`, in 1/sr: `|cos θi|/π` on the side of `wo`, else 0.
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

/// Draws a direction on the side of `wo`, with a density in proportion to the cosine to the normal.
///
/// `u` is uniform in [0, 1)². Malley's method: a point uniform over the unit disk, lifted onto the hemisphere above it.
/// Since `f · cos θ / pdf` is then `ρ` for every direction, no sample counts more than another. `None` if `wo` lies in
/// the plane of the surface: nothing leaves there.
pub fn lambert_sample(reflectance: Spectrum, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
    // BEGIN SOLUTION(part3.task1)
    if wo.z == 0.0 {
        return None;
    }
    let (sin, cos) = math::sin_cos(TAU * u.y);
    let r = u.x.sqrt();
    // u.x < 1, so the height is above 0 and the density, too.
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
    /// Three roundings.
    const ROUNDING: f64 = 1e-15;

    fn up() -> Vec3 {
        Vec3::new(0.48, -0.6, 0.64)
    }

    #[test]
    fn the_same_from_everywhere() {
        let f = lambert_f(RHO, up(), Vec3::Z);
        assert_eq!(f, RHO * FRAC_1_PI);
        assert_eq!(f, lambert_f(RHO, Vec3::Z, up()));
    }

    #[test]
    fn both_sides_are_matte_and_none_lets_light_through() {
        assert_eq!(lambert_f(RHO, -up(), -Vec3::Z), RHO * FRAC_1_PI);
        assert!(lambert_f(RHO, up(), -Vec3::Z).is_black());
        assert_eq!(lambert_pdf(up(), -Vec3::Z), 0.0);
        let below = lambert_sample(RHO, -up(), Vec2::new(0.3, 0.7)).unwrap();
        assert!(below.wi.z < 0.0);
    }

    /// Hard case 75: 0/0 where `wo` is perpendicular to the normal.
    #[test]
    fn in_the_plane_of_the_surface_nothing_leaves() {
        assert!(lambert_f(RHO, Vec3::X, Vec3::Z).is_black());
        assert!(lambert_f(RHO, Vec3::Z, Vec3::X).is_black());
        assert_eq!(lambert_pdf(Vec3::Z, Vec3::Y), 0.0);
        assert_eq!(lambert_sample(RHO, Vec3::X, Vec2::splat(0.5)), None);
    }

    #[test]
    fn samples_are_unit_and_agree_with_f_and_pdf() {
        let mut numbers = PixelSampler::new(0, 0, 7);
        let corners = [0.0, 1.0 - f64::EPSILON / 2.0];
        let extremes = corners
            .iter()
            .flat_map(|&x| corners.map(|y| Vec2::new(x, y)));
        for u in extremes.chain((0..1000).map(|_| numbers.get_sample())) {
            let s = lambert_sample(RHO, up(), u).unwrap();
            assert!((s.wi.length() - 1.0).abs() < ROUNDING);
            assert!(s.pdf > 0.0 && !s.delta);
            assert_eq!(s.f, lambert_f(RHO, up(), s.wi));
            assert!((s.pdf - lambert_pdf(up(), s.wi)).abs() < ROUNDING);
            assert!((s.weight().r - RHO.r).abs() < ROUNDING);
        }
    }

    /// Hard case 89. Both false alarms together have a chance of 1e-6; a deviation of 5 % (root mean square) is sure to be
    /// seen, as that of samples and a density which do not belong together is.
    #[test]
    fn samples_fall_where_the_pdf_says() {
        let alarm = sidak(1e-6, 2);
        for wo in [up(), -up()] {
            let fit_to = |pdf: &dyn Fn(Vec3) -> f64| {
                let sample = |u, _| lambert_sample(RHO, wo, u).map(|s| s.wi);
                chi_square::fit_samples(200_000, 11, sample, pdf)
            };
            let fit = fit_to(&|wi| lambert_pdf(wo, wi));
            assert!(fit.p > alarm, "p = {:e}", fit.p);
            assert!(fit.detectable_deviation(alarm) < 0.05);
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
