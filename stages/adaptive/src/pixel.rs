//! Part 5, task 1: the sampling loop that can stop early.

use kit::{Budget, FilmSize, PixelEstimate, PixelSampler, Ray, Spectrum, Tally, Vec2};

/// Estimates the mean radiance of the pixel in column `x` and row `y` (from the bottom left), with
/// as many samples as `stop` requires.
///
/// Chapter: stages/book/src/part5/task1.md
///
/// As in part 1, the position of each sample in the pixel comes from [`PixelSampler::get_sample`],
/// `camera_ray` generates the ray of a position on the film in [0, 1]², and `trace_ray` returns its
/// radiance.
///
/// After every `budget.batch` samples, `stop` is called with the tally of the luminances of all
/// samples so far and with the tolerance. If `stop` returns true, the loop ends. The loop always
/// ends after `budget.ns_aa` samples. The estimate contains the mean over all samples and their
/// number. With a budget of 0 the estimate is black, with 0 samples.
///
/// See it: `cargo grader picture part5.task1`.
pub fn raytrace_pixel_adaptive(
    (x, y): (u32, u32),
    film: FilmSize,
    budget: Budget,
    sampler: &mut PixelSampler,
    camera_ray: &mut impl FnMut(Vec2) -> Ray,
    trace_ray: &mut impl FnMut(&Ray, &mut PixelSampler) -> Spectrum,
    stop: &mut impl FnMut(&Tally, f64) -> bool,
) -> PixelEstimate {
    // BEGIN SOLUTION(part5.task1)
    let size = Vec2::new(f64::from(film.w), f64::from(film.h));
    let corner = Vec2::new(f64::from(x), f64::from(y));
    let mut luminance = Tally::default();
    let mut sum = Spectrum::BLACK;
    let mut samples = 0;
    while samples < budget.ns_aa {
        let ray = camera_ray((corner + sampler.get_sample()) / size);
        let radiance = trace_ray(&ray, sampler);
        sum += radiance;
        luminance.push(radiance.luminance());
        samples += 1;
        if samples % budget.batch.max(1) == 0 && stop(&luminance, budget.tolerance) {
            break;
        }
    }
    PixelEstimate {
        radiance: sum / f64::from(samples.max(1)),
        samples,
    }
    // STUB: kit::hole!("part5.task1", x, y, film, budget, sampler, camera_ray, trace_ray, stop)
    // END SOLUTION(part5.task1)
}

// BEGIN SOLUTION(part5.task1)
#[cfg(test)]
mod tests {
    use super::*;
    use crate::{has_converged, has_surely_converged};
    use kit::Vec3;
    use statistics::{detectable_bias, sidak, two_sided};

    const FILM: FilmSize = FilmSize { w: 4, h: 2 };

    /// Samples the pixel (1, 1) with `trace` as the scene. Also returns the positions on the film.
    fn pixel(
        budget: Budget,
        seed: u64,
        mut trace: impl FnMut(&mut PixelSampler) -> f64,
        stop: &mut impl FnMut(&Tally, f64) -> bool,
    ) -> (PixelEstimate, Vec<Vec2>) {
        let mut positions = Vec::new();
        let estimate = raytrace_pixel_adaptive(
            (1, 1),
            FILM,
            budget,
            &mut PixelSampler::new(1, 1, seed),
            &mut |position| {
                positions.push(position);
                Ray::new(Vec3::ZERO, -Vec3::Z)
            },
            &mut |_, sampler| Spectrum::grey(trace(sampler)),
            stop,
        );
        (estimate, positions)
    }

    fn budget(ns_aa: u32, batch: u32, tolerance: f64) -> Budget {
        Budget {
            ns_aa,
            batch,
            tolerance,
        }
    }

    #[test]
    fn samples_are_inside_their_pixel_and_are_averaged() {
        let mut k = 0.0;
        let next = |_: &mut PixelSampler| {
            k += 1.0;
            k
        };
        let (estimate, positions) = pixel(budget(9, 4, 0.0), 1, next, &mut |_, _| false);
        assert_eq!(estimate.samples, 9);
        assert_eq!(estimate.radiance, Spectrum::grey(5.0));
        for position in positions {
            assert!((0.25..0.5).contains(&position.x) && (0.5..1.0).contains(&position.y));
        }
    }

    #[test]
    fn stop_is_called_after_each_batch() {
        let mut calls = Vec::new();
        let (estimate, _) = pixel(budget(20, 6, 0.3), 1, |_| 1.0, &mut |samples, tolerance| {
            calls.push((samples.count(), tolerance));
            samples.count() >= 12
        });
        assert_eq!(calls, [(6, 0.3), (12, 0.3)]);
        assert_eq!(estimate.samples, 12);
    }

    /// Noise is most visible in the channels with the largest luminance.
    #[test]
    fn stop_gets_luminances() {
        let colour = Spectrum::new(0.5, 2.0, 1.0);
        let mut mean = None;
        raytrace_pixel_adaptive(
            (0, 0),
            FILM,
            budget(4, 4, 0.1),
            &mut PixelSampler::new(0, 0, 1),
            &mut |_| Ray::new(Vec3::ZERO, -Vec3::Z),
            &mut |_, _| colour,
            &mut |samples: &Tally, _| {
                mean = Some(samples.mean());
                true
            },
        );
        assert_eq!(mean, Some(colour.luminance()));
    }

    #[test]
    fn zero_samples_and_zero_batch_size() {
        let (none, _) = pixel(budget(0, 4, 0.1), 1, |_| 1.0, &mut |_, _| false);
        assert_eq!(none, PixelEstimate::default());
        let (one, _) = pixel(budget(5, 0, 0.1), 1, |_| 1.0, &mut |_, _| true);
        assert_eq!(one.samples, 1);
    }

    /// Pixels that see a lamp of radiance 1/p with probability p.
    fn rare_light(
        p: f64,
        pixels: u64,
        budget: Budget,
        stop: &mut impl FnMut(&Tally, f64) -> bool,
    ) -> Tally {
        let trace = |sampler: &mut PixelSampler| {
            if sampler.next_1d() < p { 1.0 / p } else { 0.0 }
        };
        (0..pixels)
            .map(|seed| pixel(budget, seed, trace, stop).0.radiance.g)
            .collect()
    }

    /// Hard case 85: the criterion of task 2 is unbiased, that of task 1 is not. The test detects
    /// every bias of 12 %.
    #[test]
    fn rare_light_is_estimated_without_bias() {
        let budget = budget(2048, 32, 0.05);
        let significance = sidak(1e-6, 2);
        let unbiased = rare_light(0.001, 4000, budget, &mut |samples: &Tally, tolerance| {
            has_surely_converged(samples, tolerance, &mut has_converged)
        });
        let p = two_sided(unbiased.z_against(1.0));
        assert!(
            p > significance,
            "mean {} ± {}",
            unbiased.mean(),
            unbiased.standard_error()
        );
        assert!(detectable_bias(unbiased.standard_error(), significance) < 0.12);
        let plain = rare_light(0.001, 4000, budget, &mut has_converged);
        assert!(two_sided(plain.z_against(1.0)) < 1e-30);
        assert!(plain.mean() < 0.2, "{}", plain.mean());
    }

    /// If the criterion stops early, the estimate is still unbiased: a half lit pixel, with a fixed
    /// and an adaptive number of samples.
    #[test]
    fn adaptive_and_fixed_agree() {
        let stop = &mut |samples: &Tally, tolerance| {
            has_surely_converged(samples, tolerance, &mut has_converged)
        };
        let half = rare_light(0.5, 2000, budget(4096, 32, 0.1), stop);
        let fixed = rare_light(0.5, 2000, budget(512, 32, 0.1), &mut |_, _| false);
        let p = two_sided(half.z_between(&fixed));
        assert!(p > 1e-6, "{} adaptive, {} fixed", half.mean(), fixed.mean());
        assert!(detectable_bias(half.standard_error(), 1e-6) < 0.02);
    }
}
// END SOLUTION(part5.task1)
