//! Whether the calls whose tests the grader counts make more tests than the others.
//!
//! Which calls those are is drawn for each run. So the ranks of their counts among all counts of a
//! case are those of a random sample, whatever the code does, unless it does more in these calls,
//! or changes what is counted in the others. Wilcoxon, "Individual comparisons by ranking methods",
//! 1945.

/// With honest code, a sum of ranks lies so many standard deviations above its mean once in a
/// hundred million runs at most.
const CERTAIN: f64 = 6.0;

/// The sum of the ranks of the chosen counts, over several cases.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Excess {
    /// How far the sum lies above its mean.
    above: f64,
    variance: f64,
}

impl Excess {
    /// Adds the calls of a case: the tests of each, and whether it was chosen at random.
    pub(super) fn add(&mut self, calls: &[(u64, bool)]) {
        let chosen = calls.iter().filter(|(_, is_chosen)| *is_chosen).count() as f64;
        let all = calls.len() as f64;
        if all < 2.0 {
            return;
        }
        let middle = (all + 1.0) / 2.0;
        let mut sorted = calls.to_vec();
        sorted.sort_unstable();
        let (mut squares, mut rank) = (0.0, 0.0);
        for equal in sorted.chunk_by(|(a, _), (b, _)| a == b) {
            let count = equal.len() as f64;
            // Equal counts share the mean of their ranks.
            let above = rank + (count + 1.0) / 2.0 - middle;
            rank += count;
            squares += count * above * above;
            let chosen = equal.iter().filter(|(_, is_chosen)| *is_chosen).count() as f64;
            self.above += chosen * above;
        }
        self.variance += chosen * (all - chosen) / (all * (all - 1.0)) * squares;
    }

    /// Whether the chosen calls make more tests, beyond all chance.
    pub(super) fn is_certain(self) -> bool {
        self.above > CERTAIN * self.variance.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::hash::{BuildHasher, RandomState};

    /// The counts of `count` calls, of which every fourth is chosen at random.
    fn calls(count: u64, tests: impl Fn(u64, bool) -> u64) -> Vec<(u64, bool)> {
        let draw = RandomState::new();
        let chosen = (0..count).map(|call| draw.hash_one(call) % 4 == 0);
        let each = (0..count).zip(chosen);
        each.map(|(call, is_chosen)| (tests(call, is_chosen), is_chosen))
            .collect()
    }

    fn is_certain(cases: u64, count: u64, tests: impl Fn(u64, bool) -> u64) -> bool {
        let mut excess = Excess::default();
        for _ in 0..cases {
            excess.add(&calls(count, &tests));
        }
        excess.is_certain()
    }

    #[test]
    fn honest_counts_are_never_an_excess() {
        for _ in 0..2000 {
            assert!(!is_certain(10, 50, |call, _| call * call % 97));
            // Nearly all equal, and some very large.
            assert!(!is_certain(10, 50, |call, _| u64::from(call % 20 == 0) * 1000));
            assert!(!is_certain(10, 50, |_, _| 7));
        }
        assert!(!is_certain(0, 0, |_, _| 7));
        assert!(!is_certain(5, 1, |_, _| 7));
    }

    #[test]
    fn counts_that_are_changed_where_nobody_looks_are_an_excess() {
        for _ in 0..100 {
            let cheats = |call: u64, is_chosen| if is_chosen { 400 } else { 3 + call % 30 };
            assert!(is_certain(10, 50, cheats));
            assert!(is_certain(1, 200, cheats));
            // Twice as many tests are enough.
            assert!(is_certain(10, 100, |call, is_chosen| {
                (20 + call % 30) * if is_chosen { 2 } else { 1 }
            }));
        }
    }
}
