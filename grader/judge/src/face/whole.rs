//! Judges an answer whole, in every aspect that it has, before it becomes a golden.
//!
//! A case grades only the aspects that it is about, so that one mistake does not fail every case. A
//! golden is compared with whole answers, so it must be right as a whole: [`judge_whole`] judges
//! hit or miss, primitive, `t`, position, both normals, surface parameters, `max_t` and work,
//! whatever the case is about. What it cannot decide (the normal where vertex normals cancel, the
//! random numbers of a few samples) is *not judged*, which is never the same as confirmed.
//!
//! The goldens' test, `grader bless`, `grader review` and `grader mutants` all ask this module.

use crate::tools::Tier;
use crate::tools::findings::{Aspect, Finding, Findings, NotJudged};
use crate::tools::spec::Spec;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use wire::Answer;

/// The result of judging an answer whole.
#[derive(Clone, Debug, Default)]
pub struct Whole {
    /// The aspects with wrong answers.
    pub wrong: Vec<Finding>,
    /// What is not judged.
    pub not_judged: Vec<NotJudged>,
    wrong_in: BTreeMap<u32, Vec<Aspect>>,
    wrong_in_all: Vec<Aspect>,
    open_in: BTreeMap<u32, Vec<NotJudged>>,
    open_in_all: Vec<NotJudged>,
}

/// What is known about the answer to one call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every aspect is judged, and right.
    Confirmed,
    /// These aspects are wrong.
    Refused(Vec<Aspect>),
    /// What is judged is right, but these aspects are not judged.
    NotJudged(Vec<NotJudged>),
}

/// The number of answers by their verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Judged in every aspect, and right.
    pub confirmed: usize,
    /// Wrong.
    pub refused: usize,
    /// Not judged in some aspect.
    pub not_judged: usize,
}

/// Judges every aspect of `answer`, which [`crate::fits`], to the case `spec`, with the bounds of
/// `tier`: the robust ones for goldens.
pub fn judge_whole(spec: &Spec, tier: Tier, answer: &Answer) -> Whole {
    let mut findings = Findings::default();
    let case = spec.context();
    spec.check
        .judge(&mut findings, &case, tier, &spec.work, answer);
    spec.check
        .judge_rest(&mut findings, &case, tier, &spec.work, answer);
    Whole::of(findings)
}

impl Whole {
    fn of(mut findings: Findings) -> Whole {
        let mut whole = Whole::default();
        let open: BTreeSet<NotJudged> = findings.take_not_judged().into_iter().collect();
        for open in open {
            whole.not_judged.push(open);
            match open.call {
                Some(call) => whole.open_in.entry(call).or_default().push(open),
                None => whole.open_in_all.push(open),
            }
        }
        whole.wrong = findings.into_vec();
        whole.wrong.retain(|finding| !finding.passed());
        for finding in &whole.wrong {
            let aspect = finding.aspect;
            for fault in &finding.faults {
                let aspects = whole.wrong_in.entry(fault.call).or_default();
                if !aspects.contains(&aspect) {
                    aspects.push(aspect);
                }
            }
            // An aspect may also fail because no answer has it.
            if aspect.is_of_all_calls() || finding.faults.is_empty() {
                whole.wrong_in_all.push(aspect);
            }
        }
        whole
    }

    /// The aspects that are wrong in each call that has a wrong one.
    pub fn wrong_calls(&self) -> &BTreeMap<u32, Vec<Aspect>> {
        &self.wrong_in
    }

    /// Whether an answer is wrong: then none becomes a golden.
    pub fn is_refused(&self) -> bool {
        !self.wrong.is_empty()
    }

    /// What is known about the answer in a row of the snapshot.
    pub fn verdict(&self, row: u32) -> Verdict {
        let mut wrong = self.wrong_in.get(&row).cloned().unwrap_or_default();
        for aspect in &self.wrong_in_all {
            if !wrong.contains(aspect) {
                wrong.push(*aspect);
            }
        }
        if !wrong.is_empty() {
            return Verdict::Refused(wrong);
        }
        let mut open = self.open_in.get(&row).cloned().unwrap_or_default();
        open.extend(&self.open_in_all);
        if open.is_empty() {
            Verdict::Confirmed
        } else {
            Verdict::NotJudged(open)
        }
    }

    /// Counts the verdicts of `rows`.
    pub fn count(&self, rows: impl IntoIterator<Item = u32>) -> Counts {
        let mut counts = Counts::default();
        for row in rows {
            match self.verdict(row) {
                Verdict::Confirmed => counts.confirmed += 1,
                Verdict::Refused(_) => counts.refused += 1,
                Verdict::NotJudged(_) => counts.not_judged += 1,
            }
        }
        counts
    }

    /// The lines about a case in the list of what is not judged in the goldens of a task: none if
    /// everything is judged.
    pub fn not_judged_lines(&self, case: &str) -> String {
        let sentences = self.not_judged_sentences().into_iter();
        sentences
            .map(|sentence| format!("{case}: {sentence}\n"))
            .collect()
    }

    /// What is not judged, in a sentence for each aspect and reason: "normal, in 7 calls: ...".
    pub fn not_judged_sentences(&self) -> Vec<String> {
        let mut calls: BTreeMap<(Aspect, &str), usize> = BTreeMap::new();
        for open in &self.not_judged {
            *calls.entry((open.aspect, open.why)).or_default() += usize::from(open.call.is_some());
        }
        let sentences = calls.into_iter().map(|((aspect, why), calls)| {
            let where_ = match calls {
                0 => String::new(),
                calls => format!(", in {}", crate::tools::plural(calls, "call", "calls")),
            };
            format!("{}{where_}: {why}", aspect.label())
        });
        sentences.collect()
    }
}

impl fmt::Display for Counts {
    /// "1 wrong, 3 confirmed, 1 not judged".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [
            (self.refused, "wrong"),
            (self.confirmed, "confirmed"),
            (self.not_judged, "not judged"),
        ];
        let parts: Vec<String> = parts
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, what)| format!("{count} {what}"))
            .collect();
        f.write_str(&parts.join(", "))
    }
}
