//! The plain loop over lights and samples, with early exits.

pub use base::*;
use kit::{LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

pub fn estimate_direct_lighting_importance(
    lit: &LitScene,
    surface: &Surface,
    wo: Vec3,
    ns_area_light: u32,
    sampler: &mut PixelSampler,
    scattering: &impl Scattering,
    occluded: &mut impl FnMut(&Ray) -> bool,
) -> Spectrum {
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
}
