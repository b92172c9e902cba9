//! Draws all samples of all lights, then asks for their shadows from the last to the first.

pub use base::*;
use kit::{BsdfSample, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec2, Vec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// Shirley and Chiu's concentric map of the square to the disk.
pub fn lambert_sample(reflectance: Spectrum, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
    let (a, b) = (2.0 * u.x - 1.0, 2.0 * u.y - 1.0);
    if wo.z == 0.0 {
        return None;
    }
    let (r, turn) = if a * a > b * b {
        (a, FRAC_PI_4 * (b / a))
    } else if b != 0.0 {
        (b, FRAC_PI_2 - FRAC_PI_4 * (a / b))
    } else {
        (0.0, 0.0)
    };
    let height = (1.0 - r * r).max(0.0).sqrt();
    let wi = Vec3::new(r * turn.cos(), r * turn.sin(), height * wo.z.signum());
    Some(BsdfSample { wi, f: reflectance / PI, pdf: height / PI, delta: false })
}

pub fn estimate_direct_lighting_importance(
    lit: &LitScene,
    surface: &Surface,
    wo: Vec3,
    ns_area_light: u32,
    sampler: &mut PixelSampler,
    scattering: &impl Scattering,
    occluded: &mut impl FnMut(&Ray) -> bool,
) -> Spectrum {
    let viewer = surface.frame.to_local(wo);
    let mut drawn = Vec::new();
    for emitter in lit.emitters.iter().rev() {
        let n = if emitter.is_delta() { 1 } else { ns_area_light };
        for _ in 0..n {
            drawn.extend(emitter.sample(surface.p, sampler.next_2d()).map(|light| (light, 1.0 / f64::from(n))));
        }
    }
    drawn
        .iter()
        .rev()
        .map(|(light, share)| {
            let wi = surface.frame.to_local(light.wi);
            let f = scattering.f(surface.material, viewer, wi);
            let dark = f == Spectrum::BLACK || occluded(&surface.shadow_ray(light));
            if dark { Spectrum::BLACK } else { f * light.radiance * (wi.z.abs() * share / light.pdf) }
        })
        .sum()
}
