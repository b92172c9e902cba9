//! Cook and Torrance's form of Fresnel's equations; a path that stores the next ray and the number
//! of surfaces that it left.

pub use base::*;
use kit::{Hit, LitScene, PixelSampler, Ray, Scattering, Spectrum, Surface, Vec3};

pub fn fresnel_dielectric(cos_i: f64, eta: f64) -> f64 {
    let n = 1.0 / eta;
    let g2 = n * n - 1.0 + cos_i * cos_i;
    if g2 <= 0.0 || cos_i == 0.0 {
        return 1.0;
    }
    let (g, c) = (g2.sqrt(), cos_i);
    let a = (g - c) / (g + c);
    let b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    0.5 * a * a * (1.0 + b * b)
}

pub fn refract(wo: Vec3, ior: f64) -> Option<Vec3> {
    let eta = if wo.z > 0.0 { 1.0 / ior } else { ior };
    let (x, y) = (-eta * wo.x, -eta * wo.y);
    let left = 1.0 - x * x - y * y;
    (left > 0.0 && wo.z != 0.0).then(|| Vec3::new(x, y, -wo.z.signum() * left.sqrt()))
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
    let (mut sum, mut weight, mut left, mut sees) = (Spectrum::BLACK, Spectrum::WHITE, 0, true);
    let mut next = Some(*ray);
    while let Some(ray) = next.take() {
        match trace(&ray) {
            None if sees => sum += lit.background(ray.d) * weight,
            None => {}
            Some(hit) => {
                let here = lit.surface(&hit);
                if sees {
                    sum += here.emitted(-ray.d) * weight;
                }
                if max_depth >= 1 && !here.material.is_delta() {
                    sum += direct(&here, -ray.d, sampler) * weight;
                }
                left += 1;
                if left < max_depth {
                    let (u, choice) = (sampler.next_2d(), sampler.next_1d());
                    let drawn = scattering.sample(here.material, here.frame.to_local(-ray.d), u, choice);
                    let lives = drawn.and_then(|drawn| {
                        Some((drawn, roulette(drawn.weight() * weight, left, sampler.next_1d())?))
                    });
                    if let Some((drawn, survivor)) = lives {
                        (weight, sees) = (survivor, drawn.delta);
                        next = Some(here.leave(here.frame.to_world(drawn.wi)));
                    }
                }
            }
        }
    }
    sum
}
