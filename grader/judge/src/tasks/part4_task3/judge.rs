//! Judges Russian roulette.

use super::truth::survival;
use crate::tools::aspects::chance::{self, MIN_ESTIMATES};
use crate::tools::aspects::numbers;
use crate::tools::findings::{Aspect, Class, Findings};
use kit::Tally;
use wire::global::RouletteWork;
use wire::work::Xyz;

/// Relative error allowed in a throughput that was divided by `chance`: that of the division, and
/// that of a chance computed as 1 minus the probability to end, which rounds numbers near 1 twice.
pub(super) fn bound(chance: f64) -> f64 {
    (1e-15 / chance).max(1e-12)
}

/// Judges each call, and the mean of many.
pub(crate) fn roulette(findings: &mut Findings, work: &RouletteWork, answers: &[Option<Xyz>]) {
    let by_path = answers.chunks(work.numbers.len().max(1));
    for (path, (&(throughput, bounces), answers)) in work.paths.iter().zip(by_path).enumerate() {
        for (i, (u, answer)) in work.numbers.iter().zip(answers).enumerate() {
            let call = path * work.numbers.len() + i;
            one(findings, call, throughput, bounces, *u, *answer);
        }
        let channel = (0..3).find(|&c| throughput[c] > 0.0);
        if let (Some(channel), true) = (channel, answers.len() >= MIN_ESTIMATES) {
            let counts = answers.iter().map(|a| a.map_or(0.0, |t| t[channel]));
            let numbers: Tally = counts.collect();
            chance::mean(
                findings,
                "throughputs (0 for paths that end)",
                &numbers,
                throughput[channel],
            );
        }
    }
}

/// The right throughput of a path that continues; `None` if it ends.
pub(super) fn right(throughput: Xyz, bounces: u32, u: f64) -> Option<Xyz> {
    let (chance, survivor) = survival(throughput, bounces);
    (u < chance).then_some(survivor)
}

fn one(
    findings: &mut Findings,
    call: usize,
    throughput: Xyz,
    bounces: u32,
    u: f64,
    answer: Option<Xyz>,
) {
    let right = right(throughput, bounces, u);
    let about = || format!("play_roulette({throughput:?}, {bounces}, {u:?})");
    findings.expect(Aspect::Survival);
    let class = match (answer, right) {
        (Some(_), None) => Some(Class::FalseHit),
        (None, Some(_)) => Some(Class::FalseMiss),
        _ => None,
    };
    findings.judge_class(Aspect::Survival, call, class, 1.0, || {
        format!(
            "{}: your result: {answer:?}; the path continues with the probability {:?}; expected: {}",
            about(),
            survival(throughput, bounces).0,
            if right.is_some() {
                "it continues"
            } else {
                "it ends"
            }
        )
    });
    let Some(right) = right else { return };
    findings.expect(Aspect::Throughput);
    if let Some(answered) = answer {
        let aspect = Aspect::Throughput;
        let bound = bound(survival(throughput, bounces).0);
        numbers::colour(findings, aspect, call, answered, right, bound, about);
    }
}
