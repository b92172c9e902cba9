//! A running mean, and the width of the interval compared with the mean it is around.

pub use base::*;
use kit::{Budget, FilmSize, PixelEstimate, PixelSampler, Ray, Spectrum, Tally, Vec2};

pub fn has_converged(samples: &Tally, tolerance: f64) -> bool {
    let n = samples.count() as f64;
    let interval = 1.96 * samples.variance().sqrt() / n.sqrt();
    n > 0.0 && !(interval > tolerance * samples.mean())
}

pub fn raytrace_pixel_adaptive(
    place: (u32, u32),
    film: FilmSize,
    budget: Budget,
    sampler: &mut PixelSampler,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
    stop: &mut impl FnMut(&Tally, f64) -> bool,
) -> PixelEstimate {
    let mut luminances = Tally::default();
    let mut mean = Spectrum::BLACK;
    let mut in_batch = 0;
    for _ in 0..budget.ns_aa {
        let offset = sampler.get_sample();
        let u = (f64::from(place.0) + offset.x) / f64::from(film.w);
        let v = (f64::from(place.1) + offset.y) / f64::from(film.h);
        let colour = trace_ray(&camera_ray(Vec2::new(u, v)), sampler);
        luminances.push(colour.luminance());
        mean += (colour - mean) / luminances.count() as f64;
        in_batch += 1;
        if in_batch >= budget.batch {
            if stop(&luminances, budget.tolerance) {
                break;
            }
            in_batch = 0;
        }
    }
    PixelEstimate { radiance: mean, samples: luminances.count() as u32 }
}
