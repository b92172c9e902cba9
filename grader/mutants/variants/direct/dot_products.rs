//! Cosines from dot products in world space, and lights summed one by one with a weight each.

pub use base::*;
use kit::{BsdfSample, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec2, Vec3};
use std::f64::consts::PI;

pub fn lambert_f(reflectance: Spectrum, wo: Vec3, wi: Vec3) -> Spectrum {
    let n = Vec3::Z;
    let same_side = (wo.dot(n) > 0.0 && wi.dot(n) > 0.0) || (wo.dot(n) < 0.0 && wi.dot(n) < 0.0);
    if same_side { reflectance / PI } else { Spectrum::BLACK }
}

pub fn lambert_pdf(wo: Vec3, wi: Vec3) -> f64 {
    (wi.z * wo.z.signum() / PI).max(0.0) * if wo.z == 0.0 { 0.0 } else { 1.0 }
}

/// The textbook's way, by the angle to the normal.
pub fn lambert_sample(reflectance: Spectrum, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
    if wo.z == 0.0 {
        return None;
    }
    let (theta, phi) = (u.x.sqrt().acos(), 2.0 * PI * u.y);
    let wi = Vec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos() * wo.z.signum());
    Some(BsdfSample { wi, f: reflectance / PI, pdf: theta.cos() / PI, delta: false })
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
    let mut light = Spectrum::BLACK;
    for emitter in &lit.emitters {
        let n = if emitter.is_delta() { 1 } else { ns_area_light };
        for _ in 0..n {
            if let Some(sample) = emitter.sample(surface.p, sampler.next_2d()) {
                let cosine = sample.wi.dot(surface.frame.n).abs();
                let f = scattering.f(surface.material, surface.frame.to_local(wo), surface.frame.to_local(sample.wi));
                if !f.is_black() && !occluded(&surface.shadow_ray(&sample)) {
                    light += f * sample.radiance * cosine / sample.pdf / f64::from(n);
                }
            }
        }
    }
    light
}
