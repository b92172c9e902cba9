//! A Kronecker sequence of the plastic number, moved around the pixel by one random shift.

pub use base::*;
use kit::{FilmSize, PixelEstimate, PixelSampler, Ray, Spectrum, Vec2};

const STEP: Vec2 = Vec2::new(0.754_877_666_246_692_8, 0.569_840_290_998_053_3);

pub fn raytrace_pixel(
    x: u32,
    y: u32,
    film: FilmSize,
    ns_aa: u32,
    sampler: &mut PixelSampler,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
) -> PixelEstimate {
    let corner = Vec2::new(f64::from(x), f64::from(y));
    let size = Vec2::new(f64::from(film.w), f64::from(film.h));
    let shift = sampler.get_sample();
    let mut sum = Spectrum::BLACK;
    for i in 0..ns_aa {
        let place = if ns_aa == 1 { Vec2::splat(0.5) } else { (shift + f64::from(i) * STEP).fract() };
        sum += trace_ray(&camera_ray((corner + place) / size), sampler);
    }
    PixelEstimate { radiance: sum / f64::from(ns_aa), samples: ns_aa }
}
