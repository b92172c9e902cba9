//! Tests of stopping rules, and of pixels that stop by one.

use super::numbers::{float, spectrum};
use crate::adaptive;
use std::fmt::Write;
use wire::adaptive::{AdaptivePixel, StopCall, StopRule};

/// So many different samples still make a test that one can read.
const SAMPLES: usize = 40;

/// What the plain rule says.
pub(super) fn plain(call: &StopCall) -> Option<String> {
    let mut text = String::from("use kit::Tally;\n");
    samples(&mut text, call)?;
    let _ = writeln!(
        text,
        "assert_eq!(adaptive::has_converged(&samples, {}), {});",
        float(call.tolerance),
        adaptive::converged(call)
    );
    Some(text)
}

/// What the mended rule says and asks.
pub(super) fn mended(call: &StopCall) -> Option<String> {
    let (tolerance, may_ask) = (float(call.tolerance), adaptive::may_ask(call));
    let mut text = String::from("use kit::Tally;\n");
    samples(&mut text, call)?;
    let _ = write!(
        text,
        "let mut asked = Vec::new();
let mut rule = |samples: &Tally, tolerance: f64| {{
    asked.push((samples.count(), samples.mean(), tolerance));
    {}
}};
let stop = adaptive::has_surely_converged(&samples, {tolerance}, &mut rule);
assert_eq!(stop, {});
let right = (samples.count(), samples.mean(), {tolerance});
assert!(asked.iter().all(|asked| *asked == right), \"{{asked:?}}\");
",
        call.rule,
        may_ask && call.rule
    );
    if may_ask {
        text.push_str("assert!(!asked.is_empty(), \"the rule has the last word\");\n");
    }
    Some(text)
}

fn samples(text: &mut String, call: &StopCall) -> Option<()> {
    let runs = call.runs.iter();
    let runs: Vec<String> = runs
        .map(|(count, x)| format!("({count}, {})", float(*x)))
        .collect();
    let _ = writeln!(
        text,
        "let runs: [(usize, f64); {}] = [{}];
let samples: Tally = runs.iter().flat_map(|&(count, x)| std::iter::repeat_n(x, count)).collect();",
        runs.len(),
        runs.join(", ")
    );
    (runs.len() <= SAMPLES).then_some(())
}

/// How many samples a pixel takes, where they lie, what the rule hears and what the mean is.
pub(super) fn pixel(work: &AdaptivePixel) -> Option<String> {
    if work.stream.len() > SAMPLES {
        return None;
    }
    let (samples, looks) = adaptive::sound(work);
    let stream: Vec<String> = work.stream.iter().map(|light| spectrum(*light)).collect();
    let rule = match work.rule {
        StopRule::From(least) => format!("samples.count() >= {least}"),
        StopRule::Plain => "adaptive::has_converged(samples, tolerance)".into(),
    };
    let [x, y] = work.pixel;
    let [w, h] = work.film;
    let [r, g, b] = adaptive::mean(work, samples).map(float);
    // At the last sample a look makes no difference.
    let heard: Vec<String> = looks
        .iter()
        .filter(|look| look.count() < u64::from(work.ns_aa))
        .map(|look| format!("({}, {})", look.count(), float(look.mean())))
        .collect();
    Some(format!(
        "use kit::{{Budget, FilmSize, PixelSampler, Ray, Spectrum, Tally, Vec2, Vec3}};
let light = [{}];
let (mut points, mut traced, mut heard) = (Vec::new(), Vec::new(), Vec::new());
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
        heard.push((samples.count(), samples.mean()));
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
heard.retain(|(count, _)| *count < {ns_aa});
assert_eq!(heard.len(), right.len(), \"looks at the rule: {{heard:?}}\");
for ((count, mean), (right_count, right_mean)) in heard.iter().zip(&right) {{
    assert!(count == right_count && (mean - right_mean).abs() <= 1e-9 * right_mean.abs(), \"{{heard:?}}\");
}}
let off = [estimate.radiance.r - {r}, estimate.radiance.g - {g}, estimate.radiance.b - {b}];
assert!(off.iter().all(|off| off.abs() <= 1e-9), \"{{:?}}\", estimate.radiance);
",
        stream.join(", "),
        work.batch,
        work.seed,
        heard.join(", "),
        ns_aa = work.ns_aa,
        tolerance = float(work.tolerance),
    ))
}
