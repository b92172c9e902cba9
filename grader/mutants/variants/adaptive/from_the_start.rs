//! The rule in the names of its formula, and a tally that is computed again from the first sample
//! for each call of the rule; no call after the last sample.

pub use base::*;
use kit::{Budget, FilmSize, PixelEstimate, PixelSampler, Ray, Spectrum, Tally, Vec2};

pub fn has_converged(samples: &Tally, tolerance: f64) -> bool {
    let n = samples.count() as f64;
    let mean = samples.mean();
    let sigma2 = samples.variance();
    n >= 1.0 && 1.96 * (sigma2 / n).sqrt() <= tolerance * mean
}

pub fn has_surely_converged(
    samples: &Tally,
    tolerance: f64,
    rule: &mut impl FnMut(&Tally, f64) -> bool,
) -> bool {
    let (enough, has_light) = (samples.count() >= 256, samples.mean() > 0.0);
    let converged = enough && has_light && rule(samples, tolerance);
    converged
}

pub fn raytrace_pixel_adaptive(
    (x, y): (u32, u32),
    film: FilmSize,
    budget: Budget,
    sampler: &mut PixelSampler,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
    stop: &mut impl FnMut(&Tally, f64) -> bool,
) -> PixelEstimate {
    let mut colours: Vec<Spectrum> = Vec::new();
    for i in 1..=budget.ns_aa {
        let at = Vec2::new(f64::from(x), f64::from(y)) + sampler.get_sample();
        let ray = camera_ray(Vec2::new(at.x / f64::from(film.w), at.y / f64::from(film.h)));
        colours.push(trace_ray(&ray, sampler));
        let batch = budget.batch.max(1);
        if i < budget.ns_aa && i % batch == 0 {
            // Computed again from the first sample.
            let so_far: Tally = colours.iter().map(|colour| colour.luminance()).collect();
            if stop(&so_far, budget.tolerance) {
                break;
            }
        }
    }
    let n = colours.len().max(1) as f64;
    let total: Spectrum = colours.iter().copied().sum();
    PixelEstimate { radiance: total / n, samples: colours.len() as u32 }
}
