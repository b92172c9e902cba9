//! Part 4, task 1: mirrors, refraction and glass.
//!
//! Directions are unit vectors in the local space of the surface, pointing away from it, and the normal is +z. The
//! *outside* of a surface is the side of its normal, `z > 0`; `ior` is the index of refraction of the inside over that of
//! the outside. These surfaces scatter light in one or two directions only. Their BSDF is a delta function, so
//! [`Scattering::f`](kit::Scattering::f) is black and [`BsdfSample::f`] is the factor in front of it: `f · |cos θi| / pdf`
//! is the share of the light that arrives.

// BEGIN SOLUTION(part4.task1)
use crate::fresnel_dielectric;
// END SOLUTION(part4.task1)

use kit::{BsdfSample, Spectrum, Vec3};

/// The direction that a mirror sends to `wo`: `wo` turned by half a turn around the normal.
pub fn reflect(wo: Vec3) -> Vec3 {
    // BEGIN SOLUTION(part4.task1)
    Vec3::new(-wo.x, -wo.y, wo.z)
    // STUB: kit::hole!("part4.task1", wo)
    // END SOLUTION(part4.task1)
}

/// The direction on the other side of the boundary from which light is bent to `wo`, by Snell's law
/// `sin θi = η · sin θo`, where η is the index of the side of `wo` over that of the other side.
///
/// `None` if there is none (total internal reflection, `η · sin θo >= 1`), or if `wo` lies in the plane of the surface
/// and so comes from no side. With `ior` 1 the direction is `-wo`.
pub fn refract(wo: Vec3, ior: f64) -> Option<Vec3> {
    // BEGIN SOLUTION(part4.task1)
    let eta = relative_index(wo, ior);
    // 1 - η² sin² θo, without the cancellation near grazing angles; with η = 1 exactly cos² θo.
    let cos2_i = eta * eta * wo.z * wo.z + (1.0 - eta) * (1.0 + eta);
    if wo.z == 0.0 || cos2_i <= 0.0 {
        return None;
    }
    let wi = Vec3::new(-eta * wo.x, -eta * wo.y, -cos2_i.sqrt().copysign(wo.z));
    Some(wi.normalize())
    // STUB: kit::hole!("part4.task1", wo, ior)
    // END SOLUTION(part4.task1)
}

// BEGIN SOLUTION(part4.task1)
/// The index of the side of `wo` over that of the other side.
fn relative_index(wo: Vec3, ior: f64) -> f64 {
    if wo.z > 0.0 { 1.0 / ior } else { ior }
}
// END SOLUTION(part4.task1)

/// A mirror, on both sides: the direction of [`reflect`] with certainty. The share `reflectance` of the light arrives.
/// `None` if `wo` lies in the plane of the surface.
pub fn mirror_sample(reflectance: Spectrum, wo: Vec3) -> Option<BsdfSample> {
    // BEGIN SOLUTION(part4.task1)
    let wi = reflect(wo);
    (wi.z != 0.0).then(|| BsdfSample {
        wi,
        f: reflectance / wi.z.abs(),
        pdf: 1.0,
        delta: true,
    })
    // STUB: kit::hole!("part4.task1", reflectance, wo)
    // END SOLUTION(part4.task1)
}

/// A boundary that refracts without reflecting: the direction of [`refract`] with certainty. The share
/// `transmittance · η²` of the radiance arrives.
///
/// η² is the index of the side of `wo` over that of the other side, squared: light that enters a denser material is
/// squeezed into a narrower cone, so its radiance there is higher (Veach, "Robust Monte Carlo methods for light transport
/// simulation", 1997, section 5.2). On the way in and out of a body the factors cancel. `None` where [`refract`] is:
/// that light is lost.
pub fn refraction_sample(transmittance: Spectrum, ior: f64, wo: Vec3) -> Option<BsdfSample> {
    // BEGIN SOLUTION(part4.task1)
    let wi = refract(wo, ior)?;
    let eta = relative_index(wo, ior);
    Some(BsdfSample {
        wi,
        f: transmittance * (eta * eta / wi.z.abs()),
        pdf: 1.0,
        delta: true,
    })
    // STUB: kit::hole!("part4.task1", transmittance, ior, wo)
    // END SOLUTION(part4.task1)
}

/// Smooth glass: the share F of [`crate::fresnel_dielectric`] is reflected, tinted by `reflectance`,
/// the rest refracted, tinted by `transmittance` and scaled by η² as in [`refraction_sample`].
///
/// `choice`, uniform in [0, 1), picks one of the two: reflection if `choice < F`, which is then the `pdf`; else refraction
/// with the `pdf` 1 - F. So a path goes one way only, and F cancels from `f · |cos θi| / pdf`. Under total internal
/// reflection F = 1. `None` if `wo` lies in the plane of the surface.
pub fn glass_sample(
    reflectance: Spectrum,
    transmittance: Spectrum,
    ior: f64,
    wo: Vec3,
    choice: f64,
) -> Option<BsdfSample> {
    // BEGIN SOLUTION(part4.task1)
    let share = fresnel_dielectric(wo.z, relative_index(wo, ior));
    let (sample, pdf) = if choice < share {
        (mirror_sample(reflectance, wo)?, share)
    } else {
        (refraction_sample(transmittance, ior, wo)?, 1.0 - share)
    };
    Some(BsdfSample {
        f: sample.f * pdf,
        pdf,
        ..sample
    })
    // STUB: kit::hole!("part4.task1", reflectance, transmittance, ior, wo, choice)
    // END SOLUTION(part4.task1)
}

// BEGIN SOLUTION(part4.task1)
#[cfg(test)]
mod tests {
    use super::*;

    /// A handful of roundings.
    const ROUNDING: f64 = 1e-14;
    const TINT: Spectrum = Spectrum::new(1.0, 0.5, 0.25);

    fn assert_same(a: Spectrum, b: Spectrum) {
        let d = a - b;
        assert!(
            d.r.abs().max(d.g.abs()).max(d.b.abs()) < ROUNDING,
            "{a:?} {b:?}"
        );
    }

    /// Directions all over the sphere.
    fn directions() -> impl Iterator<Item = Vec3> {
        (0..400).map(|k| {
            let u = kit::Vec2::new((f64::from(k) + 0.5) / 400.0, f64::from(k) * 0.618 % 1.0);
            kit::warp::uniform_sphere(u)
        })
    }

    #[test]
    fn a_mirror_turns_around_the_normal() {
        let s = mirror_sample(TINT, Vec3::new(0.6, 0.0, 0.8)).unwrap();
        assert_eq!(s.wi, Vec3::new(-0.6, 0.0, 0.8));
        assert!(s.delta && s.pdf == 1.0);
        assert_same(s.weight(), TINT);
        let behind = mirror_sample(TINT, Vec3::new(0.0, 0.6, -0.8)).unwrap();
        assert_eq!(behind.wi, Vec3::new(0.0, -0.6, -0.8));
        assert_same(behind.weight(), TINT);
    }

    #[test]
    fn refraction_obeys_snell() {
        for ior in [0.7, 1.0, 1.33, 2.4] {
            for wo in directions() {
                let Some(wi) = refract(wo, ior) else { continue };
                assert!((wi.length() - 1.0).abs() < ROUNDING);
                assert!(wi.z * wo.z < 0.0, "the other side");
                assert!(
                    wi.x * wo.x <= 0.0 && wi.y * wo.y <= 0.0,
                    "across the normal"
                );
                let (inside, outside) = if wo.z > 0.0 { (wi, wo) } else { (wo, wi) };
                let sin = |w: Vec3| w.x.hypot(w.y);
                assert!((ior * sin(inside) - sin(outside)).abs() < ROUNDING);
                // Light runs the same way back.
                let back = refract(wi, ior).unwrap();
                assert!((back - wo).length() < 1e-6, "{back} {wo}");
            }
        }
    }

    /// Hard case 76.
    #[test]
    fn total_internal_reflection() {
        let wo = Vec3::new(0.8, 0.0, -0.6);
        assert_eq!(refract(wo, 1.5), None);
        assert_eq!(refraction_sample(TINT, 1.5, wo), None);
        for choice in [0.0, 0.5, 1.0 - f64::EPSILON] {
            let s = glass_sample(TINT, Spectrum::WHITE, 1.5, wo, choice).unwrap();
            assert_eq!(s.wi, Vec3::new(-0.8, 0.0, -0.6));
            assert_same(s.weight(), TINT);
        }
        // From outside the same angle enters.
        assert!(refract(-wo, 1.5).is_some());
    }

    /// Hard case 77.
    #[test]
    fn glass_of_index_one_is_not_there() {
        for wo in directions() {
            let s = glass_sample(Spectrum::WHITE, TINT, 1.0, wo, 0.5).unwrap();
            assert!((s.wi + wo).length() < ROUNDING);
            assert_same(s.weight(), TINT);
        }
    }

    /// Hard case 75.
    #[test]
    fn in_the_plane_of_the_surface_nothing_leaves() {
        assert_eq!(mirror_sample(TINT, Vec3::X), None);
        assert_eq!(refract(Vec3::X, 1.5), None);
        assert_eq!(refraction_sample(TINT, 0.5, Vec3::Y), None);
        assert_eq!(glass_sample(TINT, TINT, 1.5, Vec3::X, 0.0), None);
        assert_eq!(glass_sample(TINT, TINT, 1.0, Vec3::X, 0.9), None);
    }

    /// In and out of a slab the squared indices cancel.
    #[test]
    fn radiance_is_the_same_behind_a_window() {
        for wo in directions().filter(|w| w.z > 0.0) {
            let enter = refraction_sample(Spectrum::WHITE, 1.5, wo).unwrap();
            let leave = refraction_sample(Spectrum::WHITE, 1.5, enter.wi).unwrap();
            assert_same(enter.weight() * leave.weight(), Spectrum::WHITE);
            assert!((enter.weight().g - 1.0 / 2.25).abs() < ROUNDING);
        }
    }

    /// What is chosen with its probability counts in full; both choices together give what Fresnel says.
    #[test]
    fn glass_splits_by_fresnel() {
        for wo in directions() {
            let share = fresnel_dielectric(wo.z, relative_index(wo, 1.45));
            let reflected = glass_sample(TINT, Spectrum::WHITE, 1.45, wo, 0.0).unwrap();
            assert_eq!(reflected.wi, reflect(wo));
            assert_eq!(reflected.pdf, share);
            assert_same(reflected.weight(), TINT);
            assert_same(reflected.f * wo.z.abs(), TINT * share);
            if share < 1.0 {
                let passed = glass_sample(TINT, Spectrum::WHITE, 1.45, wo, share).unwrap();
                assert_eq!(Some(passed.wi), refract(wo, 1.45));
                assert!((passed.pdf + share - 1.0).abs() < ROUNDING);
                let eta = relative_index(wo, 1.45);
                assert_same(passed.weight(), Spectrum::grey(eta * eta));
            }
        }
    }
}
// END SOLUTION(part4.task1)
