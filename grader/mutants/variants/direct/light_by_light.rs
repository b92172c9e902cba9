//! The outer loop is over samples, the inner loop over lights; the sum of each light is divided at
//! the end. Directions are computed from angles, all of them before the first ray is traced.

pub use base::*;
use kit::{BsdfSample, Hit, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec2, Vec3};
use std::f64::consts::PI;

pub fn lambert_f(reflectance: Spectrum, wo: Vec3, wi: Vec3) -> Spectrum {
    if wo.z == 0.0 || wi.z == 0.0 || (wo.z < 0.0) != (wi.z < 0.0) {
        return Spectrum::BLACK;
    }
    (1.0 / PI) * reflectance
}

pub fn lambert_pdf(wo: Vec3, wi: Vec3) -> f64 {
    if wo.z > 0.0 && wi.z > 0.0 {
        return wi.z / PI;
    }
    if wo.z < 0.0 && wi.z < 0.0 {
        return -wi.z / PI;
    }
    0.0
}

/// Malley's method with the numbers the other way round.
pub fn lambert_sample(reflectance: Spectrum, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
    let turn = 2.0 * PI * u.x;
    let radius = u.y.sqrt();
    let (x, y) = (radius * turn.cos(), radius * turn.sin());
    let mut wi = Vec3::new(x, y, (1.0 - radius * radius).max(0.0).sqrt());
    if wo.z < 0.0 {
        wi.z = -wi.z;
    }
    let pdf = lambert_pdf(wo, wi);
    let f = lambert_f(reflectance, wo, wi);
    if pdf > 0.0 { Some(BsdfSample { wi, f, pdf, delta: false }) } else { None }
}

pub fn zero_bounce_radiance(surface: &Surface, wo: Vec3) -> Spectrum {
    let is_front = wo.dot(surface.ng) > 0.0;
    if is_front { surface.material.emission() } else { Spectrum::BLACK }
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
    if surface.material.is_delta() {
        return Spectrum::BLACK;
    }
    let frame = surface.frame;
    let viewer = frame.to_local(wo);
    let drawn: Vec<Vec3> = (0..samples)
        .map(|_| {
            let u = sampler.next_2d();
            let (theta, phi) = (u.x.acos(), 2.0 * PI * u.y);
            let up = Vec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
            if viewer.z < 0.0 { -up } else { up }
        })
        .collect();
    let pdf = 1.0 / (2.0 * PI);
    let mut total = Spectrum::BLACK;
    for wi in drawn {
        let d = (frame.s * wi.x + frame.t * wi.y + frame.n * wi.z).normalize();
        let seen = if let Some(hit) = trace(&surface.leave(d)) {
            let there = lit.surface(&hit);
            zero_bounce_radiance(&there, -d)
        } else {
            lit.background(d)
        };
        let cosine = wi.z.abs();
        total += scattering.f(surface.material, viewer, wi) * seen * cosine / pdf;
    }
    if samples == 0 { total } else { total / f64::from(samples) }
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
    let mut of_lights = vec![Spectrum::BLACK; lit.emitters.len()];
    let viewer = surface.frame.to_local(wo);
    for i in 0..ns_area_light.max(1) {
        for (emitter, sum) in lit.emitters.iter().zip(&mut of_lights) {
            let wanted = if emitter.is_delta() { 1 } else { ns_area_light };
            if i >= wanted {
                continue;
            }
            let u = sampler.next_2d();
            if let Some(light) = emitter.sample(surface.p, u) {
                let wi = surface.frame.to_local(light.wi);
                let arrives = scattering.f(surface.material, viewer, wi) * light.radiance * wi.z.abs();
                if !arrives.is_black() && !occluded(&surface.shadow_ray(&light)) {
                    *sum += arrives / light.pdf;
                }
            }
        }
    }
    let mut all = Spectrum::BLACK;
    for (emitter, sum) in lit.emitters.iter().zip(of_lights) {
        let divisor = if emitter.is_delta() { 1 } else { ns_area_light };
        if divisor > 0 {
            all += sum / f64::from(divisor);
        }
    }
    all
}
