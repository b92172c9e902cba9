//! Incident directions and a normal turned towards them, as books on graphics have it; light
//! gathered on the way back.

pub use base::*;
use kit::{BsdfSample, Hit, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

/// By both indices and both cosines.
pub fn fresnel_dielectric(cos_i: f64, eta: f64) -> f64 {
    let (n1, n2) = (eta, 1.0);
    let sin2_t = (n1 / n2) * (n1 / n2) * (1.0 - cos_i * cos_i);
    if sin2_t >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin2_t).max(0.0).sqrt();
    let rs = (n1 * cos_i - n2 * cos_t) / (n1 * cos_i + n2 * cos_t);
    let rp = (n2 * cos_i - n1 * cos_t) / (n2 * cos_i + n1 * cos_t);
    (rs.powi(2) + rp.powi(2)) * 0.5
}

/// I - 2 (N·I) N, of the direction in which the viewer's ray came.
pub fn reflect(wo: Vec3) -> Vec3 {
    let (i, n) = (-wo, Vec3::Z);
    i - 2.0 * n.dot(i) * n
}

/// The function of the shading languages.
pub fn refract(wo: Vec3, ior: f64) -> Option<Vec3> {
    if wo.z == 0.0 {
        return None;
    }
    let entering = wo.z > 0.0;
    let n = if entering { Vec3::Z } else { Vec3::NEG_Z };
    let eta = if entering { 1.0 / ior } else { ior };
    let i = -wo;
    let k = 1.0 - eta * eta * (1.0 - n.dot(i) * n.dot(i));
    if k <= 0.0 {
        return None;
    }
    Some(eta * i - (eta * n.dot(i) + k.sqrt()) * n)
}

pub fn mirror_sample(reflectance: Spectrum, wo: Vec3) -> Option<BsdfSample> {
    let wi = reflect(wo);
    let cosine = wi.dot(Vec3::Z).abs();
    if cosine > 0.0 {
        let f = reflectance * (1.0 / cosine);
        return Some(BsdfSample { wi, f, pdf: 1.0, delta: true });
    }
    None
}

pub fn refraction_sample(transmittance: Spectrum, ior: f64, wo: Vec3) -> Option<BsdfSample> {
    refract(wo, ior).map(|wi| {
        // sin θi / sin θo = 1 / η: radiance goes with the square of the index.
        let squeeze = if wo.z > 0.0 { 1.0 / (ior * ior) } else { ior * ior };
        BsdfSample { wi, f: squeeze * transmittance / wi.z.abs(), pdf: 1.0, delta: true }
    })
}

pub fn glass_sample(
    reflectance: Spectrum,
    transmittance: Spectrum,
    ior: f64,
    wo: Vec3,
    choice: f64,
) -> Option<BsdfSample> {
    let eta = if wo.z > 0.0 { 1.0 / ior } else { ior };
    let mirrored = mirror_sample(reflectance, wo)?;
    let Some(passed) = refraction_sample(transmittance, ior, wo) else {
        return Some(mirrored);
    };
    let share = fresnel_dielectric(wo.z.abs(), eta);
    let (mut chosen, chance) = if choice < share { (mirrored, share) } else { (passed, 1.0 - share) };
    chosen.f = chosen.f * chance;
    chosen.pdf = chance;
    Some(chosen)
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
    let mut found: Vec<(Spectrum, Spectrum)> = Vec::new();
    let (mut next, mut carries, mut after_mirror) = (*ray, Spectrum::new(1.0, 1.0, 1.0), true);
    let mut bounces = 0;
    loop {
        let Some(hit) = trace(&next) else {
            if after_mirror {
                found.push((carries, lit.background(next.d)));
            }
            break;
        };
        let here = lit.surface(&hit);
        let back = -next.d;
        if after_mirror {
            found.push((carries, here.emitted(back)));
        }
        if max_depth != 0 && !here.material.is_delta() {
            found.push((carries, direct(&here, back, sampler)));
        }
        bounces += 1;
        if bounces >= max_depth {
            break;
        }
        let place = sampler.next_2d();
        let side = sampler.next_1d();
        let Some(s) = scattering.sample(here.material, here.frame.to_local(back), place, side) else { break };
        let share = s.f * s.wi.z.abs() / s.pdf;
        match roulette(carries * share, bounces, sampler.next_1d()) {
            Some(survivor) => carries = survivor,
            None => break,
        }
        after_mirror = s.delta;
        next = here.leave(here.frame.to_world(s.wi));
    }
    found.into_iter().rev().map(|(weight, light)| weight * light).sum()
}

pub fn play_roulette(throughput: Spectrum, bounces: u32, u: f64) -> Option<Spectrum> {
    let q = throughput.r.max(throughput.g.max(throughput.b)).clamp(0.0, 1.0);
    if q == 0.0 {
        return None;
    }
    if bounces > 3 {
        if u >= q {
            return None;
        }
        return Some(throughput / q);
    }
    Some(throughput)
}
