//! Part 4, task 1: Fresnel reflectance of a smooth dielectric boundary.

/// The Fresnel reflectance of a dielectric boundary for unpolarised light: the fraction of light
/// that is reflected, in [0, 1].
///
/// Chapter: stages/book/src/part4/task1.md
///
/// `cos_i` is the cosine of the angle between the direction of the light and the normal. `eta` is
/// the index of refraction of the side that the light comes from, divided by that of the other
/// side. The angle of the refracted light follows from Snell's law, `sin θt = eta · sin θi`. Of
/// unpolarised light each polarisation has half of the power; Fresnel's equations are exact here, an
/// approximation such as Schlick's is not enough.
///
/// If `eta · sin θi >= 1`, nothing is refracted: total internal reflection, F = 1. At grazing
/// incidence (`cos_i = 0`) F = 1. With `eta = 1` there is no boundary and F = 0, except at grazing
/// incidence, where the equations give 0/0.
///
/// See it: `cargo grader picture part4.task1`.
pub fn fresnel_dielectric(cos_i: f64, eta: f64) -> f64 {
    // BEGIN SOLUTION(part4.task1)
    let cos_i = cos_i.abs().min(1.0);
    if cos_i == 0.0 {
        return 1.0;
    }
    // 1 - eta² sin² θi, without cancellation near grazing angles. With eta = 1 it is exactly cos²
    // θi.
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

    /// A few rounding errors.
    const ROUNDING: f64 = 1e-14;

    #[test]
    fn normal_incidence_is_the_textbook_formula() {
        for ior in [1.0, 1.2, 1.45, 2.4] {
            let r = (ior - 1.0) / (ior + 1.0);
            assert!((fresnel_dielectric(1.0, 1.0 / ior) - r * r).abs() < ROUNDING);
            assert!((fresnel_dielectric(1.0, ior) - r * r).abs() < ROUNDING);
        }
    }

    #[test]
    fn grazing_light_is_reflected_completely() {
        assert_eq!(fresnel_dielectric(0.0, 1.0 / 1.5), 1.0);
        assert!(fresnel_dielectric(1e-9, 1.0 / 1.5) > 0.999);
        assert_eq!(fresnel_dielectric(0.0, 1.0), 1.0);
    }

    /// Hard case 76.
    #[test]
    fn light_beyond_the_critical_angle_is_reflected_completely() {
        // From glass with index 1.5 to air the critical angle has the sine 1/1.5.
        let critical = (1.0_f64 - 1.0 / 2.25).sqrt();
        assert_eq!(fresnel_dielectric(critical * 0.999, 1.5), 1.0);
        assert!(fresnel_dielectric(critical * 1.001, 1.5) < 1.0);
    }

    /// Hard case 77.
    #[test]
    fn equal_indices_reflect_nothing() {
        for cos in [1.0, 0.7, 0.1, 1e-3] {
            assert!(fresnel_dielectric(cos, 1.0) < ROUNDING);
        }
    }

    /// At Brewster's angle, tan θ = n, only one polarisation is reflected: F = r⊥²/2 = ((n² -
    /// 1)/(n² + 1))² / 2.
    #[test]
    fn reflectance_at_brewsters_angle() {
        let n = 1.5_f64;
        let cos = 1.0 / (1.0 + n * n).sqrt();
        let r = (n * n - 1.0) / (n * n + 1.0);
        assert!((fresnel_dielectric(cos, 1.0 / n) - 0.5 * r * r).abs() < ROUNDING);
    }

    /// The reversed light path has the same reflectance.
    #[test]
    fn both_sides_of_a_boundary_agree() {
        let n = 1.45;
        for k in 1..100 {
            let cos_out = f64::from(k) / 100.0;
            let sin_in = (1.0 - cos_out * cos_out).sqrt() / n;
            let cos_in = (1.0 - sin_in * sin_in).sqrt();
            let forward = fresnel_dielectric(cos_out, 1.0 / n);
            let reverse = fresnel_dielectric(cos_in, n);
            // The two cosines agree only up to rounding, whose effect grows at grazing angles.
            assert!((forward - reverse).abs() < 1e-12, "{forward} {reverse}");
        }
    }
}
// END SOLUTION(part4.task1)
