//! Part 5, task 1: the sample loop that stops when it may.

use kit::{Budget, FilmSize, PixelEstimate, PixelSampler, Ray, Spectrum, Tally, Vec2};

/// The mean radiance of the pixel in column `x` and row `y` (from the bottom left), from as many samples as `stop` asks
/// for.
///
/// As in part 1: each sample takes its place inside the pixel from [`PixelSampler::get_sample`], `camera_ray` makes a ray
/// from the place on the film in [0, 1]², and `trace_ray` gives its radiance. After every `budget.batch` samples `stop`
/// gets the tally of their luminances so far and the tolerance, and ends the loop by saying yes; `budget.ns_aa` samples
/// end it in any case. The estimate is the mean over all samples taken and says how many they were. With a budget of
/// 0 it is black, from 0 samples.
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

    /// The pixel (1, 1) with `trace` for a scene; also the places on the film that were asked for.
    fn pixel(
        budget: Budget,
        seed: u64,
        mut trace: impl FnMut(&mut PixelSampler) -> f64,
        stop: &mut impl FnMut(&Tally, f64) -> bool,
    ) -> (PixelEstimate, Vec<Vec2>) {
        let mut places = Vec::new();
        let estimate = raytrace_pixel_adaptive(
            (1, 1),
            FILM,
            budget,
            &mut PixelSampler::new(1, 1, seed),
            &mut |place| {
                places.push(place);
                Ray::new(Vec3::ZERO, -Vec3::Z)
            },
            &mut |_, sampler| Spectrum::grey(trace(sampler)),
            stop,
        );
        (estimate, places)
    }

    fn budget(ns_aa: u32, batch: u32, tolerance: f64) -> Budget {
        Budget {
            ns_aa,
            batch,
            tolerance,
        }
    }

    #[test]
    fn samples_lie_in_their_pixel_and_are_averaged() {
        let mut k = 0.0;
        let next = |_: &mut PixelSampler| {
            k += 1.0;
            k
        };
        let (estimate, places) = pixel(budget(9, 4, 0.0), 1, next, &mut |_, _| false);
        assert_eq!(estimate.samples, 9);
        assert_eq!(estimate.radiance, Spectrum::grey(5.0));
        for place in places {
            assert!((0.25..0.5).contains(&place.x) && (0.5..1.0).contains(&place.y));
        }
    }

    #[test]
    fn the_rule_is_asked_after_each_batch() {
        let mut asked = Vec::new();
        let (estimate, _) = pixel(budget(20, 6, 0.3), 1, |_| 1.0, &mut |samples, tolerance| {
            asked.push((samples.count(), tolerance));
            samples.count() >= 12
        });
        assert_eq!(asked, [(6, 0.3), (12, 0.3)]);
        assert_eq!(estimate.samples, 12);
    }

    /// The eye sees green best: that is where noise counts most.
    #[test]
    fn the_rule_hears_of_luminance() {
        let colour = Spectrum::new(0.5, 2.0, 1.0);
        let mut heard = None;
        raytrace_pixel_adaptive(
            (0, 0),
            FILM,
            budget(4, 4, 0.1),
            &mut PixelSampler::new(0, 0, 1),
            &mut |_| Ray::new(Vec3::ZERO, -Vec3::Z),
            &mut |_, _| colour,
            &mut |samples: &Tally, _| {
                heard = Some(samples.mean());
                true
            },
        );
        assert_eq!(heard, Some(colour.luminance()));
    }

    #[test]
    fn nothing_to_sample_and_nothing_in_a_batch() {
        let (none, _) = pixel(budget(0, 4, 0.1), 1, |_| 1.0, &mut |_, _| false);
        assert_eq!(none, PixelEstimate::default());
        let (one, _) = pixel(budget(5, 0, 0.1), 1, |_| 1.0, &mut |_, _| true);
        assert_eq!(one.samples, 1);
    }

    /// Pixels that see a lamp of radiance 1/p in one sample of 1/p.
    fn rare_light(
        p: f64,
        pixels: u64,
        budget: Budget,
        stop: &mut impl FnMut(&Tally, f64) -> bool,
    ) -> Tally {
        let found = |sampler: &mut PixelSampler| {
            if sampler.next_1d() < p { 1.0 / p } else { 0.0 }
        };
        (0..pixels)
            .map(|seed| pixel(budget, seed, found, stop).0.radiance.g)
            .collect()
    }

    /// Hard case 85, and the mistake it is about: the mended rule is right on average, the plain one is not. The
    /// test is sure to see a bias of 12 %.
    #[test]
    fn a_rare_light_is_not_lost() {
        let budget = budget(2048, 32, 0.05);
        let alarm = sidak(1e-6, 2);
        let mended = rare_light(0.001, 4000, budget, &mut |samples: &Tally, tolerance| {
            has_surely_converged(samples, tolerance, &mut has_converged)
        });
        let p = two_sided(mended.z_against(1.0));
        assert!(
            p > alarm,
            "mean {} ± {}",
            mended.mean(),
            mended.standard_error()
        );
        assert!(detectable_bias(mended.standard_error(), alarm) < 0.12);
        let plain = rare_light(0.001, 4000, budget, &mut has_converged);
        assert!(two_sided(plain.z_against(1.0)) < 1e-30);
        assert!(plain.mean() < 0.2, "{}", plain.mean());
    }

    /// Where the rule does stop early, it is still right: a pixel half in the light, fixed against adaptive.
    #[test]
    fn adaptive_and_fixed_agree() {
        let stop = &mut |samples: &Tally, tolerance| {
            has_surely_converged(samples, tolerance, &mut has_converged)
        };
        let half = rare_light(0.5, 2000, budget(4096, 32, 0.1), stop);
        let fixed = rare_light(0.5, 2000, budget(512, 32, 0.1), &mut |_, _| false);
        let p = two_sided(half.z_between(&fixed));
        assert!(p > 1e-6, "{} against {}", half.mean(), fixed.mean());
        assert!(detectable_bias(half.standard_error(), 1e-6) < 0.02);
    }
}
// END SOLUTION(part5.task1)
