//! Runs Part 5: stopping rules, and pixels with given samples.

use crate::stages::Adaptive;
use kit::{Budget, FilmSize, PixelSampler, Ray, Spectrum, Tally, Vec2, Vec3};
use wire::adaptive::{AdaptiveAnswer, AdaptivePixel, StopAnswer, StopCall, StopRule};

pub(crate) fn stop(stage: &Adaptive, calls: &[StopCall]) -> Vec<StopAnswer> {
    answers(calls, |samples, call, _| {
        let stop = || (stage.has_converged)(samples, call.tolerance);
        harness::attempt("has_converged", stop).unwrap_or_default()
    })
}

pub(crate) fn sure_stop(stage: &Adaptive, calls: &[StopCall]) -> Vec<StopAnswer> {
    answers(calls, |samples, call, rule_calls| {
        let rule = &mut |samples: &Tally, tolerance| {
            harness::limit_calls("rule", rule_calls.len(), || "one decision".into());
            rule_calls.push((samples.count(), samples.mean(), tolerance));
            call.rule
        };
        (stage.has_surely_converged)(samples, call.tolerance, rule)
    })
}

fn answers(
    calls: &[StopCall],
    call_rule: impl Fn(&Tally, &StopCall, &mut Vec<(u64, f64, f64)>) -> bool,
) -> Vec<StopAnswer> {
    harness::each_call(calls, |_, call| {
        let runs = call.runs.iter();
        let samples: Tally = runs
            .flat_map(|&(count, x)| std::iter::repeat_n(x, count as usize))
            .collect();
        let mut rule_calls = Vec::new();
        let stop = call_rule(&samples, call, &mut rule_calls);
        StopAnswer { stop, rule_calls }
    })
}

pub(crate) fn pixels(stage: &Adaptive, pixels: &[AdaptivePixel]) -> Vec<AdaptiveAnswer> {
    harness::each_call(pixels, |_, pixel| sample(stage, pixel))
}

fn sample(stage: &Adaptive, work: &AdaptivePixel) -> AdaptiveAnswer {
    let [x, y] = work.pixel;
    let mut points: Vec<[f64; 2]> = Vec::new();
    let (mut traced, mut foreign) = (0_u32, 0);
    let mut rule_calls = Vec::new();
    let asked_for = || match work.ns_aa {
        1 => "at most 1 sample".into(),
        samples => format!("at most {samples} samples"),
    };
    let mut camera_ray = |point: Vec2| {
        harness::limit_calls("camera_ray", points.len(), asked_for);
        points.push(point.into());
        from_camera(point)
    };
    let mut trace_ray = |ray: &Ray, _: &mut PixelSampler| {
        harness::limit_calls("trace_ray", traced, asked_for);
        let point = Vec2::new(ray.o.x, ray.o.y);
        foreign += u32::from(*ray != from_camera(point));
        let radiance = work.stream[traced as usize % work.stream.len()];
        traced += 1;
        Spectrum::from(radiance)
    };
    let mut stop = |samples: &Tally, tolerance: f64| {
        harness::limit_calls("stop", rule_calls.len(), asked_for);
        rule_calls.push((
            samples.count(),
            samples.mean(),
            samples.variance(),
            tolerance,
        ));
        match work.rule {
            StopRule::From(count) => samples.count() >= count,
            StopRule::Plain => (stage.has_converged)(samples, tolerance),
        }
    };
    let estimate = harness::attempt("raytrace_pixel_adaptive", || {
        (stage.raytrace_pixel_adaptive)(
            (x, y),
            FilmSize {
                w: work.film[0],
                h: work.film[1],
            },
            Budget {
                ns_aa: work.ns_aa,
                batch: work.batch,
                tolerance: work.tolerance,
            },
            &mut PixelSampler::new(x, y, work.seed),
            &mut camera_ray,
            &mut trace_ray,
            &mut stop,
        )
    })
    .unwrap_or_default();
    AdaptiveAnswer {
        points,
        traced,
        foreign,
        rule_calls,
        radiance: estimate.radiance.to_array(),
        samples: estimate.samples,
    }
}

/// A ray whose origin identifies the film point it was made for.
fn from_camera(point: Vec2) -> Ray {
    Ray::new(Vec3::new(point.x, point.y, 1.0), Vec3::NEG_Z)
}
