//! Sampling of emitting spheres.

use crate::light_sample::towards;
use crate::{Frame, LightSample, Spectrum, Sphere, Vec2, Vec3, math};
use std::f64::consts::TAU;

/// Samples a direction from `p` to the sphere.
///
/// Seen from outside, the sphere fills a cone, which is sampled uniformly in solid angle (Shirley,
/// Wang, Zimmerman: "Monte Carlo techniques for direct lighting calculations", 1996). `None` if `p`
/// is inside the sphere or on it.
pub(crate) fn sample(s: &Sphere, radiance: Spectrum, p: Vec3, u: Vec2) -> Option<LightSample> {
    let (axis, d) = towards(p, s.center)?;
    let sin2_max = (s.radius / d) * (s.radius / d);
    if s.radius <= 0.0 || sin2_max >= 1.0 {
        return None;
    }
    let share = cone_height(sin2_max);
    // 1 - cos θ is uniform in [0, share). This form avoids cancellation for a small cone.
    let one_minus_cos = u.x * share;
    let cos = 1.0 - one_minus_cos;
    let sin2 = (one_minus_cos * (2.0 - one_minus_cos)).max(0.0);
    let (sin_phi, cos_phi) = math::sin_cos(TAU * u.y);
    let sin = sin2.sqrt();
    let frame = Frame::around(axis);
    let wi = frame
        .to_world(Vec3::new(sin * cos_phi, sin * sin_phi, cos))
        .normalize();
    // BEGIN SOLUTION(part1.task4)
    let half_chord2 = (s.radius * s.radius - d * d * sin2).max(0.0);
    let distance = d * cos - half_chord2.sqrt();
    // STUB: // The angle at the centre between `p` and the sampled point, and the law of cosines.
    // STUB: let cone_share = sin2 / sin2_max;
    // STUB: let cos_at_center = cone_share * sin2_max.sqrt() + cos * (1.0 - cone_share).max(0.0).sqrt();
    // STUB: let distance = (d * d + s.radius * (s.radius - 2.0 * d * cos_at_center)).max(0.0).sqrt();
    // END SOLUTION(part1.task4)
    Some(LightSample {
        wi,
        distance,
        pdf: 1.0 / (TAU * share),
        radiance,
    })
}

/// The density with which [`sample`] samples any direction from `p` that hits the sphere, in 1/sr;
/// 0 if `p` is inside the sphere or on it.
pub(crate) fn pdf(s: &Sphere, p: Vec3) -> f64 {
    let sin2 = s.radius * s.radius / p.distance_squared(s.center);
    if sin2 < 1.0 {
        1.0 / (TAU * cone_height(sin2))
    } else {
        0.0
    }
}

/// `1 - cos θ` of a cone whose half angle has the squared sine `sin2`, without cancellation.
fn cone_height(sin2: f64) -> f64 {
    sin2 / (1.0 + (1.0 - sin2).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emitter::tests::{P, assert_follows_pdf};
    use crate::{Emitter, PrimId};

    #[test]
    fn sphere_samples_follow_the_pdf() {
        let center = P + Vec3::new(0.4, 0.5, 0.9);
        let emitter = Emitter::Sphere {
            sphere: Sphere {
                center,
                radius: 0.7,
            },
            radiance: Spectrum::WHITE,
            prim: PrimId(0),
        };
        let pdf = |w: Vec3| {
            let along = (center - P).dot(w);
            let beside2 = (center - P).length_squared() - along * along;
            if along > 0.0 && beside2 < 0.49 {
                emitter.pdf(P, w, 0.0, Vec3::ZERO)
            } else {
                0.0
            }
        };
        assert_follows_pdf(&emitter, pdf);
        // The sampled point is on the sphere, on the side that faces `P`.
        let s = emitter.sample(P, Vec2::new(0.3, 0.6)).unwrap();
        let q = P + s.distance * s.wi;
        assert!((q.distance(center) - 0.7).abs() < 1e-12);
        assert!((q - center).dot(s.wi) < 0.0);
        // A point inside the sphere or on it receives nothing.
        assert_eq!(emitter.sample(center, Vec2::ZERO), None);
        assert_eq!(emitter.sample(center + 0.7 * Vec3::Y, Vec2::ZERO), None);
        assert_eq!(emitter.pdf(center, Vec3::X, 0.7, Vec3::X), 0.0);
    }

    #[test]
    fn small_distant_sphere_has_an_accurate_pdf() {
        let emitter = Emitter::Sphere {
            sphere: Sphere {
                center: P + 1e9 * Vec3::Z,
                radius: 1.0,
            },
            radiance: Spectrum::WHITE,
            prim: PrimId(0),
        };
        // A disk of area π at distance 1e9.
        let s = emitter.sample(P, Vec2::new(0.5, 0.5)).unwrap();
        assert!((s.pdf * std::f64::consts::PI * 1e-18 - 1.0).abs() < 1e-9);
    }
}
