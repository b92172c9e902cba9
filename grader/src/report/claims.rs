//! Tests what a report says about wrong answers against these answers.
//!
//! A report's sentences are made in several places, from a part of the answers each. Here each
//! sentence is read again, and compared with all answers that it speaks of. `grader mutants` does
//! this for every known mistake, a test of `golden` for some.

use super::message;
use super::screen::WHOLE;
use super::wrap::wrap;
use crate::diagnosis::constant::passed_with_another;
use crate::diagnosis::simplest::SimplestCall;
use crate::diagnosis::{Claim, Constants, Diagnosis};
use crate::score::regularity::{self, Regularity, Shared, told_class};
use crate::score::{CaseResult, Status};
use crate::signature::Signature;
use crate::sketch::Sketch;
use judge::Tier;
use judge::cases::Spec;
use judge::findings::{Fault, Finding, Message};
use judge::shown::ShownCall;

/// A sentence that is true but for few wrong answers is true of at least this share of them.
const NEARLY_ALL: f64 = 0.95;

/// The columns of a narrow page.
const PAGE: usize = 76;

/// The sentences that are false of the answers of `cases`, each with what contradicts it.
pub fn false_ones(
    task: &str,
    cases: &[CaseResult],
    specs: &[Spec],
    common: &[Regularity],
    diagnosis: Option<&Diagnosis>,
) -> Vec<String> {
    let answers = Answers { task, cases, specs };
    let of_common = common
        .iter()
        .map(|says| (says.to_string(), answers.contradict(says)));
    let of_diagnosis = diagnosis
        .into_iter()
        .map(|it| (it.says.clone(), contradict_diagnosis(it, cases)));
    of_common
        .chain(of_diagnosis)
        .filter_map(|(says, why)| Some(format!("\"{says}\": {}", why?)))
        .collect()
}

/// The answers that sentences speak of.
struct Answers<'a> {
    task: &'a str,
    cases: &'a [CaseResult],
    specs: &'a [Spec],
}

impl Answers<'_> {
    /// What contradicts a sentence about what wrong answers have in common; `None` if it is true.
    fn contradict(&self, Regularity { in_core, shared }: &Regularity) -> Option<String> {
        let cases: Vec<&CaseResult> = self
            .cases
            .iter()
            .filter(|case| !case.with_neighbours)
            .filter(|case| !in_core || case.tier == Tier::Core)
            .collect();
        let findings = || cases.iter().flat_map(|case| &case.findings);
        match shared {
            Shared::Fields {
                wrong: listed,
                all_judged,
            } => {
                if let Some(crashed) = cases.iter().find(|case| case.crash().is_some()) {
                    return Some(format!("{} crashed", crashed.name));
                }
                let mut wrong = findings().filter(|finding| finding.wrong > 0);
                if let Some(other) = wrong.find(|finding| !listed.contains(&finding.aspect)) {
                    return Some(format!("{} is wrong", other.aspect.label()));
                }
                let is_hidden = |of: &&Finding| of.expected > 0 && of.judged == 0;
                let hidden = findings().find(is_hidden).filter(|_| *all_judged)?;
                Some(format!("{} is not judged", hidden.aspect.label()))
            }
            Shared::Function(only) => {
                let mut faults = findings().flat_map(|finding| &finding.faults);
                let other = faults.find(|fault| fault.function != Some(only))?;
                Some(format!("those of {:?} are wrong, too", other.function))
            }
            Shared::Circumstances(places) => self.contradict_place(&cases, places),
            Shared::Manner {
                aspect,
                class,
                has_exceptions,
                ..
            } => {
                let of_aspect = findings().filter(|finding| finding.aspect == *aspect);
                let faults: Vec<&Fault> = of_aspect.flat_map(|finding| &finding.faults).collect();
                let is = |fault: &&&Fault| told_class(*aspect, fault.class) == *class;
                let true_of = faults.iter().filter(is).count();
                let first = faults.iter().find(|fault| !is(fault));
                let share = if *has_exceptions { NEARLY_ALL } else { 1.0 };
                let is_true = true_of as f64 >= share * faults.len() as f64;
                let such_as = first.map(|first| format!(", such as {:?}", first.class));
                (!is_true || faults.is_empty()).then(|| {
                    format!(
                        "{} of {} are not{}",
                        faults.len() - true_of,
                        faults.len(),
                        such_as.unwrap_or_default()
                    )
                })
            }
        }
    }

    /// A wrong call that lacks one of the circumstances.
    fn contradict_place(&self, cases: &[&CaseResult], places: &[&str]) -> Option<String> {
        for case in cases {
            let spec = self
                .specs
                .iter()
                .find(|spec| spec.is(self.task, &case.name))?;
            let is_elsewhere =
                |place: &&str| regularity::fails_elsewhere((self.task, case), self.specs, place);
            if places.iter().any(is_elsewhere) {
                return Some(format!("{} is wrong elsewhere", case.name));
            }
            let of_calls = case
                .findings
                .iter()
                .filter(|finding| !finding.aspect.is_of_all_calls());
            for fault in of_calls.flat_map(|finding| &finding.faults) {
                let here = spec.circumstances(fault.call as usize).unwrap_or_default();
                if !places.iter().all(|place| here.contains(place)) {
                    return Some(format!(
                        "call {} of {} is wrong elsewhere",
                        fault.call, case.name
                    ));
                }
            }
        }
        None
    }
}

/// What is false of the simplest call that a report shows, below `common`.
pub fn false_of_call(call: &SimplestCall, common: &[Regularity]) -> Vec<String> {
    let mut left = common.to_vec();
    regularity::drop_refuted(&mut left, &call.wrong_where);
    let refuted = common
        .iter()
        .filter(|says| !left.contains(says))
        .map(|says| format!("\"{says}\": a simple call refutes it"));
    let is_unseen = call.input.is_empty();
    let unseen = is_unseen.then(|| "the simplest call is not written".to_owned());
    let texts = [message::input(call), message::found(call)].into_iter();
    let long = texts.filter(|text| wrap(text, 4, PAGE).len() > WHOLE);
    let cut = long.map(|text| format!("\"{text}\" is cut"));
    let drawing = call.shown.iter().flat_map(false_of_drawing);
    refuted
        .chain(unseen)
        .chain(cut)
        .chain(false_of_message(&call.result))
        .chain(drawing)
        .collect()
}

/// What a reader of a wrong answer's message does not see: a difference of its numbers.
pub fn false_of_message(message: &Message) -> Option<String> {
    message::looks_equal(message)
}

/// What is false of the drawing of a call: signs that have no meaning below, meanings without a
/// sign, words over each other, `*` where only one of the two is drawn.
pub fn false_of_drawing(call: &ShownCall) -> Vec<String> {
    let sketch = Sketch::of(call);
    sketch.map_or_else(Vec::new, |sketch| sketch.false_signs())
}

/// What contradicts a diagnosis; `None` if it agrees with the answers.
fn contradict_diagnosis(diagnosis: &Diagnosis, cases: &[CaseResult]) -> Option<String> {
    let Diagnosis {
        claim, equal, of, ..
    } = diagnosis;
    if equal > of {
        return Some("more are equal than there are".into());
    }
    let answers = Signature::of(cases);
    let all_wrong = answers.wrong();
    let is_of_all = |wrong: usize| {
        (wrong != all_wrong).then(|| format!("{all_wrong} values are wrong, not {wrong}"))
    };
    match claim {
        Claim::Alike(evidence) => (*evidence != answers.evidence())
            .then(|| format!("they are alike by {:?}", answers.evidence())),
        Claim::MostAlike => None,
        Claim::Pair([first, second]) => {
            (first + second > all_wrong).then(|| format!("{first} and {second} of {all_wrong}"))
        }
        Claim::OneOfSeveral(evidence) => is_of_all(*of).or_else(|| {
            (*evidence != answers.evidence())
                .then(|| format!("they are alike by {:?}", answers.evidence()))
        }),
        Claim::Constant(constants) => contradict_constants(constants, cases),
    }
}

/// What contradicts that answers, or fields of them, never change.
fn contradict_constants(constants: &Constants, cases: &[CaseResult]) -> Option<String> {
    let core = || cases.iter().filter(|case| case.tier == Tier::Core);
    match constants {
        Constants::Answer { text, calls, .. } => {
            let failed = core().filter(|case| case.status == Status::Failed);
            let wrong = failed.filter(|case| case.findings.iter().any(|of| of.wrong > 0));
            let same = wrong.filter(|case| case.answer_to_all.as_ref() == Some(text));
            let found: usize = same.map(|case| case.calls).sum();
            let other = core().find(|case| passed_with_another(case, text));
            if let Some(CaseResult { name, .. }) = other {
                return Some(format!("{name} has other answers"));
            }
            (found != *calls).then(|| format!("{found} answers are {text}"))
        }
        Constants::Fields(fields) => fields.iter().find_map(|field| {
            let counted = core().filter(|case| !case.with_neighbours);
            let findings = counted.flat_map(|case| &case.findings);
            let faults = findings
                .filter(|finding| finding.aspect == field.aspect)
                .flat_map(|finding| &finding.faults);
            let own = faults.filter(|fault| fault.named_function() == field.function);
            let wrong = own.count();
            (wrong < field.wrong).then(|| format!("only {wrong} answers are wrong"))
        }),
    }
}
