//! A jittered grid of as many cells as fit, the rest at random.

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
    if ns_aa == 1 {
        let center = Vec2::new((f64::from(x) + 0.5) / f64::from(film.w), (f64::from(y) + 0.5) / f64::from(film.h));
        return PixelEstimate { radiance: trace_ray(&camera_ray(center), sampler), samples: 1 };
    }
    let side = f64::from(ns_aa).sqrt().floor() as u32;
    let mut sum = Spectrum::BLACK;
    for i in 0..ns_aa {
        let mut s = sampler.get_sample();
        if i < side * side {
            s = (s + Vec2::new(f64::from(i % side), f64::from(i / side))) / f64::from(side);
        }
        let place = Vec2::new(f64::from(x) + s.x, f64::from(y) + s.y);
        let ray = camera_ray(place / Vec2::new(f64::from(film.w), f64::from(film.h)));
        sum += trace_ray(&ray, sampler);
    }
    PixelEstimate { radiance: sum / f64::from(ns_aa), samples: ns_aa }
}
