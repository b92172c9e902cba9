//! The rule squared, and a loop over batches.

pub use base::*;
use kit::{Budget, FilmSize, PixelEstimate, PixelSampler, Ray, Spectrum, Tally, Vec2};

pub fn has_converged(samples: &Tally, tolerance: f64) -> bool {
    if samples.count() == 0 {
        return false;
    }
    let (n, allowed) = (samples.count() as f64, tolerance * samples.mean());
    1.96 * 1.96 * samples.variance() <= n * allowed * allowed
}

pub fn has_surely_converged(
    samples: &Tally,
    tolerance: f64,
    rule: &mut impl FnMut(&Tally, f64) -> bool,
) -> bool {
    let says_yes = rule(samples, tolerance);
    if samples.mean() <= 0.0 || samples.count() < FEWEST_SAMPLES_HERE {
        return false;
    }
    says_yes
}

const FEWEST_SAMPLES_HERE: u64 = 256;

pub fn raytrace_pixel_adaptive(
    (x, y): (u32, u32),
    film: FilmSize,
    budget: Budget,
    sampler: &mut PixelSampler,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
    stop: &mut impl FnMut(&Tally, f64) -> bool,
) -> PixelEstimate {
    let (mut tally, mut colours) = (Tally::default(), Vec::new());
    loop {
        let left = budget.ns_aa - colours.len() as u32;
        for _ in 0..left.min(budget.batch.max(1)) {
            let at = sampler.get_sample();
            let u = (f64::from(x) + at.x) / f64::from(film.w);
            let v = (f64::from(y) + at.y) / f64::from(film.h);
            let colour = trace_ray(&camera_ray(Vec2::new(u, v)), sampler);
            tally.push(colour.luminance());
            colours.push(colour);
        }
        let taken = colours.len() as u32;
        if taken == budget.ns_aa || stop(&tally, budget.tolerance) {
            let n = f64::from(taken.max(1));
            return PixelEstimate { radiance: colours.into_iter().sum::<Spectrum>() * (1.0 / n), samples: taken };
        }
    }
}
