//! Glass by angles, paths by recursion, roulette by comparing u · 1 with the largest channel.

pub use base::*;
use kit::{BsdfSample, Hit, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

/// Fresnel's equations by the sines and tangents of both angles.
pub fn fresnel_dielectric(cos_i: f64, eta: f64) -> f64 {
    let sin_t = eta * (1.0 - cos_i * cos_i).max(0.0).sqrt();
    if sin_t >= 1.0 || cos_i == 0.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin_t * sin_t).sqrt();
    let n = 1.0 / eta;
    let s = (cos_i - n * cos_t) / (cos_i + n * cos_t);
    let p = (n * cos_i - cos_t) / (n * cos_i + cos_t);
    (s * s + p * p) / 2.0
}

pub fn reflect(wo: Vec3) -> Vec3 {
    2.0 * wo.z * Vec3::Z - wo
}

pub fn refract(wo: Vec3, ior: f64) -> Option<Vec3> {
    let (n, eta) = if wo.z > 0.0 { (Vec3::Z, 1.0 / ior) } else { (-Vec3::Z, ior) };
    let cos = wo.dot(n);
    let sin2 = eta * eta * (1.0 - cos * cos).max(0.0);
    if sin2 >= 1.0 || cos == 0.0 {
        return None;
    }
    Some(-eta * wo + (eta * cos - (1.0 - sin2).sqrt()) * n)
}

pub fn mirror_sample(reflectance: Spectrum, wo: Vec3) -> Option<BsdfSample> {
    if wo.z == 0.0 {
        return None;
    }
    Some(BsdfSample { wi: reflect(wo), f: reflectance / wo.z.abs(), pdf: 1.0, delta: true })
}

pub fn refraction_sample(transmittance: Spectrum, ior: f64, wo: Vec3) -> Option<BsdfSample> {
    let wi = refract(wo, ior)?;
    let eta = if wo.z > 0.0 { 1.0 / ior } else { ior };
    Some(BsdfSample { wi, f: eta * eta * transmittance / wi.z.abs(), pdf: 1.0, delta: true })
}

pub fn glass_sample(
    reflectance: Spectrum,
    transmittance: Spectrum,
    ior: f64,
    wo: Vec3,
    choice: f64,
) -> Option<BsdfSample> {
    if wo.z == 0.0 {
        return None;
    }
    let eta = if wo.z > 0.0 { 1.0 / ior } else { ior };
    let share = fresnel_dielectric(wo.z.abs(), eta);
    if choice < share {
        let f = share * reflectance / wo.z.abs();
        return Some(BsdfSample { wi: reflect(wo), f, pdf: share, delta: true });
    }
    let wi = refract(wo, ior)?;
    let f = transmittance * ((1.0 - share) * eta * eta / wi.z.abs());
    Some(BsdfSample { wi, f, pdf: 1.0 - share, delta: true })
}

pub fn estimate_radiance(
    lit: &LitScene,
    ray: &Ray,
    max_depth: u32,
    sampler: &mut PixelSampler,
    scattering: &impl Scattering,
    trace: &mut impl FnMut(&Ray) -> Option<Hit>,
    direct: &mut impl FnMut(&Surface, Vec3, &mut PixelSampler) -> Spectrum,
    roulette: &mut impl FnMut(Spectrum, u32, f64) -> Option<Spectrum>,
) -> Spectrum {
    along(lit, *ray, max_depth, 1, Spectrum::WHITE, true, sampler, scattering, trace, direct, roulette)
}

fn along(
    lit: &LitScene,
    ray: Ray,
    depth: u32,
    number: u32,
    weight: Spectrum,
    seen: bool,
    sampler: &mut PixelSampler,
    scattering: &impl Scattering,
    trace: &mut impl FnMut(&Ray) -> Option<Hit>,
    direct: &mut impl FnMut(&Surface, Vec3, &mut PixelSampler) -> Spectrum,
    roulette: &mut impl FnMut(Spectrum, u32, f64) -> Option<Spectrum>,
) -> Spectrum {
    let Some(hit) = trace(&ray) else {
        return if seen { weight * lit.background(ray.d) } else { Spectrum::BLACK };
    };
    let surface = lit.surface(&hit);
    let mut light = if seen { weight * surface.emitted(-ray.d) } else { Spectrum::BLACK };
    if depth == 0 {
        return light;
    }
    if !surface.material.is_delta() {
        light += weight * direct(&surface, -ray.d, sampler);
    }
    if number >= depth {
        return light;
    }
    let u = sampler.next_2d();
    let choice = sampler.next_1d();
    if let Some(s) = scattering.sample(surface.material, surface.frame.to_local(-ray.d), u, choice) {
        if let Some(weight) = roulette(weight * s.f * (s.wi.z.abs() / s.pdf), number, sampler.next_1d()) {
            let next = surface.leave(surface.frame.to_world(s.wi));
            light += along(lit, next, depth, number + 1, weight, s.delta, sampler, scattering, trace, direct, roulette);
        }
    }
    light
}

pub fn play_roulette(throughput: Spectrum, bounces: u32, u: f64) -> Option<Spectrum> {
    let brightest = throughput.r.max(throughput.g).max(throughput.b);
    match bounces {
        _ if brightest == 0.0 => None,
        0..=3 => Some(throughput),
        _ if brightest >= 1.0 => Some(throughput),
        _ if u < brightest => Some(throughput * (1.0 / brightest)),
        _ => None,
    }
}
