//! Refraction by angles and the azimuth, with the functions of trigonometry; roulette by its chance
//! to end.

pub use base::*;
use kit::{BsdfSample, Spectrum, Vec3};
use std::f64::consts::PI;

/// By angles: sin² and tan² of their difference over those of their sum; at normal incidence their
/// limit.
pub fn fresnel_dielectric(cos_i: f64, eta: f64) -> f64 {
    let theta_i = cos_i.min(1.0).acos();
    let sin_t = eta * theta_i.sin();
    if sin_t >= 1.0 {
        return 1.0;
    }
    let theta_t = sin_t.asin();
    let (minus, plus) = (theta_i - theta_t, theta_i + theta_t);
    if plus < 1e-5 {
        let r = (1.0 - eta) / (1.0 + eta);
        return r * r;
    }
    let s = minus.sin() / plus.sin();
    let p = minus.tan() / plus.tan();
    0.5 * (s * s + p * p)
}

pub fn reflect(wo: Vec3) -> Vec3 {
    let along = wo.z * Vec3::Z;
    let across = wo - along;
    along - across
}

pub fn refract(wo: Vec3, ior: f64) -> Option<Vec3> {
    let across = (wo.x * wo.x + wo.y * wo.y).sqrt();
    let sine = if wo.z > 0.0 { across / ior } else { across * ior };
    if wo.z == 0.0 || sine >= 1.0 {
        return None;
    }
    let (phi, theta) = (wo.y.atan2(wo.x) + PI, sine.asin());
    let height = if wo.z > 0.0 { -theta.cos() } else { theta.cos() };
    Some(Vec3::new(sine * phi.cos(), sine * phi.sin(), height))
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
    let wi = refract(wo, ior);
    let eta = if wo.z > 0.0 { 1.0 / ior } else { ior };
    let reflected = match wi {
        Some(_) => fresnel_dielectric(wo.z.abs(), eta),
        None => 1.0,
    };
    if choice >= reflected {
        let wi = wi?;
        let pdf = 1.0 - reflected;
        let f = transmittance * pdf * eta * eta / wi.z.abs();
        return Some(BsdfSample { wi, f, pdf, delta: true });
    }
    let f = reflectance * reflected / wo.z.abs();
    Some(BsdfSample { wi: reflect(wo), f, pdf: reflected, delta: true })
}

pub fn play_roulette(throughput: Spectrum, bounces: u32, u: f64) -> Option<Spectrum> {
    let brightest = throughput.max_channel();
    if brightest <= 0.0 {
        return None;
    }
    let ends = if bounces < 4 { 0.0 } else { 1.0 - brightest.min(1.0) };
    let lives = 1.0 - ends;
    if u < lives { Some(throughput * (1.0 / lives)) } else { None }
}
