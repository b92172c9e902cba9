//! Part 3, task 3: direct light by looking at the lights.

use kit::{LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

/// Direct light by sampling every light: the sum over [`LitScene::emitters`] of the mean of `f · L · |cos θi| / pdf`.
///
/// A light with an extent gets `ns_area_light` samples (the flag `-l`), a light without one
/// ([`Emitter::is_delta`](kit::Emitter::is_delta)) a single one, since every further one would be the same.
/// [`Emitter::sample`](kit::Emitter::sample) draws a direction from [`Surface::p`] and gives the radiance `L` as if
/// nothing were in between; `occluded` says whether something is, for the ray that [`Surface::shadow_ray`] makes. `wo`
/// is the unit world direction to the viewer; `scattering` gives `f` of directions in the local space of `surface.frame`.
/// Each sample takes one `next_2d` of the sampler. In which order samples are taken makes no difference.
///
/// A sample that the light does not send (`None`) or the surface does not scatter (`f` black) counts as 0 in the mean,
/// and no shadow ray is cast for it. Mirrors and smooth glass ([`Material::is_delta`](kit::Material::is_delta)) cast none
/// at all; rough glass is lit like a matte surface. With `ns_area_light` 0, lights with an extent give nothing.
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
