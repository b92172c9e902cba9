//! Each sample weighted by 1/n as it comes, two numbers drawn one by one.

pub use base::*;
use kit::{FilmSize, PixelEstimate, PixelSampler, Ray, Spectrum, Vec2};

pub fn raytrace_pixel(
    x: u32,
    y: u32,
    film: FilmSize,
    ns_aa: u32,
    sampler: &mut PixelSampler,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
) -> PixelEstimate {
    let weight = 1.0 / f64::from(ns_aa.max(1));
    let size = [f64::from(film.w), f64::from(film.h)];
    let mut radiance = Spectrum::BLACK;
    let mut samples = 0;
    while samples < ns_aa {
        let offset = match ns_aa {
            1 => Vec2::new(0.5, 0.5),
            _ => Vec2::new(sampler.next_1d(), sampler.next_1d()),
        };
        let ray = camera_ray(Vec2::new((f64::from(x) + offset.x) / size[0], (f64::from(y) + offset.y) / size[1]));
        radiance += trace_ray(&ray, sampler) * weight;
        samples += 1;
    }
    PixelEstimate { radiance, samples }
}
