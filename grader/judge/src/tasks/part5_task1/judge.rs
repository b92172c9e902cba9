//! Judges the stopping rule, and pixels that stop by a rule.

use super::placement;
use super::truth::{converged, right_samples};
use crate::plural;
use crate::tools::aspects::independence::{self, PixelSamples};
use crate::tools::aspects::numbers;
use crate::tools::call_text::all_or_none;
use crate::tools::findings::{Aspect, Class, Findings, Message};
use crate::tools::kinds::stopping::verdict;
use kit::Tally;
use wire::adaptive::{AdaptiveAnswer, AdaptivePixel, StopAnswer, StopCall};
use wire::work::Xyz;

/// Relative error allowed in means and variances: they are sums of thousands of numbers.
const BOUND: f64 = 1e-9;

/// Judges the plain rule.
pub(crate) fn stop(findings: &mut Findings, calls: &[StopCall], answers: &[StopAnswer]) {
    if !findings.is_written("has_converged", &[Aspect::Stop]) {
        return;
    }
    findings.count_for("has_converged");
    for (i, (call, answer)) in calls.iter().zip(answers).enumerate() {
        verdict(findings, i, call, answer, converged(call), "");
    }
}

/// The aspects of pixels.
const OF_A_PIXEL: [Aspect; 5] = [
    Aspect::Radiance,
    Aspect::Placement,
    Aspect::Calls,
    Aspect::Questions,
    Aspect::Independence,
];

/// Judges pixels that stop by a rule.
pub(crate) fn pixels(findings: &mut Findings, works: &[AdaptivePixel], answers: &[AdaptiveAnswer]) {
    if !findings.is_written("raytrace_pixel_adaptive", &OF_A_PIXEL) {
        return;
    }
    findings.count_for("raytrace_pixel_adaptive");
    for (call, (work, answer)) in works.iter().zip(answers).enumerate() {
        pixel(findings, call, work, answer);
    }
    let samples = works.iter().zip(answers);
    let samples: Vec<PixelSamples> = samples
        .map(|(work, answer)| placement::samples(work, answer))
        .collect();
    independence::judge(findings, &samples);
}

/// Why the positions of samples are not judged.
const ANY_PLACE: &str =
    "any place in the pixel is right, and the distribution of the samples is not tested";

/// Why the number of calls of the rule is not judged.
const LAST_CALL: &str = "a call of the rule after the last possible sample is optional";

/// Records what the judgement of pixels leaves open.
pub(crate) fn untested(
    findings: &mut Findings,
    works: &[AdaptivePixel],
    answers: &[AdaptiveAnswer],
) {
    for (call, (work, answer)) in works.iter().zip(answers).enumerate() {
        if !answer.points.is_empty() {
            findings.not_judged(Aspect::Placement, call, ANY_PLACE);
        }
        let (_, rule_calls) = right_samples(work);
        if last_is_optional(work, &rule_calls) {
            findings.not_judged(Aspect::Questions, call, LAST_CALL);
        }
    }
}

/// Whether the last of the right calls of the rule is after the last possible sample.
fn last_is_optional(work: &AdaptivePixel, rule_calls: &[Tally]) -> bool {
    let last = rule_calls.last();
    last.is_some_and(|at_call| at_call.count() == u64::from(work.ns_aa))
}

/// The mean of the first `samples` samples.
pub(crate) fn mean(work: &AdaptivePixel, samples: u32) -> Xyz {
    let stream = work.stream.iter().cycle().take(samples as usize);
    let sum = stream.fold([0.0; 3], |sum, l| [0, 1, 2].map(|i| sum[i] + l[i]));
    sum.map(|channel| channel / f64::from(samples.max(1)))
}

fn pixel(findings: &mut Findings, call: usize, work: &AdaptivePixel, answer: &AdaptiveAnswer) {
    for aspect in [Aspect::Calls, Aspect::Radiance, Aspect::Questions] {
        findings.expect(aspect);
    }
    let about = || {
        format!(
            "Pixel ({}, {}), ns_aa = {}, batch = {}, tolerance = {}",
            work.pixel[0], work.pixel[1], work.ns_aa, work.batch, work.tolerance
        )
    };
    let (samples, rule_calls) = right_samples(work);
    let counts = [answer.samples, answer.traced, answer.points.len() as u32];
    let right = counts == [samples; 3] && answer.foreign == 0;
    let class = (!right).then(|| Class::of_number(f64::from(answer.samples), f64::from(samples)));
    let off = f64::from(answer.samples) - f64::from(samples);
    findings.judge_class(Aspect::Calls, call, class, off.abs(), || {
        Message::new(format!(
            "your result: {} in the estimate, {} of trace_ray ({} of them with rays that camera_ray did not return), {} of camera_ray; expected: {samples} each",
            plural(answer.samples, "sample", "samples"),
            plural(answer.traced, "call", "calls"),
            answer.foreign,
            counts[2]
        ))
        .asked(about())
    });
    let (aspect, mean) = (Aspect::Radiance, mean(work, samples));
    numbers::colour(findings, aspect, call, answer.radiance, mean, BOUND, about);
    questions(findings, call, work, answer, &rule_calls, &about);
    placement::judge(findings, call, work, answer, &about);
}

/// What the rule received for each sample instead of the luminance, such as the red channel; `None`
/// if it is none of those that are checked.
fn another_number(work: &AdaptivePixel, rule_call: &(u64, f64, f64, f64)) -> Option<&'static str> {
    // An answer may state any count: a pixel does not have that many samples.
    if rule_call.0 > u64::from(work.ns_aa) {
        return None;
    }
    type Number = fn(&Xyz) -> f64;
    const NUMBERS: [(&str, Number); 6] = [
        ("red", |light| light[0]),
        ("green", |light| light[1]),
        ("blue", |light| light[2]),
        ("the sum of the channels", |light| light.iter().sum()),
        ("the mean of the channels", |light| {
            light.iter().sum::<f64>() / 3.0
        }),
        ("the largest channel", |light| {
            light.iter().copied().fold(0.0, f64::max)
        }),
    ];
    let is = |number: &&(&str, Number)| {
        let stream = work.stream.iter().cycle().take(rule_call.0 as usize);
        let mean = stream.map(number.1).collect::<Tally>().mean();
        (rule_call.1 - mean).abs() <= BOUND * mean.abs()
    };
    NUMBERS.iter().find(is).map(|(name, _)| *name)
}

/// Judges the calls of the rule: after each batch, with all luminances so far. A call after the
/// last possible sample is optional.
fn questions(
    findings: &mut Findings,
    call: usize,
    work: &AdaptivePixel,
    answer: &AdaptiveAnswer,
    rule_calls: &[Tally],
    about: &impl Fn() -> String,
) {
    let least = rule_calls.len() - usize::from(last_is_optional(work, rule_calls));
    let enough = (least..=rule_calls.len()).contains(&answer.rule_calls.len());
    let near = |a: f64, b: f64, scale: f64| (a - b).abs() <= BOUND * scale;
    let same = |(rule_call, right): (&(u64, f64, f64, f64), &Tally)| {
        let square = right.mean() * right.mean() + right.variance();
        rule_call.0 == right.count()
            && near(rule_call.1, right.mean(), right.mean().abs())
            && near(rule_call.2, right.variance(), square)
            && rule_call.3 == work.tolerance
    };
    let right = enough && answer.rule_calls.iter().zip(rule_calls).all(same);
    let off = answer.rule_calls.len().abs_diff(rule_calls.len());
    let class = (!right).then(|| {
        let wrong = answer
            .rule_calls
            .iter()
            .zip(rule_calls)
            .find(|pair| !same(*pair));
        let number = wrong.and_then(|(rule_call, _)| another_number(work, rule_call));
        number.map_or(Class::of_size(1.0 + off as f64), Class::Named)
    });
    findings.judge_class(Aspect::Questions, call, class, 1.0 + off as f64, || {
        let show = |n: &Tally| (n.count(), n.mean(), n.variance(), work.tolerance);
        let wanted: Vec<_> = rule_calls.iter().take(4).map(show).collect();
        let called: Vec<_> = answer.rule_calls.iter().take(4).copied().collect();
        let calls = |of: &[(u64, f64, f64, f64)]| {
            all_or_none(of.iter().map(|call| format!("{call:?}")))
        };
        let numbers = |call: &(u64, f64, f64, f64)| [call.0 as f64, call.1, call.2, call.3];
        Message::new(format!(
            "your result: {} of the rule, first with (count, mean, variance, tolerance) = {}; expected: {}, first {}",
            plural(answer.rule_calls.len(), "call", "calls"),
            calls(&called),
            plural(rule_calls.len(), "call", "calls"),
            calls(&wanted)
        ))
        .compares(
            called.iter().flat_map(numbers),
            wanted.iter().flat_map(numbers),
        )
        .asked(about())
    });
}
