//! Judging stopping rules and pixels that stop by them.

use super::numbers;
use super::tally::{Aspect, Class, Tally};
use kit::{Spectrum, Tally as Numbers};
use std::collections::HashSet;
use wire::adaptive::{AdaptiveAnswer, AdaptivePixel, StopAnswer, StopCall, StopRule};

/// How far means and variances may be off, as a share: they are sums of thousands of numbers.
const BOUND: f64 = 1e-9;

/// How far a point may be outside its pixel, in pixels.
const PLACE_BOUND: f64 = 1e-9;

/// Half of the middle 95 % of a normal distribution, in standard deviations.
const CONFIDENCE: f64 = 1.96;

/// Samples that the mended rule waits for.
const PATIENCE: u64 = 256;

/// Whether the interval around the mean is narrow enough, with both sides squared.
fn is_narrow(samples: &Numbers, tolerance: f64) -> bool {
    let (n, wanted) = (samples.count() as f64, tolerance * samples.mean());
    n > 0.0 && n * wanted * wanted >= CONFIDENCE * CONFIDENCE * samples.variance()
}

fn samples(call: &StopCall) -> Numbers {
    let runs = call.runs.iter();
    runs.flat_map(|&(count, x)| std::iter::repeat_n(x, count as usize))
        .collect()
}

/// Judges the plain rule.
pub(super) fn stop(tally: &mut Tally, calls: &[StopCall], answers: &[StopAnswer]) {
    for (i, (call, answer)) in calls.iter().zip(answers).enumerate() {
        let samples = samples(call);
        verdict(tally, i, call, answer, is_narrow(&samples, call.tolerance));
    }
}

/// Judges the mended rule.
pub(super) fn sure_stop(tally: &mut Tally, calls: &[StopCall], answers: &[StopAnswer]) {
    for (i, (call, answer)) in calls.iter().zip(answers).enumerate() {
        let samples = samples(call);
        let may_ask = samples.count() >= PATIENCE && samples.mean() > 0.0;
        verdict(tally, i, call, answer, may_ask && call.rule);
        tally.expect(Aspect::Questions);
        let right = (samples.count(), samples.mean(), call.tolerance);
        let known = answer.asked.iter().all(|asked| *asked == right);
        let heard = known && (!may_ask || !answer.asked.is_empty());
        tally.judge(Aspect::Questions, i, heard, 1.0, || {
            format!(
                "the plain rule was asked {:?} (count, mean, tolerance); it has the last word on {right:?}",
                answer.asked
            )
        });
    }
}

fn verdict(tally: &mut Tally, i: usize, call: &StopCall, answer: &StopAnswer, right: bool) {
    tally.expect(Aspect::Stop);
    let class = match (answer.stop, right) {
        (true, false) => Some(Class::FalseHit),
        (false, true) => Some(Class::FalseMiss),
        _ => None,
    };
    tally.judge_class(Aspect::Stop, i, class, 1.0, || {
        let samples = samples(call);
        format!(
            "it says {}, right is {right}: {} samples with the mean {} and the standard error {}, tolerance {}, where the plain rule says {}",
            answer.stop,
            samples.count(),
            samples.mean(),
            samples.standard_error(),
            call.tolerance,
            if call.rule { "yes" } else { "no" }
        )
    });
}

/// Judges pixels that stop by a rule.
pub(super) fn pixels(tally: &mut Tally, works: &[AdaptivePixel], answers: &[AdaptiveAnswer]) {
    for (call, (work, answer)) in works.iter().zip(answers).enumerate() {
        pixel(tally, call, work, answer);
    }
}

/// The samples that a sound loop takes, and the looks at the rule on the way.
fn sound(work: &AdaptivePixel) -> (u32, Vec<Numbers>) {
    let mut taken = Numbers::default();
    let mut looks = Vec::new();
    let endless = work.stream.iter().cycle().zip(1..=work.ns_aa);
    for (radiance, count) in endless {
        taken.push(Spectrum::from(*radiance).luminance());
        if !count.is_multiple_of(work.batch.max(1)) {
            continue;
        }
        looks.push(taken);
        let enough = match work.rule {
            StopRule::From(least) => taken.count() >= least,
            StopRule::Plain => is_narrow(&taken, work.tolerance),
        };
        if enough {
            return (count, looks);
        }
    }
    (work.ns_aa, looks)
}

fn pixel(tally: &mut Tally, call: usize, work: &AdaptivePixel, answer: &AdaptiveAnswer) {
    for aspect in [Aspect::Calls, Aspect::Radiance, Aspect::Questions] {
        tally.expect(aspect);
    }
    let about = || {
        format!(
            "Pixel {:?}, ns_aa = {}, batch = {}, tolerance = {}",
            work.pixel, work.ns_aa, work.batch, work.tolerance
        )
    };
    let (samples, looks) = sound(work);
    let counts = [answer.samples, answer.traced, answer.points.len() as u32];
    let right = counts == [samples; 3] && answer.foreign == 0;
    let class = (!right).then(|| Class::of_number(f64::from(answer.samples), f64::from(samples)));
    let off = f64::from(answer.samples) - f64::from(samples);
    tally.judge_class(Aspect::Calls, call, class, off.abs(), || {
        format!(
            "the estimate says {} samples, trace_ray was called {} times ({} of them with rays that camera_ray did not make), camera_ray {} times; right are {samples} each. {}",
            answer.samples, answer.traced, answer.foreign, counts[2], about()
        )
    });
    let stream = work.stream.iter().cycle().take(samples as usize);
    let sum = stream.fold([0.0; 3], |sum, l| [0, 1, 2].map(|i| sum[i] + l[i]));
    let mean = sum.map(|channel| channel / f64::from(samples.max(1)));
    numbers::colour(
        tally,
        Aspect::Radiance,
        call,
        answer.radiance,
        mean,
        BOUND,
        about,
    );
    questions(tally, call, work, answer, &looks, &about);
    places(tally, call, work, answer, &about);
}

/// After each batch the rule hears of all luminances so far. At the last sample it makes no difference.
fn questions(
    tally: &mut Tally,
    call: usize,
    work: &AdaptivePixel,
    answer: &AdaptiveAnswer,
    looks: &[Numbers],
    about: &impl Fn() -> String,
) {
    let needless = looks
        .last()
        .is_some_and(|look| look.count() == u64::from(work.ns_aa));
    let least = looks.len() - usize::from(needless);
    let enough = (least..=looks.len()).contains(&answer.looks.len());
    let near = |a: f64, b: f64, scale: f64| (a - b).abs() <= BOUND * scale;
    let same = |(asked, right): (&(u64, f64, f64, f64), &Numbers)| {
        let square = right.mean() * right.mean() + right.variance();
        asked.0 == right.count()
            && near(asked.1, right.mean(), right.mean().abs())
            && near(asked.2, right.variance(), square)
            && asked.3 == work.tolerance
    };
    let right = enough && answer.looks.iter().zip(looks).all(same);
    let off = answer.looks.len().abs_diff(looks.len());
    tally.judge(Aspect::Questions, call, right, 1.0 + off as f64, || {
        let show = |n: &Numbers| (n.count(), n.mean(), n.variance(), work.tolerance);
        let wanted: Vec<_> = looks.iter().take(4).map(show).collect();
        let asked: Vec<_> = answer.looks.iter().take(4).collect();
        format!(
            "stop was asked {} times, first with (count, mean, variance, tolerance) {asked:?}; right are {} times, first {wanted:?}. {}",
            answer.looks.len(),
            looks.len(),
            about()
        )
    });
}

/// Samples lie inside the pixel, each in a place of its own.
fn places(
    tally: &mut Tally,
    call: usize,
    work: &AdaptivePixel,
    answer: &AdaptiveAnswer,
    about: &impl Fn() -> String,
) {
    if answer.points.is_empty() {
        return;
    }
    tally.expect(Aspect::Placement);
    let outside = answer.points.iter().filter(|point| {
        (0..2).any(|axis| {
            let place = point[axis] * f64::from(work.film[axis]) - f64::from(work.pixel[axis]);
            !(-PLACE_BOUND..=1.0 + PLACE_BOUND).contains(&place)
        })
    });
    let (outside, all) = (outside.count(), answer.points.len());
    tally.judge(
        Aspect::Placement,
        call,
        outside == 0,
        outside as f64,
        || {
            format!(
                "{outside} of {all} points lie outside the pixel. {}",
                about()
            )
        },
    );
    let different: HashSet<_> = answer.points.iter().map(|p| p.map(f64::to_bits)).collect();
    let different = different.len();
    tally.judge(Aspect::Placement, call, different == all, 1e3, || {
        format!("only {different} of {all} points differ. {}", about())
    });
}
