//! Uniform directions by rejection, with as many numbers as it takes; a running mean instead of a
//! sum; the shadow last.

pub use base::*;
use kit::{Hit, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

pub fn zero_bounce_radiance(surface: &Surface, wo: Vec3) -> Spectrum {
    let light = surface.material.emission();
    if surface.ng.dot(wo) <= 0.0 { Spectrum::BLACK } else { light }
}

/// A point of the cube that lies inside the ball, and not at its centre, is uniform in direction.
fn in_the_ball(sampler: &mut PixelSampler) -> Vec3 {
    loop {
        let (xy, z) = (sampler.next_2d(), sampler.next_1d());
        let point = Vec3::new(2.0 * xy.x - 1.0, 2.0 * xy.y - 1.0, 2.0 * z - 1.0);
        let length2 = point.length_squared();
        if length2 <= 1.0 && length2 > 1e-6 {
            return point / length2.sqrt();
        }
    }
}

pub fn estimate_direct_lighting_hemisphere(
    lit: &LitScene,
    surface: &Surface,
    wo: Vec3,
    samples: u32,
    sampler: &mut PixelSampler,
    scattering: &impl Scattering,
    trace: &mut impl FnMut(&Ray) -> Option<Hit>,
) -> Spectrum {
    let mut mean = Spectrum::BLACK;
    if surface.material.is_delta() {
        return mean;
    }
    let n = surface.frame.n;
    for i in 1..=samples {
        let mut d = in_the_ball(sampler);
        if d.dot(n) * wo.dot(n) < 0.0 {
            d = -d;
        }
        let (local_wo, local_wi) = (surface.frame.to_local(wo), surface.frame.to_local(d));
        let f = scattering.f(surface.material, local_wo, local_wi);
        let radiance = match trace(&surface.leave(d)) {
            None => lit.background(d),
            Some(hit) => lit.surface(&hit).emitted(-d),
        };
        let light = f * radiance * (std::f64::consts::TAU * d.dot(n).abs());
        mean += (light - mean) / f64::from(i);
    }
    mean
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
    let local_wo = surface.frame.to_local(wo);
    let mut light = Spectrum::BLACK;
    for emitter in &lit.emitters {
        let mut mean = Spectrum::BLACK;
        let n = if emitter.is_delta() { 1 } else { ns_area_light };
        for i in 1..=n {
            let mut brings = Spectrum::BLACK;
            if let Some(sample) = emitter.sample(surface.p, sampler.next_2d()) {
                let local_wi = surface.frame.to_local(sample.wi);
                brings = scattering.f(surface.material, local_wo, local_wi) * sample.radiance;
                brings = brings * (local_wi.z.abs() / sample.pdf);
                if brings.max_channel() > 0.0 && occluded(&surface.shadow_ray(&sample)) {
                    brings = Spectrum::BLACK;
                }
            }
            mean += (brings - mean) / f64::from(i);
        }
        light += mean;
    }
    light
}
