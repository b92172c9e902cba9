//! Judges the results of the student's code: which aspects of them are right, and which are wrong.
//!
//! Each kind of work has a `check::Check` in the folder of its task, in `tasks`; one list there
//! maps each kind to its check. [`fits`] validates the form of an answer, [`judge`] its values, in
//! the aspects that a case is about. [`whole`] judges an answer in all its aspects, before it
//! becomes a golden.
//!
//! Shared modules: `hits` judges hit records, `numbers` colours and directions, `chance` statistics
//! of many samples, `independence` the samples of different pixels. `order` puts the findings that
//! explain the most first. [`truth`] computes the exact results for triangles and spheres with the
//! oracle, [`scene`] those for whole scenes; [`expected`] has their type and [`expected_cache`]
//! stores them. [`tally`] counts right and wrong answers by aspect, [`errors`] summarises numerical
//! errors. [`snapshot`] writes goldens, [`repro`] Rust tests, [`picture`] the colours of answers;
//! [`pictures`] are those that students see of their code. [`call_input`] describes a call that
//! crashed.

pub mod call_input;
pub mod cases;
mod chance;
mod check;
pub mod circumstances;
pub mod convert;
pub mod errors;
pub mod expected;
pub mod expected_cache;
mod hits;
mod independence;
mod numbers;
mod order;
pub mod picture;
pub mod pictures;
mod plural;
pub mod repro;
pub mod scene;
pub mod snapshot;
pub mod tally;
mod tasks;
mod tier;
mod tree_tests;
pub mod truth;
pub mod whole;

pub use plural::plural;
pub use tasks::part2_task1::exact_boxes;
pub use tier::Tier;

use cases::Spec;
use tally::{Aspect, Finding, Tally, WrongAnswer};
use wire::{Answer, Work};

/// Checks that `answer`, which comes from an untrusted worker, has the form that `work` requires:
/// the kind, the number of entries, the ranges of indices. Judge, write or show only an answer that
/// fits. The error ends the sentence "the worker's record does not fit the case: ...".
pub fn fits(work: &Work, answer: &Answer) -> Result<(), String> {
    tasks::check_of(work).fits(answer)
}

/// The number of calls of the student's functions that `work` makes.
pub fn calls(work: &Work) -> usize {
    tasks::check_of(work).calls()
}

/// Judges `answer`, which [`fits`], to the case `spec`, whose points are of `tier`: core points
/// allow the rounding errors of textbook code, robust points only those of numerically stable code.
///
/// Only the aspects that the case is about count, so that one mistake does not fail every case. A
/// case about an aspect of hits is also about hit or miss: an answer without a hit has no normal.
/// The findings that explain the most come first.
pub fn judge(spec: &Spec, tier: Tier, answer: &Answer) -> Vec<Finding> {
    judge_written(spec, tier, answer, &[])
}

/// As [`judge`], without the answers of the functions `not_written`, which have holes. The findings
/// count them as never judged.
pub fn judge_written(
    spec: &Spec,
    tier: Tier,
    answer: &Answer,
    not_written: &[String],
) -> Vec<Finding> {
    judge_in(Tally::without(not_written), spec, tier, answer).0
}

/// As [`judge_written`], with every wrong answer: one for each wrong aspect of each call, in the
/// order of the calls. Those that are wrong as a whole (a distribution, the work of a tree) are
/// listed at one call.
pub fn judge_each(
    spec: &Spec,
    tier: Tier,
    answer: &Answer,
    not_written: &[String],
) -> (Vec<Finding>, Vec<WrongAnswer>) {
    let tally = Tally::without(not_written).with_messages();
    let (findings, mut wrong) = judge_in(tally, spec, tier, answer);
    wrong.retain(|wrong| is_about(spec, wrong.aspect));
    wrong.sort_by_key(|wrong| wrong.call);
    (findings, wrong)
}

fn judge_in(
    mut tally: Tally,
    spec: &Spec,
    tier: Tier,
    answer: &Answer,
) -> (Vec<Finding>, Vec<WrongAnswer>) {
    tasks::check_of(&spec.work).judge(&mut tally, spec, tier, answer);
    let wrong = tally.take_wrong_answers();
    let mut findings = tally.into_findings();
    findings.retain(|finding| is_about(spec, finding.aspect));
    for finding in &mut findings {
        finding.main = spec.is_main(finding.aspect);
    }
    (order::by_explanation(findings), wrong)
}

/// Whether the case is about `aspect`.
fn is_about(spec: &Spec, aspect: Aspect) -> bool {
    let about = spec.about_aspects;
    about.is_empty()
        || about.contains(&aspect)
        || aspect == Aspect::HitOrMiss && about.iter().any(|aspect| aspect.needs_a_hit())
}
