//! Part 3, task 3: direct light by sampling the lights.

use kit::{LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

/// Estimates direct light by sampling every light: the sum over [`LitScene::emitters`] of the mean
/// of the light's samples, without a bias.
///
/// Chapter: stages/book/src/part3/task3.md
///
/// A light with an area gets `ns_area_light` samples (the flag `-l`). A delta light
/// ([`Emitter::is_delta`](kit::Emitter::is_delta)) gets a single one, because all its samples are
/// equal. [`Emitter::sample`](kit::Emitter::sample) samples a direction from [`Surface::p`] and
/// returns the radiance `L` of the unblocked light. `occluded` returns whether the ray of
/// [`Surface::shadow_ray`] is blocked. `wo` is the unit world direction to the viewer; `scattering`
/// evaluates `f` for directions in the local space of `surface.frame`. Each sample uses one
/// `next_2d` of the sampler. The order of the samples does not matter.
///
/// A sample without light (`None`) or without scattering (`f` black) counts as 0 in the mean, and
/// no shadow ray is traced for it. Mirrors and smooth glass
/// ([`Material::is_delta`](kit::Material::is_delta)) trace none at all; rough glass is lit like a
/// diffuse surface. With `ns_area_light` 0, lights with an area contribute nothing. The emission of
/// `surface` itself is no direct light.
///
/// See it: `cargo grader picture part3.task3`.
pub fn estimate_direct_lighting_importance(
    lit: &LitScene,
    surface: &Surface,
    wo: Vec3,
    ns_area_light: u32,
    sampler: &mut PixelSampler,
    scattering: &impl Scattering,
    occluded: &mut impl FnMut(&Ray) -> bool,
) -> Spectrum {
    // BEGIN SOLUTION(part3.task3)
    if surface.material.is_delta() {
        return Spectrum::BLACK;
    }
    let local_wo = surface.frame.to_local(wo);
    let mut direct = Spectrum::BLACK;
    for emitter in &lit.emitters {
        let samples = if emitter.is_delta() { 1 } else { ns_area_light };
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
            sum += f * light.radiance * (wi.z.abs() / light.pdf);
        }
        direct += sum / f64::from(samples.max(1));
    }
    direct
    // STUB: kit::hole!("part3.task3", lit, surface, wo, ns_area_light, sampler, scattering, occluded)
    // END SOLUTION(part3.task3)
}
