//! Timing of several contenders in turns, so that their ratios hold although the machine's speed
//! changes and although one of them leaves the caches to the next.
//!
//! Read [`Timing`] (the summary), then `contender` (what is timed, by which clock) and `rounds` (in
//! which order). All times of `grader cost` are measured by `Rounds::measure`.

mod contender;
mod rounds;
#[cfg(test)]
mod simulated;

pub(crate) use contender::{Clock, Contender, SystemClock, TIMED_PASSES, missing, or_missing};
pub use contender::{Measured, MissingReason, NotMeasured};
pub(crate) use rounds::Rounds;
#[cfg(test)]
pub(crate) use simulated::Machine;

use crate::quartiles::Quartiles;
use serde::{Deserialize, Serialize};

/// The time of a contender, and its ratio to that of the base: the contender that all are compared
/// with. Both are quartiles over the rounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Nanoseconds for one unit of work: a test, or a ray.
    pub ns: Quartiles,
    /// Ratio to the time of the base in the same round.
    pub ratio: Quartiles,
}

impl Timing {
    /// Returns the quartiles of seconds per unit, by round, and of their ratios to those of the
    /// base.
    pub(crate) fn of(seconds: &[f64], base: &[f64]) -> Timing {
        let ratios = seconds.iter().zip(base).map(|(own, base)| own / base);
        Timing {
            ns: Quartiles::of(seconds.iter().map(|s| 1e9 * s)),
            ratio: Quartiles::of(ratios),
        }
    }

    /// Whether this is certainly faster than `other`: their error bars, from quartile to quartile
    /// of the ratio, do not overlap.
    pub fn is_faster_than(&self, other: &Timing) -> bool {
        self.ratio.upper < other.ratio.lower
    }

    /// Whether neither of the two is certainly faster.
    pub fn ties_with(&self, other: &Timing) -> bool {
        !self.is_faster_than(other) && !other.is_faster_than(self)
    }

    /// Whether the time ties with that of the base, whose ratio is exactly 1.
    pub fn ties_with_base(&self) -> bool {
        (self.ratio.lower..=self.ratio.upper).contains(&1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slowdown_of_the_machine_is_no_difference() {
        // Both take twice as long in the last two rounds.
        let base = [10.0, 10.1, 9.9, 20.0, 20.2];
        let timing = Timing::of(&[10.1, 10.0, 10.0, 20.1, 20.0], &base);
        assert!((timing.ns.median - 10.1e9).abs() < 1.0);
        assert!((timing.ratio.median - 1.0).abs() < 0.02);
        assert!(timing.ties_with_base());
        assert!(timing.ties_with(&Timing::of(&base, &base)));
    }

    #[test]
    fn half_the_time_is_a_difference() {
        let base = [10.0, 10.1, 9.9];
        let timing = Timing::of(&[5.0, 5.1, 5.0], &base);
        assert!((timing.ratio.median - 0.5).abs() < 0.01);
        assert!(!timing.ties_with_base());
        assert!(timing.is_faster_than(&Timing::of(&base, &base)));
    }
}
