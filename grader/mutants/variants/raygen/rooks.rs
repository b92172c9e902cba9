//! As many columns as rows as samples, one sample in each (n rooks, Latin hypercube).

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
    let n = f64::from(ns_aa);
    let mut rows: Vec<f64> = (0..ns_aa).map(f64::from).collect();
    for i in (1..rows.len()).rev() {
        let other = (sampler.next_1d() * (i + 1) as f64) as usize;
        rows.swap(i, other.min(i));
    }
    let mut total = Spectrum::BLACK;
    for (column, row) in rows.into_iter().enumerate() {
        let jitter = if ns_aa == 1 { Vec2::splat(0.5) } else { sampler.get_sample() };
        let place = (Vec2::new(column as f64, row) + jitter) / n;
        let u = (f64::from(x) + place.x) / f64::from(film.w);
        let v = (f64::from(y) + place.y) / f64::from(film.h);
        total += trace_ray(&camera_ray(Vec2::new(u, v)), sampler);
    }
    PixelEstimate { radiance: total / n.max(1.0), samples: ns_aa }
}
