//! Rust tests of the stopping rule, and of pixels that stop by a rule.

use super::{judge, truth};
use crate::tools::kinds::stopping::{MOST_SAMPLES, define_samples};
use crate::tools::repro::numbers::{float, spectrum};
use std::fmt::Write;
use wire::adaptive::{AdaptivePixel, StopCall, StopRule};

/// A test of the plain rule.
pub(crate) fn plain(call: &StopCall) -> Option<String> {
    let mut text = String::from("use kit::Tally;\n");
    define_samples(&mut text, call)?;
    let _ = writeln!(
        text,
        "assert_eq!(adaptive::has_converged(&samples, {}), {});",
        float(call.tolerance),
        truth::converged(call)
    );
    Some(text)
}

/// A test of the number of samples of a pixel, their positions, the calls of the rule, and the
/// mean.
pub(crate) fn pixel(work: &AdaptivePixel) -> Option<String> {
    if work.stream.len() > MOST_SAMPLES {
        return None;
    }
    let (samples, rule_calls) = truth::right_samples(work);
    let stream: Vec<String> = work.stream.iter().map(|light| spectrum(*light)).collect();
    let rule = match work.rule {
        StopRule::From(least) => format!("samples.count() >= {least}"),
        StopRule::Plain => "adaptive::has_converged(samples, tolerance)".into(),
    };
    let [x, y] = work.pixel;
    let [w, h] = work.film;
    let [r, g, b] = judge::mean(work, samples).map(float);
    // A call after the last possible sample is optional.
    let rule_args: Vec<String> = rule_calls
        .iter()
        .filter(|at_call| at_call.count() < u64::from(work.ns_aa))
        .map(|at_call| format!("({}, {})", at_call.count(), float(at_call.mean())))
        .collect();
    Some(format!(
        "use kit::{{Budget, FilmSize, PixelSampler, Ray, Spectrum, Tally, Vec2, Vec3}};
let light = [{}];
let (mut points, mut traced, mut rule_args) = (Vec::new(), Vec::new(), Vec::new());
let estimate = adaptive::raytrace_pixel_adaptive(
    ({x}, {y}),
    FilmSize {{ w: {w}, h: {h} }},
    Budget {{ ns_aa: {ns_aa}, batch: {}, tolerance: {tolerance} }},
    &mut PixelSampler::new({x}, {y}, {}),
    &mut |point: Vec2| {{
        points.push(point);
        Ray::new(Vec3::new(point.x, point.y, 1.0), Vec3::NEG_Z)
    }},
    &mut |ray: &Ray, _: &mut PixelSampler| {{
        traced.push(Vec2::new(ray.o.x, ray.o.y));
        light[(traced.len() - 1) % light.len()]
    }},
    &mut |samples: &Tally, tolerance: f64| {{
        assert_eq!(tolerance, {tolerance});
        rule_args.push((samples.count(), samples.mean()));
        {rule}
    }},
);
assert_eq!((estimate.samples, points.len(), traced.len()), ({samples}, {samples}, {samples}));
assert_eq!(traced, points, \"other rays than the camera's\");
for (i, point) in points.iter().enumerate() {{
    let place = *point * Vec2::new({w}.0, {h}.0) - Vec2::new({x}.0, {y}.0);
    let inside = place.min_element() >= -1e-9 && place.max_element() <= 1.0 + 1e-9;
    assert!(inside, \"{{point}} is not in pixel ({x}, {y})\");
    assert!(!points[..i].contains(point), \"two samples at {{point}}\");
}}
let right: Vec<(u64, f64)> = vec![{}];
rule_args.retain(|(count, _)| (0..{ns_aa}).contains(count));
assert_eq!(rule_args.len(), right.len(), \"calls of the rule: {{rule_args:?}}\");
for ((count, mean), (right_count, right_mean)) in rule_args.iter().zip(&right) {{
    assert!(count == right_count && (mean - right_mean).abs() <= 1e-9 * right_mean.abs(), \"{{rule_args:?}}\");
}}
let off = [estimate.radiance.r - {r}, estimate.radiance.g - {g}, estimate.radiance.b - {b}];
assert!(off.iter().all(|off| off.abs() <= 1e-9), \"{{:?}}\", estimate.radiance);
",
        stream.join(", "),
        work.batch,
        work.seed,
        rule_args.join(", "),
        ns_aa = work.ns_aa,
        tolerance = float(work.tolerance),
    ))
}
