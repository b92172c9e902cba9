//! Kinds of work that are not judged: measured times, and recorded box tests.

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, LARGE_LIMIT_MS, in_range, same_length};
use crate::tools::findings::Findings;
use wire::answer::{TimingAnswer, VisitsAnswer};
use wire::kind;
use wire::work::{TestTiming, TimingWork, VisitsWork};

impl Check for kind::Timing {
    const NEEDS_ALL_STAGES: bool = true;

    const LIMIT_MS: u64 = LARGE_LIMIT_MS;

    fn calls(work: &TimingWork) -> usize {
        work.rays.len()
    }

    fn fits(work: &TimingWork, answer: &TimingAnswer) -> Result<(), String> {
        for seconds in [&answer.build_s, &answer.tree_s, &answer.brute_s] {
            times_fit(work.rounds as usize, seconds)?;
        }
        Ok(())
    }

    fn judge(_: &mut Findings, _: &CaseContext<'_>, _: Tier, _: &TimingWork, _: &TimingAnswer) {}
}

impl Check for kind::TimeTest {
    fn calls(work: &TestTiming) -> usize {
        work.orders.len()
    }

    fn fits(work: &TestTiming, seconds: &Vec<f64>) -> Result<(), String> {
        times_fit(work.orders.len(), seconds)
    }

    fn judge(_: &mut Findings, _: &CaseContext<'_>, _: Tier, _: &TestTiming, _: &Vec<f64>) {}
}

impl Check for kind::Visits {
    const NEEDS_ALL_STAGES: bool = true;

    fn calls(work: &VisitsWork) -> usize {
        work.rays.len()
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
