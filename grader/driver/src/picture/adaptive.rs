//! The pictures of Part 5.

use super::given_light::Lamps;
use super::{Eye, Panel, two_panels};
use crate::panels;
use crate::stages::Adaptive;
use kit::{
    Budget, FilmSize, Material, PixelEstimate, PixelSampler, Ray, Spectrum, Tally, Vec2, Vec3, math,
};
use wire::light::LitWorld;
use wire::picture::{GivenScattering, View};

/// The budget of a pixel.
pub(super) fn budget(ns_aa: u32, batch: u32, tolerance: f64) -> Budget {
    Budget {
        ns_aa,
        batch,
        tolerance,
    }
}

/// A world of rectangles under a large lamp, and its sampling rate.
pub(super) fn lamp(
    stage: &Adaptive,
    size: [u32; 2],
    world: &LitWorld,
    view: &View,
    budget: Budget,
    scattering: GivenScattering,
) -> Vec<Panel> {
    let lit = panels::lit_scene(world);
    let lamps = Lamps::of(world);
    let eye = Eye::new(view);
    let [w, h] = size.map(f64::from);
    picture(
        stage,
        size,
        budget,
        &mut |point| eye.ray(point.x * w, point.y * h),
        &mut |ray, sampler| {
            let Some(hit) = panels::first_hit(world, ray) else {
                return lit.background(ray.d);
            };
            let (surface, wo) = (lit.surface(&hit), -ray.d);
            match surface.material {
                Material::Diffuse { reflectance } => {
                    *reflectance * scattering.white * lamps.irradiance(&surface, wo, sampler)
                }
                _ => surface.emitted(wo),
            }
        },
        &mut { stage.has_converged },
    )
}

/// Light on a ball that each sample finds with a probability from 1 (right) down to 0.005 (left),
/// and the sampling rate.
pub(super) fn rare_light(stage: &Adaptive, size: [u32; 2], budget: Budget) -> Vec<Panel> {
    picture(
        stage,
        size,
        budget,
        &mut |point| Ray::new(Vec3::new(point.x, point.y, 1.0), Vec3::NEG_Z),
        &mut |ray, sampler| {
            let probability = math::pow(200.0, ray.o.x - 1.0);
            match sampler.next_1d() < probability {
                true => brightness(Vec2::new(ray.o.x, ray.o.y)) / probability,
                false => Spectrum::BLACK,
            }
        },
        &mut |samples, tolerance| {
            (stage.has_surely_converged)(samples, tolerance, &mut { stage.has_converged })
        },
    )
}

/// A row of three balls on a black ground, lit from the top left.
fn brightness(point: Vec2) -> Spectrum {
    let place = Vec2::new((3.0 * point.x).fract() - 0.5, 0.75 * 3.0 * (point.y - 0.5)) / 0.42;
    let height2 = 1.0 - place.length_squared();
    if height2 <= 0.0 {
        return Spectrum::BLACK;
    }
    let n = place.extend(height2.sqrt());
    let lit = n.dot(Vec3::new(-0.48, 0.64, 0.6)).max(0.0);
    Spectrum::new(0.5, 0.42, 0.3) * (0.15 + 0.85 * lit)
}

/// The radiance of each pixel, and its sampling rate.
fn picture(
    stage: &Adaptive,
    size: [u32; 2],
    budget: Budget,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
    rule: &mut impl FnMut(&Tally, f64) -> bool,
) -> Vec<Panel> {
    let film = FilmSize {
        w: size[0],
        h: size[1],
    };
    two_panels(size, |x, y| {
        let mut sampler = PixelSampler::new(x, y, 0);
        let PixelEstimate { radiance, samples } = (stage.raytrace_pixel_adaptive)(
            (x, y),
            film,
            budget,
            &mut sampler,
            camera_ray,
            trace_ray,
            rule,
        );
        let rate = (stage.rate_colour)(samples, budget.ns_aa);
        [radiance.to_array(), rate.to_array()]
    })
}
