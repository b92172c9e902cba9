//! Judges how the time to build a tree grows with its size.
//!
//! What quadratic code does too often, a search with `contains` or a shift with `remove(0)`, happens
//! in the standard library and in lists of plain numbers: no input and no allocator counts it. So
//! time is judged, and only for extra credit. No load of the machine may cost correct code points:
//!
//! - Each build is timed in processor time between two runs of a control, which sorts as many boxes
//!   at each level of a tree and so reads and writes as much memory.
//! - A build is quadratic only if in every round the largest tree takes more than [`FAST`] times as
//!   long as the slower control, and more than n^[`MAX_EXCESS`] times more than a small tree does
//!   beside the faster control. One round without either is enough to pass.
//! - If the controls differ by more than [`STEADY`], the machine is busy: nothing is judged.
//!
//! With [`FAST`] and the growth from 3,125 to 200,000 primitives, as multiples of the control, on two
//! cores with 20 programs: sorting at each level 0.8, growth 0.8; sorting along three axes 3.3, 0.8;
//! insertion with a search 2.4, 0.5; PLOC 0.9, 0.2. Lists that are searched or shifted once for each
//! primitive: 4.7 to 5.9, growth 3.5 to 4.2. The bounds are 3 and 2.3.

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check};
use crate::tools::findings::{Aspect, Class, Findings};
use crate::tools::snapshot::Content;
use crate::tools::snapshot::{forms, number};
use wire::answer::{BuildGrowthAnswer, BuildTime};
use wire::kind;
use wire::work::BuildGrowthWork;

/// A build that takes at most this many times as long as the control passes.
pub(super) const FAST: f64 = 3.0;

/// The time may grow as n to this power times the growth of the control.
const MAX_EXCESS: f64 = 0.2;

/// The slowest control over the largest size takes at most this many times as long as the fastest,
/// if the machine is not busy.
const STEADY: f64 = 1.5;

/// Said if the controls differ.
const BUSY: &str =
    "the machine is busy: equal work takes different times, so how the time grows is not judged";

/// A tree with less than one node for this many primitives is not timed: one leaf over everything
/// is built fast.
const NO_TREE: u32 = 1000;

/// The number of sizes that are always built.
const ALWAYS_BUILT: usize = 2;

impl Check for kind::BuildGrowth {
    const MAIN: &'static [Aspect] = &[Aspect::BuildTime];

    /// Correct code takes at most 8 s in three rounds, on a machine ten times as slow 80 s.
    const LIMIT_MS: u64 = 120_000;

    const NOT_MOVED: &'static str = "the worker draws the boxes, and only times are judged";

    fn calls(_: &BuildGrowthWork) -> usize {
        1
    }

    fn fits(work: &BuildGrowthWork, answer: &BuildGrowthAnswer) -> Result<(), String> {
        let (built, most) = (answer.nodes.len(), work.sizes.len());
        if !(ALWAYS_BUILT..=most).contains(&built) {
            return Err(format!(
                "expected {ALWAYS_BUILT} to {most} trees, found {built}"
            ));
        }
        let rounds = 1..=work.rounds as usize;
        if !rounds.contains(&answer.rounds.len()) {
            return Err(format!(
                "expected 1 to {} rounds, found {}",
                work.rounds,
                answer.rounds.len()
            ));
        }
        if let Some(round) = answer.rounds.iter().find(|round| round.len() != built) {
            return Err(format!(
                "expected the times of {built} trees in each round, found {}",
                round.len()
            ));
        }
        let times = answer.rounds.iter().flatten();
        let mut seconds = times.flat_map(|time| [time.seconds, time.control[0], time.control[1]]);
        match seconds.find(|s| !s.is_finite() || *s < 0.0) {
            Some(wrong) => Err(format!("a build or its control has the time {wrong} s")),
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
}

/// A round in which the largest tree was built slowly, and slower in proportion than a small one.
struct SlowRound {
    /// How many times as long as their controls the smallest and the largest tree took.
    times: [f64; 2],
    /// The time of the largest tree grows as n to this power times the growth of the control.
    excess: f64,
    seconds: f64,
}

impl SlowRound {
    /// `None` if the round shows no quadratic build.
    fn of(work: &BuildGrowthWork, times: &[BuildTime]) -> Option<SlowRound> {
        let [(small, first), .., (large, last)] =
            Vec::from_iter(work.sizes.iter().copied().zip(times))[..]
        else {
            return None;
        };
        let least = first.seconds / first.control[0].min(first.control[1]);
        let most = last.seconds / last.control[0].max(last.control[1]);
        let excess = (most / least).ln() / (f64::from(large) / f64::from(small)).ln();
        // A clock that is too coarse gives no finite number.
        let is_slow = !last.is_within(work.fast) && excess.is_finite() && excess > MAX_EXCESS;
        is_slow.then_some(SlowRound {
            times: [least, most],
            excess,
            seconds: last.seconds,
        })
    }
}

/// Whether the controls of the largest size took about the same time in all rounds.
fn is_steady(rounds: &[Vec<BuildTime>]) -> bool {
    let last = rounds.iter().filter_map(|round| round.last());
    let controls = || last.clone().flat_map(|time| time.control);
    let slowest = controls().fold(0.0, f64::max);
    slowest <= STEADY * controls().fold(f64::INFINITY, f64::min)
}

/// Judges the growth from the smallest to the largest size.
fn judge(findings: &mut Findings, work: &BuildGrowthWork, answer: &BuildGrowthAnswer) {
    findings.expect(Aspect::BuildTime);
    let few_nodes = |(size, nodes): (&u32, &u32)| *nodes < size / NO_TREE;
    // Fast, but no tree: the other cases judge that.
    if work.sizes.iter().zip(&answer.nodes).any(few_nodes) {
        return;
    }
    let rounds = answer.rounds.iter();
    let slow: Vec<_> = rounds.map(|times| SlowRound::of(work, times)).collect();
    let Some(slow) = slow.into_iter().collect::<Option<Vec<SlowRound>>>() else {
        findings.judge_class(Aspect::BuildTime, 0, None, 0.0, String::new);
        return;
    };
    if !is_steady(&answer.rounds) {
        findings.leave_undecided(Aspect::BuildTime, 0, BUSY);
        return;
    }
    let least = slow.iter().min_by(|a, b| a.excess.total_cmp(&b.excess));
    let Some(SlowRound {
        times: [small, large],
        excess,
        seconds,
    }) = least
    else {
        return;
    };
    let [first, .., last] = work.sizes[..answer.nodes.len()] else {
        return;
    };
    findings.judge_class(Aspect::BuildTime, 0, Some(Class::Named("quadratic")), *excess, || {
        format!(
            "your result: a tree over {last} primitives takes {seconds:.2} s, {large:.1} times as long as sorting as many boxes at each level; over {first} primitives {small:.1} times. Expected: about the same multiple for both, since each level of the tree looks at each primitive once. Is a list searched with `contains`, or shifted with `remove(0)` or `insert(0, ...)`, once for each primitive?"
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

    /// What is found if a build over n primitives takes `seconds(n)`, and the load slows round `r`
    /// down as `load(n, r)` says: build and control. As in the worker, no size is built after one
    /// that takes too long, and no round follows a fast one.
    fn found(
        seconds: impl Fn(f64) -> f64,
        load: impl Fn(f64, usize) -> [f64; 3],
    ) -> (bool, Option<&'static str>) {
        let mut answer = BuildGrowthAnswer {
            nodes: Vec::new(),
            rounds: Vec::new(),
        };
        for round in 0..WORK.rounds as usize {
            let time = |n: f64| {
                let [before, build, after] = load(n, round);
                BuildTime {
                    seconds: build * seconds(n),
                    control: [before, after].map(|slower| slower * control(n)),
                }
            };
            let times: Vec<BuildTime> = WORK.sizes.iter().map(|n| time(f64::from(*n))).collect();
            let most = times[1..]
                .iter()
                .position(|time| !time.is_within(WORK.enough));
            let built = most.map_or(times.len(), |at| at + 2);
            answer.nodes = WORK.sizes[..built].iter().map(|n| 2 * n - 1).collect();
            let is_fast = times[built - 1].is_within(WORK.fast);
            answer.rounds.push(times[..built].to_vec());
            if is_fast {
                break;
            }
        }
        kind::BuildGrowth::fits(&WORK, &answer).expect("it fits");
        let mut findings = Findings::default();
        judge(&mut findings, &WORK, &answer);
        let found = &findings.into_vec()[0];
        (found.passed(), found.undecided)
    }

    /// The seconds of the control on a machine on which a step takes 2 ns.
    fn control(n: f64) -> f64 {
        2e-9 * n * n.log2().powi(2)
    }

    fn quiet(_: f64, _: usize) -> [f64; 3] {
        [1.0; 3]
    }

    /// How many times as slow as the control correct code may be.
    const SLOW: [f64; 5] = [0.1, 0.5, 1.0, 10.0, 100.0];

    #[test]
    fn a_build_that_is_not_quadratic_passes_at_any_speed() {
        for slow in SLOW {
            assert_eq!(found(|n| slow * control(n), quiet), (true, None));
            assert_eq!(found(|n| slow * 3e-8 * n * n.log2(), quiet), (true, None));
            // Large trees outgrow the caches.
            let caches = |n: f64| if n > 100_000.0 { 2.0 } else { 1.0 };
            assert_eq!(
                found(|n| slow * caches(n) * control(n), quiet),
                (true, None)
            );
        }
    }

    #[test]
    fn quadratic_builds_fail() {
        for share in [1e-10, 1e-9, 1e-8] {
            let (passed, undecided) = found(|n| 0.5 * control(n) + share * n * n, quiet);
            assert_eq!((passed, undecided), (false, None), "{share}");
        }
    }

    /// Other programs slow large trees down, as long as the control around them or for a while.
    #[test]
    fn no_load_makes_a_correct_build_fail() {
        let large = |n: f64| n > 100_000.0;
        for slow in SLOW {
            let build = |n: f64| slow * control(n);
            let all_the_time = |n: f64, _: usize| if large(n) { [9.0; 3] } else { [1.0; 3] };
            assert!(found(build, all_the_time).0);
            let except_one_round = |n: f64, round: usize| match (large(n), round) {
                (true, 0 | 2) => [1.0, 50.0, 1.0],
                _ => [1.0; 3],
            };
            assert!(found(build, except_one_round).0);
        }
        // In each round, the build and one of its controls.
        let bursts = |n: f64, _: usize| if large(n) { [1.0, 50.0, 2.0] } else { [1.0; 3] };
        assert_eq!(found(|n| 5.0 * control(n), bursts), (true, Some(BUSY)));
    }

    #[test]
    fn a_clock_that_is_too_coarse_decides_nothing() {
        let seconds = |n: f64| if n > 1e5 { 9.0 } else { 0.0 };
        assert_eq!(found(seconds, quiet), (true, None));
    }

    #[test]
    fn one_leaf_over_everything_earns_nothing() {
        let time = BuildTime {
            seconds: 1e-3,
            control: [1.0; 2],
        };
        let answer = BuildGrowthAnswer {
            nodes: vec![1; WORK.sizes.len()],
            rounds: vec![vec![time; WORK.sizes.len()]],
        };
        let mut findings = Findings::default();
        judge(&mut findings, &WORK, &answer);
        assert!(!findings.into_vec()[0].passed());
    }

    #[test]
    fn times_of_other_sizes_do_not_fit() {
        let fits = |nodes: usize, rounds: usize, seconds: &[f64]| {
            let time = |&seconds: &f64| BuildTime {
                seconds,
                control: [1.0; 2],
            };
            let answer = BuildGrowthAnswer {
                nodes: vec![9; nodes],
                rounds: vec![seconds.iter().map(time).collect(); rounds],
            };
            kind::BuildGrowth::fits(&WORK, &answer).is_ok()
        };
        assert!(fits(2, 1, &[0.1, 0.2]) && fits(2, 3, &[0.1, 0.2]));
        assert!(!fits(2, 0, &[0.1, 0.2]) && !fits(2, 4, &[0.1, 0.2]));
        assert!(!fits(1, 1, &[0.1]) && !fits(2, 1, &[0.1]) && !fits(9, 1, &[0.1; 9]));
        assert!(!fits(2, 1, &[0.1, f64::NAN]) && !fits(2, 1, &[-0.1, 0.1]));
    }
}
