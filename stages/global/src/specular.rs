//! Part 4, task 1: mirrors, refraction and glass.
//!
//! Directions are unit vectors in the local space of the surface and point away from it; the normal
//! is +z. The *outside* of a surface is the side of its normal, `z > 0`. `ior` is the index of
//! refraction of the inside divided by that of the outside.
//!
//! These surfaces scatter light into one or two directions only. Their BSDF is a delta
//! distribution. So [`Scattering::f`](kit::Scattering::f) is black, and [`BsdfSample::f`] is the
//! factor in front of the delta function. The fraction of the incoming light that is scattered is
//! `f · |cos θi| / pdf`.

// BEGIN SOLUTION(part4.task1)
use crate::fresnel_dielectric;
// END SOLUTION(part4.task1)

use kit::{BsdfSample, Spectrum, Vec3};

/// The mirror direction of `wo`: `wo` rotated by 180 degrees about the normal.
///
/// Chapter: stages/book/src/part4/task1.md
///
/// See it: `cargo grader picture part4.task1`.
pub fn reflect(wo: Vec3) -> Vec3 {
    // BEGIN SOLUTION(part4.task1)
    Vec3::new(-wo.x, -wo.y, wo.z)
    // STUB: kit::hole!("part4.task1", wo)
    // END SOLUTION(part4.task1)
}

/// The direction on the other side of the boundary from which light is refracted into `wo`. Snell's
/// law is `sin θi = η · sin θo`, where η is the index of refraction of the side of `wo` divided by
/// that of the other side.
///
/// Chapter: stages/book/src/part4/task1.md
///
/// `None` on total internal reflection (`η · sin θo >= 1`), or if `wo` is in the plane of the
/// surface. With `ior` 1 the direction is `-wo`.
///
/// See it: `cargo grader picture part4.task1`.
pub fn refract(wo: Vec3, ior: f64) -> Option<Vec3> {
    // BEGIN SOLUTION(part4.task1)
    let eta = relative_index(wo, ior);
    // 1 - η² sin² θo, without cancellation near grazing angles. With η = 1 it is exactly cos² θo.
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
/// The index of refraction of the side of `wo` divided by that of the other side.
fn relative_index(wo: Vec3, ior: f64) -> f64 {
    if wo.z > 0.0 { 1.0 / ior } else { ior }
}
// END SOLUTION(part4.task1)

/// Samples a mirror, the same on both sides: the direction of [`reflect`] with probability 1. The
/// fraction `reflectance` of the light is reflected. `None` if `wo` is in the plane of the surface.
///
/// Chapter: stages/book/src/part4/task1.md
///
/// See it: `cargo grader picture part4.task1`.
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

/// Samples a boundary that refracts and does not reflect: the direction of [`refract`] with
/// probability 1. The radiance is multiplied by `transmittance · η²`.
///
/// Chapter: stages/book/src/part4/task1.md
///
/// η is the index of refraction of the side of `wo` divided by that of the other side. Light that
/// enters a denser material is concentrated into a narrower cone, so its radiance is higher there
/// (Veach, "Robust Monte Carlo methods for light transport simulation", 1997, section 5.2). On the
/// way into a body and out of it the factors cancel. `None` if [`refract`] returns `None`: that
/// light is lost.
///
/// See it: `cargo grader picture part4.task1`.
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

/// Samples smooth glass: the fraction F of [`crate::fresnel_dielectric`] is reflected and
/// multiplied by `reflectance`; the rest is refracted and multiplied by `transmittance` and by η²
/// as in [`refraction_sample`].
///
/// Chapter: stages/book/src/part4/task1.md
///
/// `choice`, uniform in [0, 1), selects one of the two: reflection if `choice < F`, with the `pdf`
/// F, otherwise refraction with the `pdf` 1 - F. So a path continues in one direction only, and F
/// cancels in `f · |cos θi| / pdf`. With total internal reflection F = 1. `None` if `wo` is in the
/// plane of the surface.
///
/// See it: `cargo grader picture part4.task1`.
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

    /// A few rounding errors.
    const ROUNDING: f64 = 1e-14;
    const TINT: Spectrum = Spectrum::new(1.0, 0.5, 0.25);

    fn assert_same(a: Spectrum, b: Spectrum) {
        let d = a - b;
        assert!(
            d.r.abs().max(d.g.abs()).max(d.b.abs()) < ROUNDING,
            "{a:?} {b:?}"
        );
    }

    /// Directions that cover the sphere.
    fn directions() -> impl Iterator<Item = Vec3> {
        (0..400).map(|k| {
            let u = kit::Vec2::new((f64::from(k) + 0.5) / 400.0, f64::from(k) * 0.618 % 1.0);
            kit::warp::uniform_sphere(u)
        })
    }

    #[test]
    fn mirror_direction_is_rotated_about_the_normal() {
        let s = mirror_sample(TINT, Vec3::new(0.6, 0.0, 0.8)).unwrap();
        assert_eq!(s.wi, Vec3::new(-0.6, 0.0, 0.8));
        assert!(s.delta && s.pdf == 1.0);
        assert_same(s.weight(), TINT);
        let behind = mirror_sample(TINT, Vec3::new(0.0, 0.6, -0.8)).unwrap();
        assert_eq!(behind.wi, Vec3::new(0.0, -0.6, -0.8));
        assert_same(behind.weight(), TINT);
    }

    #[test]
    fn refraction_follows_snells_law() {
        for ior in [0.7, 1.0, 1.33, 2.4] {
            for wo in directions() {
                let Some(wi) = refract(wo, ior) else { continue };
                assert!((wi.length() - 1.0).abs() < ROUNDING);
                assert!(wi.z * wo.z < 0.0, "must be on the other side");
                assert!(
                    wi.x * wo.x <= 0.0 && wi.y * wo.y <= 0.0,
                    "must be across the normal"
                );
                let (inside, outside) = if wo.z > 0.0 { (wi, wo) } else { (wo, wi) };
                let sin = |w: Vec3| w.x.hypot(w.y);
                assert!((ior * sin(inside) - sin(outside)).abs() < ROUNDING);
                // The reversed path is refracted into the original direction.
                let reverse = refract(wi, ior).unwrap();
                assert!((reverse - wo).length() < 1e-6, "{reverse} {wo}");
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
        // At the same angle light from outside is refracted.
        assert!(refract(-wo, 1.5).is_some());
    }

    /// Hard case 77.
    #[test]
    fn glass_of_index_one_is_invisible() {
        for wo in directions() {
            let s = glass_sample(Spectrum::WHITE, TINT, 1.0, wo, 0.5).unwrap();
            assert!((s.wi + wo).length() < ROUNDING);
            assert_same(s.weight(), TINT);
        }
    }

    /// Hard case 75.
    #[test]
    fn directions_in_the_plane_of_the_surface_are_none() {
        assert_eq!(mirror_sample(TINT, Vec3::X), None);
        assert_eq!(refract(Vec3::X, 1.5), None);
        assert_eq!(refraction_sample(TINT, 0.5, Vec3::Y), None);
        assert_eq!(glass_sample(TINT, TINT, 1.5, Vec3::X, 0.0), None);
        assert_eq!(glass_sample(TINT, TINT, 1.0, Vec3::X, 0.9), None);
    }

    /// Through a slab with parallel sides the factors η² cancel.
    #[test]
    fn slab_does_not_change_radiance() {
        for wo in directions().filter(|w| w.z > 0.0) {
            let enter = refraction_sample(Spectrum::WHITE, 1.5, wo).unwrap();
            let leave = refraction_sample(Spectrum::WHITE, 1.5, enter.wi).unwrap();
            assert_same(enter.weight() * leave.weight(), Spectrum::WHITE);
            assert!((enter.weight().g - 1.0 / 2.25).abs() < ROUNDING);
        }
    }

    /// The probability of the choice cancels in the weight, and the two choices have the
    /// probabilities F and 1 - F.
    #[test]
    fn glass_chooses_by_the_fresnel_reflectance() {
        for wo in directions() {
            let reflected_fraction = fresnel_dielectric(wo.z, relative_index(wo, 1.45));
            let reflected = glass_sample(TINT, Spectrum::WHITE, 1.45, wo, 0.0).unwrap();
            assert_eq!(reflected.wi, reflect(wo));
            assert_eq!(reflected.pdf, reflected_fraction);
            assert_same(reflected.weight(), TINT);
            assert_same(reflected.f * wo.z.abs(), TINT * reflected_fraction);
            if reflected_fraction < 1.0 {
                let refracted =
                    glass_sample(TINT, Spectrum::WHITE, 1.45, wo, reflected_fraction).unwrap();
                assert_eq!(Some(refracted.wi), refract(wo, 1.45));
                assert!((refracted.pdf + reflected_fraction - 1.0).abs() < ROUNDING);
                let eta = relative_index(wo, 1.45);
                assert_same(refracted.weight(), Spectrum::grey(eta * eta));
            }
        }
    }
}
// END SOLUTION(part4.task1)
