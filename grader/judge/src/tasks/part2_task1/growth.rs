//! Judges how the time to build a tree grows with its size.
//!
//! Time is noisy, the verdict is not. For 16 times as many primitives a build in O(n log n) takes
//! 21 times as long, up to 37 times as its lists outgrow the caches; one in O(n²) 160 to 256 times.
//! [`MAX_EXPONENT`] is at 84 times. Of each size the fastest of several builds counts, in processor
//! time, and a build that is fast in itself passes.

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check};
use crate::tools::findings::{Aspect, Class, Findings};
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::Fields;
use crate::tools::snapshot::{forms, number};
use wire::answer::BuildGrowthAnswer;
use wire::kind;
use wire::work::BuildGrowthWork;

/// The time may grow as n to this power. The builds of the correct variants were measured to grow
/// as n^1.2 to n^1.3, lists that are searched or shifted once for each primitive as n^1.8 to n^2.2.
const MAX_EXPONENT: f64 = 1.6;

/// A build that takes fewer seconds than this passes: no quadratic build over 200,000 primitives is
/// as fast, since it looks at 10¹⁰ pairs.
const ALWAYS_FAST: f64 = 0.25;

/// The largest size is compared with the one this many sizes below, or with the smallest.
const SIZES_BETWEEN: usize = 2;

/// A tree with less than one node for this many primitives is not timed: one leaf over everything
/// is built fast.
const NO_TREE: u32 = 1000;

/// The number of sizes that are always built.
const ALWAYS_BUILT: usize = 2;

impl Check for kind::BuildGrowth {
    const MAIN: &'static [Aspect] = &[Aspect::BuildTime];

    /// Three rounds of quadratic code, which ends with a tree that takes 4 s.
    const LIMIT_MS: u64 = 30_000;

    const NOT_MOVED: &'static str = "the worker draws the boxes, and only times are judged";

    fn calls(_: &BuildGrowthWork) -> usize {
        1
    }

    /// Times are compared with each other.
    fn only_call(_: &BuildGrowthWork, _: usize) -> Option<BuildGrowthWork> {
        None
    }

    fn fits(work: &BuildGrowthWork, answer: &BuildGrowthAnswer) -> Result<(), String> {
        let (built, times) = (answer.nodes.len(), answer.seconds.len());
        let most = work.sizes.len();
        if built != times || !(ALWAYS_BUILT..=most).contains(&built) {
            return Err(format!(
                "expected the nodes and the times of {ALWAYS_BUILT} to {most} trees, found {built} and {times}"
            ));
        }
        let is_time = |s: &f64| s.is_finite() && *s >= 0.0;
        match answer.seconds.iter().find(|s| !is_time(s)) {
            Some(wrong) => Err(format!("a build has the time {wrong} s")),
            None => Ok(()),
        }
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        work: &BuildGrowthWork,
        answer: &BuildGrowthAnswer,
    ) {
        judge(findings, work, answer);
    }

    /// The nodes of the trees that are always built. Times differ between runs.
    fn lines(work: &BuildGrowthWork, answer: &BuildGrowthAnswer) -> Option<Content> {
        let sizes = work.sizes.iter().zip(&answer.nodes).take(ALWAYS_BUILT);
        let lines = sizes.map(|(size, nodes)| {
            let nodes = vec![number("nodes", f64::from(*nodes))];
            let size = vec![number("primitives", f64::from(*size))];
            forms(size, nodes.clone(), nodes)
        });
        Some((Vec::new(), lines.collect()))
    }

    fn input(_: &BuildGrowthWork, _: usize) -> Option<String> {
        None
    }

    fn exact(_: &BuildGrowthWork, _: bool, _: &[u32]) -> Option<Vec<Fields>> {
        None
    }

    fn shown(
        _: &BuildGrowthWork,
        _: Tier,
        _: bool,
        _: usize,
        _: Option<&BuildGrowthAnswer>,
    ) -> Option<ShownCall> {
        None
    }
}

/// Judges the growth between the two sizes that are compared.
fn judge(findings: &mut Findings, work: &BuildGrowthWork, answer: &BuildGrowthAnswer) {
    findings.expect(Aspect::BuildTime);
    let built: Vec<(f64, f64)> = work
        .sizes
        .iter()
        .zip(&answer.seconds)
        .map(|(size, seconds)| (f64::from(*size), *seconds))
        .collect();
    let few_nodes = |(size, nodes): (&u32, &u32)| *nodes < size / NO_TREE;
    // Fast, but no tree: the other cases judge that.
    if work.sizes.iter().zip(&answer.nodes).any(few_nodes) {
        return;
    }
    let [.., (large, slow)] = built[..] else {
        return;
    };
    let (small, fast) = built[built.len().saturating_sub(1 + SIZES_BETWEEN)];
    let times = slow / fast;
    let exponent = times.ln() / (large / small).ln();
    let right = slow < ALWAYS_FAST || exponent <= MAX_EXPONENT;
    let class = (!right).then_some(Class::Named("quadratic"));
    findings.judge_class(Aspect::BuildTime, 0, class, exponent, || {
        let linearithmic = large * large.ln() / (small * small.ln());
        format!(
            "your result: a tree over {large} primitives takes {slow:.2} s, {times:.0} times as long as one over {small}: the time grows as n^{exponent:.1}; expected: about {linearithmic:.0} times as long, since each level of the tree looks at each primitive once. Is a list searched with `contains`, or shifted with `remove(0)` or `insert(0, ...)`, once for each primitive?"
        )
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::LazyLock;

    static WORK: LazyLock<BuildGrowthWork> = LazyLock::new(|| {
        let spec = crate::cases::of("part2.task1", 0)
            .into_iter()
            .find(|spec| spec.name == "growth_of_the_build_time");
        match spec.map(|spec| spec.work) {
            Some(wire::Work::BuildGrowth(work)) => work,
            other => panic!("{other:?}"),
        }
    });

    /// Whether a build passes whose time over n primitives is `seconds(n)`; as in the worker, no
    /// size is built after one that takes too long.
    fn passes(seconds: impl Fn(f64) -> f64) -> bool {
        let mut answer = BuildGrowthAnswer {
            nodes: Vec::new(),
            seconds: Vec::new(),
        };
        for size in &WORK.sizes {
            answer.nodes.push(2 * size - 1);
            answer.seconds.push(seconds(f64::from(*size)));
            let last = answer.seconds.last().copied().unwrap_or_default();
            if answer.seconds.len() >= ALWAYS_BUILT && 1e3 * last > WORK.enough_ms as f64 {
                break;
            }
        }
        kind::BuildGrowth::fits(&WORK, &answer).expect("it fits");
        let mut findings = Findings::default();
        judge(&mut findings, &WORK, &answer);
        findings.into_vec()[0].passed()
    }

    /// From a fast machine to a slow one, or code that is not optimised: nanoseconds for each
    /// primitive and level.
    const SPEEDS: [f64; 5] = [5e-9, 2e-8, 1e-7, 1e-6, 1e-5];

    #[test]
    fn a_build_in_n_log_n_passes_even_if_large_trees_are_slowed_down_three_times() {
        for speed in SPEEDS {
            assert!(passes(|n| speed * n * n.log2()));
            let slowed_down = |n: f64| if n > 100_000.0 { 3.0 } else { 1.0 };
            assert!(passes(|n| slowed_down(n) * speed * n * n.log2()));
            // Each level sorts its list.
            assert!(passes(|n| speed * n * n.log2().powi(2)));
            assert!(passes(|n| speed * n.powf(1.5)));
        }
    }

    #[test]
    fn a_quadratic_part_fails_even_if_it_is_as_fast_as_memory() {
        for speed in SPEEDS {
            // A fiftieth of the time of a step of the rest for each pair.
            assert!(!passes(|n| speed * (n * n.log2() + 0.02 * n * n)));
            assert!(!passes(|n| speed * n * n));
        }
    }

    #[test]
    fn one_leaf_over_everything_earns_nothing() {
        let answer = BuildGrowthAnswer {
            nodes: vec![1; WORK.sizes.len()],
            seconds: vec![1e-3; WORK.sizes.len()],
        };
        let mut findings = Findings::default();
        judge(&mut findings, &WORK, &answer);
        assert!(!findings.into_vec()[0].passed());
    }

    #[test]
    fn times_of_other_sizes_do_not_fit() {
        let fits = |nodes: usize, seconds: &[f64]| {
            let answer = BuildGrowthAnswer {
                nodes: vec![9; nodes],
                seconds: seconds.to_vec(),
            };
            kind::BuildGrowth::fits(&WORK, &answer).is_ok()
        };
        assert!(fits(2, &[0.1, 0.2]));
        assert!(!fits(1, &[0.1]) && !fits(2, &[0.1]) && !fits(9, &[0.1; 9]));
        assert!(!fits(2, &[0.1, f64::NAN]) && !fits(2, &[-0.1, 0.1]));
    }
}
