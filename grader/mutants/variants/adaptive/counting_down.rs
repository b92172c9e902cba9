//! A loop that counts down to the next look at the rule; the mean in sums of channels.

pub use base::*;
use kit::{Budget, FilmSize, PixelEstimate, PixelSampler, Ray, Spectrum, Tally, Vec2};

pub fn has_converged(samples: &Tally, tolerance: f64) -> bool {
    if samples.count() < 1 {
        return false;
    }
    let sigma = samples.variance().sqrt();
    let i = 1.96 * sigma / (samples.count() as f64).sqrt();
    let allowed = samples.mean() * tolerance;
    i <= allowed
}

pub fn has_surely_converged(
    samples: &Tally,
    tolerance: f64,
    rule: &mut impl FnMut(&Tally, f64) -> bool,
) -> bool {
    if samples.count() < stop::FEWEST_SAMPLES {
        return false;
    }
    let is_black = samples.mean() == 0.0;
    if is_black { false } else { rule(samples, tolerance) }
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
    let mut brightness = Tally::default();
    let mut sums = [0.0; 3];
    let (mut taken, mut until_look) = (0, budget.batch.max(1));
    while taken != budget.ns_aa {
        let inside = sampler.get_sample();
        let place = Vec2::new(
            (f64::from(x) + inside.x) / f64::from(film.w),
            (f64::from(y) + inside.y) / f64::from(film.h),
        );
        let ray = camera_ray(place);
        let light = trace_ray(&ray, sampler);
        for (sum, channel) in sums.iter_mut().zip(light.to_array()) {
            *sum += channel;
        }
        brightness.push(light.luminance());
        taken += 1;
        until_look -= 1;
        if until_look == 0 {
            until_look = budget.batch.max(1);
            if stop(&brightness, budget.tolerance) {
                break;
            }
        }
    }
    if taken == 0 {
        return PixelEstimate { radiance: Spectrum::BLACK, samples: 0 };
    }
    let radiance = Spectrum::from(sums.map(|sum| sum / f64::from(taken)));
    PixelEstimate { radiance, samples: taken }
}
