//! Judging Russian roulette.

use crate::chance::{self, MIN_ESTIMATES};
use crate::numbers;
use crate::tally::{Aspect, Class, Tally};
use kit::Tally as SampleTally;
use wire::global::RouletteWork;
use wire::work::Xyz;

/// Bounces that every path makes before it plays.
const FREE_BOUNCES: u32 = 3;

/// A division and its rounding.
pub(crate) const BOUND: f64 = 1e-12;

/// Judges each game, and over many of them their mean.
pub(crate) fn roulette(tally: &mut Tally, work: &RouletteWork, answers: &[Option<Xyz>]) {
    let games = answers.chunks(work.numbers.len().max(1));
    for (path, (&(throughput, bounces), answers)) in work.paths.iter().zip(games).enumerate() {
        for (i, (u, answer)) in work.numbers.iter().zip(answers).enumerate() {
            let call = path * work.numbers.len() + i;
            one(tally, call, throughput, bounces, *u, *answer);
        }
        let channel = (0..3).find(|&c| throughput[c] > 0.0);
        if let (Some(channel), true) = (channel, answers.len() >= MIN_ESTIMATES) {
            let counts = answers.iter().map(|a| a.map_or(0.0, |t| t[channel]));
            let numbers: SampleTally = counts.collect();
            chance::mean(
                tally,
                "throughputs, 0 for paths that ended,",
                &numbers,
                throughput[channel],
            );
        }
    }
}

/// The probability with which a path goes on.
fn chance(throughput: Xyz, bounces: u32) -> f64 {
    let brightest = throughput.into_iter().fold(0.0, f64::max);
    match bounces {
        0..=FREE_BOUNCES if brightest > 0.0 => 1.0,
        _ => brightest.min(1.0),
    }
}

/// The throughput to go on with, if the path does.
pub(crate) fn right(throughput: Xyz, bounces: u32, u: f64) -> Option<Xyz> {
    let chance = chance(throughput, bounces);
    (u < chance).then(|| throughput.map(|channel| channel / chance))
}

fn one(tally: &mut Tally, call: usize, throughput: Xyz, bounces: u32, u: f64, answer: Option<Xyz>) {
    let right = right(throughput, bounces, u);
    let about = || format!("play_roulette({throughput:?}, {bounces}, {u:?})");
    tally.expect(Aspect::Survival);
    let class = match (answer, right) {
        (Some(_), None) => Some(Class::FalseHit),
        (None, Some(_)) => Some(Class::FalseMiss),
        _ => None,
    };
    tally.judge_class(Aspect::Survival, call, class, 1.0, || {
        format!(
            "{} gives {answer:?}; the path goes on with the probability {:?}, here {}",
            about(),
            chance(throughput, bounces),
            if right.is_some() {
                "it does"
            } else {
                "it does not"
            }
        )
    });
    let Some(right) = right else { return };
    tally.expect(Aspect::Throughput);
    if let Some(answered) = answer {
        let aspect = Aspect::Throughput;
        numbers::colour(tally, aspect, call, answered, right, BOUND, about);
    }
}
