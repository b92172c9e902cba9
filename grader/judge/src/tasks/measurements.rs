//! Kinds of work that are not judged: measured times, and recorded box tests.

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, LARGE_LIMIT_MS, in_range, same_length};
use crate::tools::findings::Findings;
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::Fields;
use wire::answer::{TimingAnswer, VisitsAnswer};
use wire::kind;
use wire::work::{TestTiming, TimingWork, VisitsWork};

impl Check for kind::Timing {
    const NEEDS_ALL_STAGES: bool = true;

    const LIMIT_MS: u64 = LARGE_LIMIT_MS;

    fn calls(work: &TimingWork) -> usize {
        work.rays.len()
    }

    fn only_call(_: &TimingWork, _: usize) -> Option<TimingWork> {
        None
    }

    fn fits(work: &TimingWork, answer: &TimingAnswer) -> Result<(), String> {
        for seconds in [&answer.build_s, &answer.tree_s, &answer.brute_s] {
            times_fit(work.rounds as usize, seconds)?;
        }
        Ok(())
    }

    fn judge(_: &mut Findings, _: &CaseContext<'_>, _: Tier, _: &TimingWork, _: &TimingAnswer) {}

    fn lines(_: &TimingWork, _: &TimingAnswer) -> Option<Content> {
        None
    }

    fn input(_: &TimingWork, _: usize) -> Option<String> {
        None
    }

    fn exact(_: &TimingWork, _: bool, _: &[u32]) -> Option<Vec<Fields>> {
        None
    }

    fn shown(
        _: &TimingWork,
        _: Tier,
        _: bool,
        _: usize,
        _: Option<&TimingAnswer>,
    ) -> Option<ShownCall> {
        None
    }
}

impl Check for kind::TimeTest {
    fn calls(work: &TestTiming) -> usize {
        work.orders.len()
    }

    fn only_call(_: &TestTiming, _: usize) -> Option<TestTiming> {
        None
    }

    fn fits(work: &TestTiming, seconds: &Vec<f64>) -> Result<(), String> {
        times_fit(work.orders.len(), seconds)
    }

    fn judge(_: &mut Findings, _: &CaseContext<'_>, _: Tier, _: &TestTiming, _: &Vec<f64>) {}

    fn lines(_: &TestTiming, _: &Vec<f64>) -> Option<Content> {
        None
    }

    fn input(_: &TestTiming, _: usize) -> Option<String> {
        None
    }

    fn exact(_: &TestTiming, _: bool, _: &[u32]) -> Option<Vec<Fields>> {
        None
    }

    fn shown(
        _: &TestTiming,
        _: Tier,
        _: bool,
        _: usize,
        _: Option<&Vec<f64>>,
    ) -> Option<ShownCall> {
        None
    }
}

impl Check for kind::Visits {
    const NEEDS_ALL_STAGES: bool = true;

    fn calls(work: &VisitsWork) -> usize {
        work.rays.len()
    }

    fn only_call(_: &VisitsWork, _: usize) -> Option<VisitsWork> {
        None
    }

    fn fits(work: &VisitsWork, answer: &VisitsAnswer) -> Result<(), String> {
        same_length("lists of visits", answer.rays.len(), Self::calls(work))?;
        for (call, visits) in answer.rays.iter().enumerate() {
            for visit in visits {
                in_range("node", call, visit.node, work.tree.nodes.len())?;
            }
        }
        Ok(())
    }

    fn judge(_: &mut Findings, _: &CaseContext<'_>, _: Tier, _: &VisitsWork, _: &VisitsAnswer) {}

    fn lines(_: &VisitsWork, _: &VisitsAnswer) -> Option<Content> {
        None
    }

    fn input(_: &VisitsWork, _: usize) -> Option<String> {
        None
    }

    fn exact(_: &VisitsWork, _: bool, _: &[u32]) -> Option<Vec<Fields>> {
        None
    }

    fn shown(
        _: &VisitsWork,
        _: Tier,
        _: bool,
        _: usize,
        _: Option<&VisitsAnswer>,
    ) -> Option<ShownCall> {
        None
    }
}

/// Checks that there is a valid time for each round.
fn times_fit(rounds: usize, seconds: &[f64]) -> Result<(), String> {
    if seconds.len() != rounds {
        return Err(format!(
            "expected the times of {rounds} rounds, found {}",
            seconds.len()
        ));
    }
    match seconds.iter().find(|s| !(s.is_finite() && **s >= 0.0)) {
        Some(wrong) => Err(format!(
            "a round has the time {wrong} s, expected a number of at least 0"
        )),
        None => Ok(()),
    }
}
