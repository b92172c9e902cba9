//! All places first, then all rays, last one first.

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
    let places: Vec<Vec2> = (0..ns_aa).map(|_| if ns_aa == 1 { Vec2::splat(0.5) } else { sampler.get_sample() }).collect();
    let pixel = Vec2::new(f64::from(x), f64::from(y));
    let size = Vec2::new(f64::from(film.w), f64::from(film.h));
    let total: Spectrum = places.iter().rev().map(|place| trace_ray(&camera_ray((pixel + *place) / size), sampler)).sum();
    PixelEstimate { radiance: total / f64::from(ns_aa.max(1)), samples: ns_aa }
}
