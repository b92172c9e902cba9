//! Judges an answer in the aspects that its case is about.

use super::order;
use crate::tasks::check_of;
use crate::tools::Tier;
use crate::tools::findings::{Aspect, Finding, Findings, WrongAnswer};
use crate::tools::spec::Spec;
use wire::{Answer, Work};

/// Checks that `answer`, which comes from an untrusted worker, has the form that `work` requires:
/// the kind, the number of entries, the ranges of indices. Judge, write or show only an answer that
/// fits. The error ends the sentence "the worker's record does not fit the case: ...".
pub fn fits(work: &Work, answer: &Answer) -> Result<(), String> {
    check_of(work).fits(work, answer)
}

/// The number of calls of the student's functions that `work` makes.
pub fn calls(work: &Work) -> usize {
    check_of(work).calls(work)
}

/// Judges `answer`, which [`fits`], to the case `spec`, whose points are of `tier`: core points
/// allow the rounding errors of textbook code, robust points only those of numerically stable code.
///
/// Only the aspects that the case is about count, so that one mistake does not fail every case. A
/// case about an aspect of hits is also about hit or miss: an answer without a hit has no normal.
/// The findings that explain the most come first.
///
/// ```
/// let spec = &judge::cases::of("part1.task2", 0)[0];
/// let (o, d) = ([0.0; 3], [0.0, 0.0, -1.0]);
/// let ray = wire::work::Ray { o, d, min_t: 0.0, max_t: 1.0 };
/// // The same ray for every point of the film.
/// let answer = wire::Answer::CameraRays(vec![ray; judge::calls(&spec.work)]);
/// judge::fits(&spec.work, &answer).unwrap();
/// let findings = judge::judge(spec, judge::Tier::Core, &answer);
/// assert!(findings.iter().any(|finding| finding.wrong > 0));
/// ```
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
    judge_in(Findings::without(not_written), spec, tier, answer).0
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
    let empty = Findings::without(not_written).with_messages();
    let (findings, mut wrong) = judge_in(empty, spec, tier, answer);
    wrong.retain(|wrong| is_about(spec, wrong.aspect));
    wrong.sort_by_key(|wrong| wrong.fault.call);
    (findings, wrong)
}

fn judge_in(
    mut findings: Findings,
    spec: &Spec,
    tier: Tier,
    answer: &Answer,
) -> (Vec<Finding>, Vec<WrongAnswer>) {
    spec.check
        .judge(&mut findings, &spec.context(), tier, &spec.work, answer);
    let wrong = findings.take_wrong_answers();
    let mut list = findings.into_vec();
    list.retain(|finding| is_about(spec, finding.aspect));
    for finding in &mut list {
        finding.main = spec.is_main(finding.aspect);
    }
    (order::by_explanation(list), wrong)
}

/// Whether the case is about `aspect`.
fn is_about(spec: &Spec, aspect: Aspect) -> bool {
    let about = spec.about_aspects;
    about.is_empty()
        || about.contains(&aspect)
        || aspect.is_decision() && about.iter().any(|aspect| aspect.needs_a_hit())
}
