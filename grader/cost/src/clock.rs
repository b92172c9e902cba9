//! Timing many things in turns, so that a change of the machine's speed meets all of them.

use super::quartiles::Quartiles;
use super::report::Timing;
use std::time::Instant;

/// Nanoseconds of one test, round after round, for each of several things.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rounds {
    /// By thing, then by round.
    ns: Vec<Vec<f64>>,
}

/// How long a thing should run between two looks at the clock: long enough for the clock, short enough that all have
/// had their turn before the machine changes its mind.
const TURN_NS: f64 = 300_000.0;

impl Rounds {
    /// Lets all `passes` take turns `rounds` times, in another order each time; each runs `tests` tests a call, and
    /// as many calls a turn as make [`TURN_NS`].
    pub(crate) fn take(passes: &mut [kernels::Pass], tests: usize, rounds: usize) -> Rounds {
        let timed = |pass: &mut kernels::Pass, calls: usize| {
            let started = Instant::now();
            for _ in 0..calls {
                std::hint::black_box(pass());
            }
            started.elapsed().as_nanos() as f64 / calls as f64
        };
        // Warms caches and branch predictors, too.
        let calls: Vec<usize> = passes
            .iter_mut()
            .map(|pass| (TURN_NS / timed(pass, 2)).ceil().max(1.0) as usize)
            .collect();
        let mut ns = vec![Vec::new(); passes.len()];
        for round in 0..rounds {
            for turn in 0..passes.len() {
                let i = (turn + round) % passes.len();
                ns[i].push(timed(&mut passes[i], calls[i]) / tests as f64);
            }
        }
        Rounds { ns }
    }

    /// Appends the rounds of another take over the same things.
    pub(crate) fn extend(&mut self, more: Rounds) {
        self.ns.resize(more.ns.len().max(self.ns.len()), Vec::new());
        for (ns, more) in self.ns.iter_mut().zip(more.ns) {
            ns.extend(more);
        }
    }

    /// Appends a thing that was timed elsewhere in the same turns, round by round.
    pub(crate) fn push(&mut self, ns: Vec<f64>) {
        self.ns.push(ns);
    }

    /// Nanoseconds by thing, then by round.
    pub(crate) fn ns(&self) -> &[Vec<f64>] {
        &self.ns
    }

    /// The times of each thing, the first of them being the textbook's.
    pub(crate) fn timings(&self) -> Vec<Timing> {
        let textbook = self.ns.first().map_or(&[][..], |ns| ns);
        self.ns.iter().map(|ns| timing(ns, textbook)).collect()
    }
}

/// The middle and the quartiles' distance of one thing's rounds, alone and over those of the textbook.
pub(crate) fn timing(ns: &[f64], textbook: &[f64]) -> Timing {
    let ratios = ns.iter().zip(textbook).map(|(ns, textbook)| ns / textbook);
    let (ns, ratio) = (Quartiles::of(ns.iter().copied()), Quartiles::of(ratios));
    Timing {
        ns_median: ns.median,
        ns_spread: ns.spread(),
        ratio_to_textbook: ratio.median,
        ratio_spread: ratio.spread(),
        inside_noise: (ratio.median - 1.0).abs() <= ratio.spread(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slow_moment_of_the_machine_is_no_difference() {
        // Both take twice as long in the last two rounds.
        let textbook = [10.0, 10.1, 9.9, 20.0, 20.2];
        let other = [10.1, 10.0, 10.0, 20.1, 20.0];
        let timing = timing(&other, &textbook);
        assert_eq!(timing.ns_median, 10.1);
        assert!((timing.ratio_to_textbook - 1.0).abs() < 0.02);
        assert!(timing.inside_noise);
    }

    #[test]
    fn half_the_time_is_a_difference() {
        let timing = timing(&[5.0, 5.1, 5.0], &[10.0, 10.1, 9.9]);
        assert!((timing.ratio_to_textbook - 0.5).abs() < 0.01);
        assert!(!timing.inside_noise);
    }

    #[test]
    fn everything_takes_its_turn() {
        let pass = || Box::new(|| 1_usize) as kernels::Pass;
        let mut rounds = Rounds::take(&mut [pass(), pass()], 1, 3);
        rounds.extend(Rounds::take(&mut [pass(), pass()], 1, 2));
        rounds.push(vec![1.0; 5]);
        assert_eq!(
            rounds.ns.iter().map(Vec::len).collect::<Vec<_>>(),
            [5, 5, 5]
        );
    }
}
