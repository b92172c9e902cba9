//! Beyond the course: multiple importance sampling.
//!
//! Light sampling is noisy if the surface is nearly a mirror, and BSDF sampling is noisy if the
//! light is small. Multiple importance sampling uses both, and weights each sample by the density
//! of its own strategy relative to that of the other. The weights of a direction add up to 1, so
//! the estimate is unbiased, and each strategy has a large weight only where it is good (Veach and
//! Guibas, "Optimally combining sampling techniques for Monte Carlo rendering", SIGGRAPH 1995).

// BEGIN SOLUTION(part3.task3)
use kit::Emitter;
// END SOLUTION(part3.task3)

use kit::{Hit, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

/// The power heuristic with exponent 2: the weight of a sample with the density `own`, if the other
/// strategy has the density `other` and as many samples. 0 if `own` is 0.
pub fn power_heuristic(own: f64, other: f64) -> f64 {
    if own == 0.0 {
        return 0.0;
    }
    // The ratio does not overflow where squares would.
    let ratio = other / own;
    1.0 / (1.0 + ratio * ratio)
}

/// Estimates direct light by sampling every light and the BSDF of the surface, with `ns_area_light`
/// samples each. `pathtracer --mis` needs it.
///
/// Arguments and conventions are those of
/// [`estimate_direct_lighting_importance`](crate::estimate_direct_lighting_importance) and
/// [`estimate_direct_lighting_hemisphere`](crate::estimate_direct_lighting_hemisphere). Delta
/// lights are sampled in the same way, with weight 1, because no ray hits them.
#[allow(
    clippy::too_many_arguments,
    reason = "the functions of both strategies come in as arguments"
)]
pub fn estimate_direct_lighting_mis(
    lit: &LitScene,
    surface: &Surface,
    wo: Vec3,
    ns_area_light: u32,
    sampler: &mut PixelSampler,
    scattering: &impl Scattering,
    trace: &mut impl FnMut(&Ray) -> Option<Hit>,
    occluded: &mut impl FnMut(&Ray) -> bool,
) -> Spectrum {
    // BEGIN SOLUTION(part3.task3)
    if surface.material.is_delta() {
        return Spectrum::BLACK;
    }
    let local_wo = surface.frame.to_local(wo);
    let mut direct = Spectrum::BLACK;
    let mut has_extent = false;
    for emitter in &lit.emitters {
        let delta = emitter.is_delta();
        has_extent |= !delta;
        let samples = if delta { 1 } else { ns_area_light };
        let mut sum = Spectrum::BLACK;
        for _ in 0..samples {
            let Some(light) = emitter.sample(surface.p, sampler.next_2d()) else {
                continue;
            };
            let wi = surface.frame.to_local(light.wi);
            let f = scattering.f(surface.material, local_wo, wi);
            if f.is_black() || occluded(&surface.shadow_ray(&light)) {
                continue;
            }
            let weight = if delta {
                1.0
            } else {
                let other = scattering.pdf(surface.material, local_wo, wi);
                power_heuristic(light.pdf, other)
            };
            sum += f * light.radiance * (weight * wi.z.abs() / light.pdf);
        }
        direct += sum / f64::from(samples.max(1));
    }
    if !has_extent {
        return direct;
    }
    let mut sum = Spectrum::BLACK;
    for _ in 0..ns_area_light {
        let (u, choice) = (sampler.next_2d(), sampler.next_1d());
        let Some(sample) = scattering.sample(surface.material, local_wo, u, choice) else {
            continue;
        };
        let d = surface.frame.to_world(sample.wi);
        let seen = match trace(&surface.leave(d)) {
            Some(hit) => {
                let there = lit.surface(&hit);
                let pdf = lit
                    .emitter_of(hit.prim)
                    .map_or(0.0, |emitter| emitter.pdf(surface.p, d, hit.t, there.ng));
                there.emitted(-d) * power_heuristic(sample.pdf, pdf)
            }
            None => weighted_background(lit, surface.p, d, sample.pdf),
        };
        sum += seen * sample.weight();
    }
    direct + sum / f64::from(ns_area_light.max(1))
    // STUB: kit::hole!("part3.task3", lit, surface, wo, ns_area_light, sampler, scattering, trace, occluded)
    // END SOLUTION(part3.task3)
}

// BEGIN SOLUTION(part3.task3)
/// The radiance of skies and environment maps along `d`, each with the weight against its own
/// sampling density.
fn weighted_background(lit: &LitScene, p: Vec3, d: Vec3, own: f64) -> Spectrum {
    lit.emitters
        .iter()
        .map(|emitter| {
            let weight =
                |emitter: &Emitter| power_heuristic(own, emitter.pdf(p, d, 0.0, Vec3::ZERO));
            match emitter {
                Emitter::Sky { radiance } if d.y >= 0.0 => *radiance * weight(emitter),
                Emitter::Environment(environment) => environment.radiance(d) * weight(emitter),
                _ => Spectrum::BLACK,
            }
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_a_direction_add_up_to_one() {
        for (a, b) in [(1.0, 3.0), (1e-200, 1e200), (0.25, 0.0), (1e200, 1e200)] {
            assert!((power_heuristic(a, b) + power_heuristic(b, a) - 1.0).abs() < 1e-15);
        }
        assert_eq!(power_heuristic(0.0, 0.0), 0.0);
    }
}
// END SOLUTION(part3.task3)
