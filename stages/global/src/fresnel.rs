//! Part 4, task 1: how much of the light a smooth boundary reflects.

/// The share of unpolarised light that the boundary to a clear material reflects, in [0, 1].
///
/// `cos_i` is the cosine between the direction of the light and the normal, `eta` the index of refraction of the side
/// that light comes from over that of the other side. Light that passes goes on at the angle of Snell's law,
/// `sin θt = eta · sin θi`. Fresnel's equations for the two polarisations:
///
/// ```text
/// r∥ = (cos θi - eta · cos θt) / (cos θi + eta · cos θt)
/// r⊥ = (eta · cos θi - cos θt) / (eta · cos θi + cos θt)
/// F  = (r∥² + r⊥²) / 2
/// ```
///
/// If `eta · sin θi >= 1` nothing passes: total internal reflection, F = 1. Grazing light (`cos_i = 0`) is reflected in
/// full. With `eta = 1` there is no boundary: F = 0 (but for grazing light, where the equations say 0/0).
pub fn fresnel_dielectric(cos_i: f64, eta: f64) -> f64 {
    // BEGIN SOLUTION(part4.task1)
    let cos_i = cos_i.abs().min(1.0);
    if cos_i == 0.0 {
        return 1.0;
    }
    // 1 - eta² sin² θi, without the cancellation near grazing angles; with eta = 1 exactly cos² θi.
    let cos2_t = eta * eta * cos_i * cos_i + (1.0 - eta) * (1.0 + eta);
    if cos2_t <= 0.0 {
        return 1.0;
    }
    let cos_t = cos2_t.sqrt();
    let parallel = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    let perpendicular = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
    // STUB: kit::hole!("part4.task1", cos_i, eta)
    // END SOLUTION(part4.task1)
}

// BEGIN SOLUTION(part4.task1)
#[cfg(test)]
mod tests {
    use super::*;

    /// A handful of roundings.
    const ROUNDING: f64 = 1e-14;

    #[test]
    fn head_on_it_is_the_textbook_formula() {
        for ior in [1.0, 1.2, 1.45, 2.4] {
            let r = (ior - 1.0) / (ior + 1.0);
            assert!((fresnel_dielectric(1.0, 1.0 / ior) - r * r).abs() < ROUNDING);
            assert!((fresnel_dielectric(1.0, ior) - r * r).abs() < ROUNDING);
        }
    }

    #[test]
    fn grazing_light_is_reflected() {
        assert_eq!(fresnel_dielectric(0.0, 1.0 / 1.5), 1.0);
        assert!(fresnel_dielectric(1e-9, 1.0 / 1.5) > 0.999);
        assert_eq!(fresnel_dielectric(0.0, 1.0), 1.0);
    }

    /// Hard case 76.
    #[test]
    fn beyond_the_critical_angle_all_is_reflected() {
        // From glass of 1.5 to air the critical angle has the sine 1/1.5.
        let critical = (1.0_f64 - 1.0 / 2.25).sqrt();
        assert_eq!(fresnel_dielectric(critical * 0.999, 1.5), 1.0);
        assert!(fresnel_dielectric(critical * 1.001, 1.5) < 1.0);
    }

    /// Hard case 77.
    #[test]
    fn no_boundary_reflects_nothing() {
        for cos in [1.0, 0.7, 0.1, 1e-3] {
            assert!(fresnel_dielectric(cos, 1.0) < ROUNDING);
        }
    }

    /// At Brewster's angle, tan θ = n, only one polarisation is reflected: F = r⊥²/2 = ((n² - 1)/(n² + 1))² / 2.
    #[test]
    fn brewsters_angle() {
        let n = 1.5_f64;
        let cos = 1.0 / (1.0 + n * n).sqrt();
        let r = (n * n - 1.0) / (n * n + 1.0);
        assert!((fresnel_dielectric(cos, 1.0 / n) - 0.5 * r * r).abs() < ROUNDING);
    }

    /// The same light path reversed reflects as much.
    #[test]
    fn both_sides_of_a_boundary_agree() {
        let n = 1.45;
        for k in 1..100 {
            let cos_out = f64::from(k) / 100.0;
            let sin_in = (1.0 - cos_out * cos_out).sqrt() / n;
            let cos_in = (1.0 - sin_in * sin_in).sqrt();
            let there = fresnel_dielectric(cos_out, 1.0 / n);
            let back = fresnel_dielectric(cos_in, n);
            // The two cosines belong together only up to rounding, which grazing angles magnify.
            assert!((there - back).abs() < 1e-12, "{there} {back}");
        }
    }
}
// END SOLUTION(part4.task1)
