//! Interleaved timing of several kernels, so that a change of the machine's speed affects all of
//! them.

use super::quartiles::Quartiles;
use super::report::Timing;
use std::time::Instant;

/// The time of one test in nanoseconds, for each kernel and each round.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rounds {
    /// By kernel, then by round.
    ns: Vec<Vec<f64>>,
}

/// Target time of one measurement: long enough for the resolution of the clock, short enough that a
/// round ends before the machine's speed changes.
const TURN_NS: f64 = 300_000.0;

impl Rounds {
    /// Times all `passes` in `rounds` rounds, in another order each round. A pass executes `tests`
    /// tests per call, and is called often enough to run for [`TURN_NS`].
    pub(crate) fn measure(passes: &mut [kernels::Pass], tests: usize, rounds: usize) -> Rounds {
        let timed = |pass: &mut kernels::Pass, calls: usize| {
            let started = Instant::now();
            for _ in 0..calls {
                std::hint::black_box(pass());
            }
            started.elapsed().as_nanos() as f64 / calls as f64
        };
        // This also warms up caches and branch predictors.
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

    /// Appends the rounds of another measurement of the same kernels.
    pub(crate) fn extend(&mut self, more: Rounds) {
        self.ns.resize(more.ns.len().max(self.ns.len()), Vec::new());
        for (ns, more) in self.ns.iter_mut().zip(more.ns) {
            ns.extend(more);
        }
    }

    /// Appends a kernel that was timed elsewhere in the same turns.
    pub(crate) fn push(&mut self, ns: Vec<f64>) {
        self.ns.push(ns);
    }

    /// Returns the nanoseconds by kernel, then by round.
    pub(crate) fn ns(&self) -> &[Vec<f64>] {
        &self.ns
    }

    /// Summarises each kernel; the first one is the textbook's.
    pub(crate) fn timings(&self) -> Vec<Timing> {
        let textbook = self.ns.first().map_or(&[][..], |ns| ns);
        self.ns.iter().map(|ns| timing(ns, textbook)).collect()
    }
}

/// Returns the median and the interquartile range of a kernel's rounds, and of their ratios to the
/// textbook's rounds.
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
    fn a_slowdown_of_the_machine_is_no_difference() {
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
    fn every_kernel_is_timed_in_every_round() {
        let pass = || Box::new(|| 1_usize) as kernels::Pass;
        let mut rounds = Rounds::measure(&mut [pass(), pass()], 1, 3);
        rounds.extend(Rounds::measure(&mut [pass(), pass()], 1, 2));
        rounds.push(vec![1.0; 5]);
        assert_eq!(
            rounds.ns.iter().map(Vec::len).collect::<Vec<_>>(),
            [5, 5, 5]
        );
    }
}
