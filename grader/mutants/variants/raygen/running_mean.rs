//! The mean kept up to date sample by sample.

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
    let mut mean = Spectrum::BLACK;
    for i in 0..ns_aa {
        let s = if ns_aa == 1 { Vec2::splat(0.5) } else { sampler.get_sample() };
        let u = (f64::from(x) + s.x) / f64::from(film.w);
        let v = (f64::from(y) + s.y) / f64::from(film.h);
        let radiance = trace_ray(&camera_ray(Vec2::new(u, v)), sampler);
        mean += (radiance - mean) / f64::from(i + 1);
    }
    PixelEstimate { radiance: mean, samples: ns_aa }
}
