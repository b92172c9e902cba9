//! Judges the arguments with which a path calls roulette.

use super::judge::SUM_BOUND;
use super::truth::Right;
use crate::plural;
use crate::tools::aspects::numbers::same_colour;
use crate::tools::call_text::{all_or_none, point};
use crate::tools::findings::{Aspect, Class, Findings, Message};
use kit::{Frame, Vec3};
use wire::global::{PathAnswer, ScriptedPath, Step};
use wire::light::BsdfSample;
use wire::work::Xyz;

/// The arguments of a call of roulette: throughput, bounces, random number.
type RouletteCall = ([f64; 3], u32, f64);

/// A bounce of a path: the throughput before it, the sample, and the local `wo`.
struct Bounce<'a> {
    before: Vec3,
    sample: &'a BsdfSample,
    wo: Vec3,
}

/// Computes a throughput after a bounce.
type Throughput = fn(&Bounce<'_>) -> Vec3;

/// The throughputs that common mistakes compute.
const KNOWN_MISTAKES: [(&str, Throughput); 8] = [
    ("before the bounce", |bounce| bounce.before),
    ("the weight alone", weight),
    ("the weight added", |bounce| bounce.before + weight(bounce)),
    ("without the cosine", |bounce| {
        bounce.before * f(bounce) / bounce.sample.pdf
    }),
    ("without the pdf", |bounce| {
        bounce.before * f(bounce) * bounce.sample.wi[2].abs()
    }),
    ("times the pdf", |bounce| {
        bounce.before * f(bounce) * bounce.sample.wi[2].abs() * bounce.sample.pdf
    }),
    ("the cosine of wo", |bounce| {
        bounce.before * f(bounce) * bounce.wo.z.abs() / bounce.sample.pdf
    }),
    ("a negative cosine", |bounce| {
        bounce.before * f(bounce) * bounce.sample.wi[2] / bounce.sample.pdf
    }),
];

/// The weight of the sample alone.
fn weight(bounce: &Bounce<'_>) -> Vec3 {
    f(bounce) * bounce.sample.wi[2].abs() / bounce.sample.pdf
}

fn f(bounce: &Bounce<'_>) -> Vec3 {
    bounce.sample.f.into()
}

/// Judges the calls of roulette: each has the throughput after the new bounce.
pub(crate) fn judge(
    findings: &mut Findings,
    call: usize,
    path: &ScriptedPath,
    answer: &PathAnswer,
    right: &Right,
    about: &impl Fn() -> String,
) {
    let bounces: Vec<Bounce<'_>> = right
        .bounces
        .iter()
        .filter_map(|bounce| {
            let step = &path.steps[bounce.surface];
            Some(Bounce {
                before: bounce.before.into(),
                sample: step.sample.as_ref()?,
                wo: local(step, -Vec3::from(right.directions[bounce.surface])),
            })
        })
        .collect();
    let wanted: Vec<Vec3> = right
        .bounces
        .iter()
        .map(|bounce| bounce.after.into())
        .collect();
    findings.expect(Aspect::Throughput);
    let off = answer.roulette_calls.len().abs_diff(wanted.len()) as f64;
    let class = match off == 0.0 {
        true => class_of_calls(path, &answer.roulette_calls, &bounces, &wanted),
        false => Some(Class::of_size(1.0 + off)),
    };
    findings.judge_class(Aspect::Throughput, call, class, 1.0 + off, || {
        let throughputs = answer.roulette_calls.iter().flat_map(|call| call.0);
        let show = |throughput: Xyz, bounces: u32| {
            let bounces = plural(bounces, "bounce", "bounces");
            format!("throughput {} after {bounces}", point(throughput))
        };
        let calls = answer.roulette_calls.iter();
        let right = wanted.iter().zip(1..);
        Message::new(format!(
            "your calls of roulette: {}; expected: {}",
            all_or_none(calls.map(|call| show(call.0, call.1))),
            all_or_none(right.map(|(after, bounces)| show(after.to_array(), bounces)))
        ))
        .compares(throughputs, wanted.iter().flat_map(Vec3::to_array))
        .asked(about())
    });
}

fn local(step: &Step, d: Vec3) -> Vec3 {
    Frame::around(step.n.into()).to_local(d)
}

/// The class of the first wrong call, where the number of calls is right; `None` if all are right.
fn class_of_calls(
    path: &ScriptedPath,
    calls: &[RouletteCall],
    bounces: &[Bounce<'_>],
    wanted: &[Vec3],
) -> Option<Class> {
    let is = |game: &RouletteCall, right: Vec3| same_colour(game.0, right.into(), SUM_BOUND);
    let throughputs = calls.iter().zip(bounces).zip(wanted);
    for ((game, bounce), right) in throughputs {
        if is(game, *right) {
            continue;
        }
        let mut known_mistakes = KNOWN_MISTAKES.iter();
        let named = known_mistakes.find(|(_, wrong)| is(game, wrong(bounce)));
        return Some(named.map_or(Class::Wrong, |(name, _)| Class::Named(name)));
    }
    let counts = |bounces_at: &dyn Fn(u32) -> u32| {
        let mut numbered = (1..).zip(calls);
        numbered.all(|(number, game)| game.1 == bounces_at(number))
    };
    if counts(&|number| number) {
        None
    } else if counts(&|number| number - 1) {
        Some(Class::Named("bounces from 0"))
    } else if counts(&|number| path.max_depth - number) {
        Some(Class::Named("rays left"))
    } else {
        Some(Class::Named("bounces miscounted"))
    }
}
