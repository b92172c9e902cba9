//! Matte samples from a point of the unit sphere around the tip of the normal; uniform ones with
//! the azimuth first.

pub use base::*;
use kit::{
    BsdfSample, Hit, LitScene, Material, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec2, Vec3, warp,
};
use std::f64::consts::PI;

pub fn lambert_sample(reflectance: Spectrum, wo: Vec3, u: Vec2) -> Option<BsdfSample> {
    if wo.z == 0.0 {
        return None;
    }
    let up = (Vec3::Z + warp::uniform_sphere(u)).normalize();
    let wi = if wo.z > 0.0 { up } else { -up };
    Some(BsdfSample { wi, f: lambert_f(reflectance, wo, wi), pdf: lambert_pdf(wo, wi), delta: false })
}

pub fn zero_bounce_radiance(surface: &Surface, wo: Vec3) -> Spectrum {
    match surface.material {
        Material::Emission { radiance } if surface.ng.dot(wo) > 0.0 => *radiance,
        _ => Spectrum::BLACK,
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
    if matches!(surface.material, Material::Mirror { .. } | Material::Glass { .. } | Material::Refraction { .. }) {
        return Spectrum::BLACK;
    }
    let viewer = surface.frame.to_local(wo);
    let side = viewer.z.signum();
    let weight = 2.0 * PI / f64::from(samples);
    let mut light = Spectrum::BLACK;
    for _ in 0..samples {
        let u = sampler.next_2d();
        let wi = side * warp::uniform_hemisphere(Vec2::new(u.y, u.x));
        let ray = surface.leave(surface.frame.to_world(wi));
        let seen = trace(&ray).map_or_else(|| lit.background(ray.d), |hit| lit.surface(&hit).emitted(-ray.d));
        light += scattering.f(surface.material, viewer, wi) * seen * (weight * wi.z.abs());
    }
    light
}
