//! Rounds in which each contender has one turn.

use super::{Clock, Contender, Measured, MissingReason, TIMED_PASSES, Timing, or_missing};
use crate::quartiles::Quartiles;
use base::GraderError;

/// The seconds of one unit, for each contender and each round; or why the contender is missing.
#[derive(Debug)]
pub(crate) struct Rounds(Vec<Result<Vec<f64>, MissingReason>>);

/// Target time of a pass: long enough for the resolution of the clock, short enough that most
/// passes are not interrupted. Shorter work is repeated.
const PASS_S: f64 = 300e-6;

/// Time after which no further pass of a turn is begun, so that a round ends before the machine's
/// speed changes.
const TURN_S: f64 = 20e-3;

impl Rounds {
    /// Times all contenders in `rounds` rounds. Every other round is in reverse order, and each
    /// round starts with another contender, so that none always follows the same one.
    pub(crate) fn measure(
        clock: &impl Clock,
        contenders: &mut [Contender],
        rounds: usize,
    ) -> Result<Rounds, GraderError> {
        let repeats: Vec<usize> = contenders
            .iter_mut()
            .map(|contender| repeats(clock, contender))
            .collect();
        let count = contenders.len();
        progress::expect(rounds as u64);
        let mut seconds: Vec<Result<Vec<f64>, MissingReason>> = vec![Ok(Vec::new()); count];
        for round in 0..rounds {
            for turn in 0..count {
                let turn = if round % 2 == 0 {
                    turn
                } else {
                    count - 1 - turn
                };
                let i = (turn + round / 2) % count;
                let Ok(own) = &mut seconds[i] else { continue };
                match or_missing(take_turn(clock, &mut contenders[i], repeats[i], round))? {
                    Ok(unit) => own.push(unit),
                    Err(missing) => seconds[i] = Err(missing),
                }
            }
            progress::advance(1);
        }
        Ok(Rounds(seconds))
    }

    /// Returns the seconds of contender `i` by round.
    pub(crate) fn seconds(&self, i: usize) -> Result<&[f64], MissingReason> {
        match &self.0[i] {
            Ok(seconds) => Ok(seconds),
            Err(missing) => Err(missing.clone()),
        }
    }

    /// Summarises contender `i`, compared with contender `base`.
    pub(crate) fn timing(&self, i: usize, base: usize) -> Result<Timing, MissingReason> {
        Ok(Timing::of(self.seconds(i)?, self.seconds(base)?))
    }
}

/// Returns how often work in this process is repeated in one pass.
fn repeats(clock: &impl Clock, contender: &mut Contender) -> usize {
    let Contender::Here { work, .. } = contender else {
        return 1;
    };
    work(0);
    let started = clock.seconds();
    work(0);
    // A clock of coarse resolution may measure nothing.
    let seconds = (clock.seconds() - started).max(1e-3 * PASS_S);
    (PASS_S / seconds).ceil().max(1.0) as usize
}

/// Times one unit of the contender's work.
fn take_turn(
    clock: &impl Clock,
    contender: &mut Contender,
    repeats: usize,
    round: usize,
) -> Measured<f64> {
    match contender {
        Contender::Here { work, units } => {
            let pass = || (0..repeats).for_each(|_| work(round));
            let seconds = time_after_warming(clock, pass);
            Ok(seconds / (repeats * *units) as f64)
        }
        Contender::Elsewhere(turn) => turn(round),
    }
}

/// Runs an untimed pass, then timed ones, and returns their median seconds.
fn time_after_warming(clock: &impl Clock, mut pass: impl FnMut()) -> f64 {
    pass();
    let begun = clock.seconds();
    let mut seconds = Vec::new();
    while seconds.is_empty() || (seconds.len() < TIMED_PASSES && clock.seconds() - begun < TURN_S) {
        let started = clock.seconds();
        pass();
        seconds.push(clock.seconds() - started);
    }
    Quartiles::of(seconds).median
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::timing::{Machine, missing};

    /// Three passes over one tree, and one over each of two others, as in `grader cost bvh`: names
    /// of the trees and seconds with a warm cache.
    const PASSES: [(&str, f64); 5] = [
        ("midpoint", 1.01),
        ("midpoint", 1.02),
        ("midpoint", 1.0),
        ("median", 1.3),
        ("SAH", 0.9),
    ];

    /// Measures the passes and what is `added`; returns the median ratios of the passes to the
    /// third one.
    fn ratios<'a>(machine: &'a Machine, added: Vec<Contender<'a>>) -> Vec<f64> {
        let passes = PASSES.map(|(tree, seconds)| machine.here(tree, seconds));
        let mut contenders: Vec<Contender> = passes.into_iter().chain(added).collect();
        let rounds = Rounds::measure(machine, &mut contenders, 20).unwrap();
        let ratio = |i| rounds.timing(i, 2).unwrap().ratio.median;
        (0..contenders.len()).map(ratio).collect()
    }

    fn assert_true_ratios(ratios: &[f64], tolerance: f64) {
        for ((tree, seconds), ratio) in PASSES.iter().zip(ratios) {
            assert!((ratio - seconds).abs() < tolerance, "{tree}: {ratio}");
        }
    }

    #[test]
    fn a_cold_cache_does_not_change_the_ranking() {
        // Each tree that another one has evicted takes 1.8 times as long. Three of the five passes
        // share a tree, so they seldom find it evicted, and the others always do.
        assert_true_ratios(&ratios(&Machine::default(), Vec::new()), 1e-9);
    }

    #[test]
    fn a_slow_tree_does_not_change_the_ranking() {
        let machine = Machine::default();
        let slow = vec![machine.here("slow", 40.0), machine.elsewhere("worker", 7.0)];
        let ratios = ratios(&machine, slow);
        assert_true_ratios(&ratios, 1e-9);
        assert!((ratios[5] - 40.0).abs() < 1e-9 && (ratios[6] - 7.0).abs() < 1e-9);
    }

    #[test]
    fn a_machine_that_becomes_slower_does_not_change_the_ranking() {
        // The last round takes about three times as long as the first one.
        let machine = Machine::that_slows_down(5e-3);
        assert_true_ratios(&ratios(&machine, Vec::new()), 0.03);
        assert!(machine.seconds() > 250.0);
    }

    #[test]
    fn short_work_is_repeated_until_the_clock_can_measure_it() {
        let machine = Machine::default();
        let mut calls = 0;
        let work = |_| {
            calls += 1;
            machine.run("data", 1e-6);
        };
        let rounds = Rounds::measure(&machine, &mut [Contender::here(10, work)], 2).unwrap();
        assert!((rounds.seconds(0).unwrap()[1] - 1e-7).abs() < 1e-12);
        // To choose the number of repeats it is called twice.
        assert_eq!(calls, 2 + 2 * (1 + TIMED_PASSES) * 300);
    }

    #[test]
    fn interruptions_of_a_pass_do_not_change_the_time() {
        let machine = Machine::default();
        let mut passes = 0;
        let work = |_| {
            passes += 1;
            // Another program runs for three times as long in two of five passes.
            let seconds = if passes % 5 < 2 { 4e-3 } else { 1e-3 };
            machine.run("data", seconds);
        };
        let rounds = Rounds::measure(&machine, &mut [Contender::here(1, work)], 10).unwrap();
        let ns = Timing::of(rounds.seconds(0).unwrap(), &[]).ns;
        assert!((ns.median - 1e6).abs() < 1.0 && ns.plus_minus() < 1.0);
    }

    #[test]
    fn a_contender_that_fails_does_not_stop_the_others() {
        let machine = Machine::default();
        let mut turns = 0;
        let broken = Contender::elsewhere(|_| {
            turns += 1;
            match turns {
                ..3 => Ok(1.0),
                _ => missing("it panics"),
            }
        });
        let mut contenders = [machine.here("a", 1.0), broken, machine.here("b", 2.0)];
        let rounds = Rounds::measure(&machine, &mut contenders, 5).unwrap();
        assert_eq!(rounds.seconds(0).unwrap().len(), 5);
        assert_eq!(rounds.seconds(1), Err("it panics".into()));
        assert_eq!(rounds.timing(2, 0).unwrap().ratio.median, 2.0);
        drop(contenders);
        assert_eq!(turns, 3, "it is not called again");
    }
}
