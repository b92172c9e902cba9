//! The calls of a case that differ.

use super::delta;
use super::picture::Pixels;
use ::pictures::cause::Cause;
use judge::cases::Spec;
use judge::findings::Aspect;
use judge::snapshot::{Changes, Fields, Line, Snapshot};
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// Of the calls that differ and have a golden row: how many actual answers are nearer to the exact
/// oracle's than the golden ones, and how many are farther. Those that it does not know, and those
/// that are equally far, count as neither.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nearer {
    /// Nearer to the truth than the golden.
    pub nearer: usize,
    /// Farther from it.
    pub farther: usize,
}

/// A call whose answers differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Number of the call.
    pub call: u32,
    /// Why they differ.
    pub cause: Cause,
    /// The golden answer; `None` if the golden has no row for the call and its picture does not
    /// show a miss.
    pub golden: Option<Line>,
    /// The answer of the code under review, as much of it as the golden has.
    pub actual: Option<Line>,
    /// Whether the golden is a hit, where only its colour is known.
    pub golden_hits: Option<bool>,
    /// The exact oracle's answer, if it knows this kind of work.
    pub exact: Option<Line>,
    /// The fields of the question, as text.
    pub question: String,
}

impl Row {
    /// The `t` of the golden hit, or of the exact one where the golden's is not known.
    pub(super) fn expected_t(&self) -> Option<f64> {
        let known = self.golden.as_ref().or(self.exact.as_ref());
        known.and_then(|line| line.number("t"))
    }
}

/// Which of the `differing` answers are nearer to the truth.
pub(super) fn nearer(spec: &Spec, golden: &Snapshot, full: &Snapshot, differing: &[u32]) -> Nearer {
    let mut counts = Nearer::default();
    let Some(exact) = spec.exact(differing) else {
        return counts;
    };
    for (call, exact) in differing.iter().zip(&exact) {
        let (Some(old), Some(new)) = (golden.row(*call), full.row(*call)) else {
            continue;
        };
        match delta::nearer(old, new, exact) {
            Some(Ordering::Less) => counts.farther += 1,
            Some(Ordering::Greater) => counts.nearer += 1,
            _ => {}
        }
    }
    counts
}

/// The calls that are known to differ: those whose rows differ. If the golden does not have all
/// rows, also those whose pixels differ or, without a picture, that are wrong.
pub(super) fn differing(
    [golden, actual, _]: [&Snapshot; 3],
    changes: &Changes,
    pixels: Option<&Pixels>,
    wrong: &BTreeMap<u32, Vec<Aspect>>,
) -> BTreeSet<u32> {
    let mut calls: BTreeSet<u32> = changes.differing.iter().copied().collect();
    if golden.is_whole() {
        let [short, long] = [
            golden.calls.min(actual.calls),
            golden.calls.max(actual.calls),
        ];
        calls.extend((short as u32)..(long as u32));
        return calls;
    }
    match pixels {
        Some(pixels) => {
            let causes = (0..).zip(&pixels.causes);
            let differ = causes.filter(|(_, cause)| **cause != Cause::Same);
            calls.extend(differ.map(|(call, _)| call));
        }
        None => calls.extend(wrong.keys()),
    }
    calls
}

/// The golden, actual and exact answers of `calls`. `hits` says of each call whether the golden
/// picture shows a hit, `causes` why its pixel differs.
pub(super) fn rows(
    spec: &Spec,
    [golden, actual, full]: [&Snapshot; 3],
    hits: Option<&[bool]>,
    causes: Option<&[Cause]>,
    calls: &[u32],
) -> Vec<Row> {
    let is_known = |call: &u32| (*call as usize) < full.calls;
    let known: Vec<u32> = calls.iter().copied().filter(is_known).collect();
    let exact = spec.exact(&known).unwrap_or_default();
    let exact: BTreeMap<u32, Fields> = known.into_iter().zip(exact).collect();
    let row = |call: u32| {
        let hits = hits.map(|hits| hits[call as usize]);
        let line = |answer: &Fields| Line {
            call,
            answer: answer.clone(),
            ..Line::default()
        };
        let old = golden
            .row(call)
            .cloned()
            .or_else(|| (hits == Some(false)).then(|| line(&Fields::new())));
        let new = actual.row(call).or_else(|| full.row(call)).cloned();
        let cause = match (&old, &new) {
            (Some(old), Some(new)) => Cause::of(old, new, true),
            _ => Cause::Value,
        };
        Row {
            call,
            cause: causes.map_or(cause, |causes| causes[call as usize]),
            question: full
                .row(call)
                .or(old.as_ref())
                .map(Line::asked)
                .unwrap_or_default(),
            exact: exact.get(&call).map(line),
            golden_hits: hits.filter(|_| old.is_none()),
            golden: old,
            actual: new,
        }
    };
    calls.iter().map(|call| row(*call)).collect()
}
