//! Tests what a report says about wrong answers against these answers.
//!
//! A report's sentences are made in several places, from a part of the answers each. Here each
//! sentence is read again, and compared with all answers that it speaks of. `grader mutants` does
//! this for every known mistake, a test of `golden` for some.

use crate::diagnosis::Diagnosis;
use crate::score::regularity::{FEW_EXCEPTIONS, IN_CORE, OTHERS_RIGHT};
use crate::score::{CaseResult, Status};
use crate::signature::{Evidence, Signature};
use crate::workers::crash::CrashKind;
use judge::Tier;
use judge::cases::Spec;
use judge::findings::{Aspect, Class, Fault, Finding};

/// A sentence that is true but for few wrong answers is true of at least this share of them.
const NEARLY_ALL: f64 = 0.95;

/// The sentences that are false of the answers of `cases`, each with what contradicts it.
pub fn false_ones(
    task: &str,
    cases: &[CaseResult],
    specs: &[Spec],
    common: &[String],
    diagnosis: Option<&Diagnosis>,
) -> Vec<String> {
    let answers = Answers { task, cases, specs };
    let of_common = common
        .iter()
        .map(|says| (says.clone(), answers.contradict(says)));
    let of_diagnosis = diagnosis.into_iter().map(|it| {
        let why = contradict_diagnosis(it, &Signature::of(cases));
        (it.says.clone(), why)
    });
    let of_ends = cases.iter().filter_map(|case| {
        let Status::Crashed(how) = &case.status else {
            return None;
        };
        let is_endless = case
            .crash
            .is_some_and(|crash| crash.kind == CrashKind::Endless);
        let says_so = how.contains("an endless loop?") || how.contains("without end?");
        let why = (says_so && !is_endless).then(|| format!("{}: it ended otherwise", case.name));
        Some((how.clone(), why))
    });
    of_common
        .chain(of_diagnosis)
        .chain(of_ends)
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
    fn contradict(&self, sentence: &str) -> Option<String> {
        let core = sentence.strip_prefix(IN_CORE);
        let cases: Vec<&CaseResult> = self
            .cases
            .iter()
            .filter(|case| !case.with_neighbours)
            .filter(|case| core.is_none() || case.tier == Tier::Core)
            .collect();
        let sentence = core.unwrap_or(sentence);
        let most = sentence.strip_prefix(FEW_EXCEPTIONS);
        let share = if most.is_some() { NEARLY_ALL } else { 1.0 };
        let sentence = most.unwrap_or(sentence);
        let findings = || cases.iter().flat_map(|case| &case.findings);
        if let Some(rest) = sentence.strip_suffix(OTHERS_RIGHT) {
            let one = rest.strip_suffix(" is wrong");
            let fields = one.or_else(|| rest.strip_suffix(" are wrong"))?;
            if let Some(crashed) = cases.iter().find(|case| case.crash.is_some()) {
                return Some(format!("{} crashed", crashed.name));
            }
            let listed: Vec<&str> = fields.split(", ").collect();
            let other = findings()
                .find(|finding| (finding.wrong > 0) != listed.contains(&finding.aspect.label()))
                .filter(|finding| finding.wrong > 0)?;
            return Some(format!("{} is wrong", other.aspect.label()));
        }
        if let Some(rest) = sentence.strip_prefix("only the answers of ") {
            let only = rest.strip_suffix(" are wrong")?;
            let mut faults = findings().flat_map(|finding| &finding.faults);
            let other = faults.find(|fault| fault.function != Some(only))?;
            return Some(format!("those of {:?} are wrong, too", other.function));
        }
        if let Some(circumstances) = sentence.strip_prefix("wrong only where ") {
            return self.contradict_place(&cases, circumstances);
        }
        let Some((about, is)) = manner(sentence) else {
            return Some("nothing tests this sentence".into());
        };
        let of_aspect = findings().filter(|finding| about(finding));
        let faults: Vec<&Fault> = of_aspect.flat_map(|finding| &finding.faults).collect();
        let others: Vec<&&Fault> = faults.iter().filter(|fault| !is(fault.class)).collect();
        let true_of = (faults.len() - others.len()) as f64;
        let first = others.first()?;
        (true_of < share * faults.len() as f64).then(|| {
            format!(
                "{} of {} are not, such as {:?}",
                others.len(),
                faults.len(),
                first.class
            )
        })
    }

    /// A wrong call that lacks one of the circumstances, which ` and ` separates.
    fn contradict_place(&self, cases: &[&CaseResult], circumstances: &str) -> Option<String> {
        for case in cases {
            let spec = self
                .specs
                .iter()
                .find(|spec| spec.is(self.task, &case.name))?;
            let of_calls = case
                .findings
                .iter()
                .filter(|finding| !finding.aspect.is_of_all_calls());
            for fault in of_calls.flat_map(|finding| &finding.faults) {
                let here = spec.circumstances(fault.call as usize);
                // A circumstance may contain the word itself: look for each in the sentence.
                let rest = here.iter().fold(circumstances.to_owned(), |rest, one| {
                    rest.replacen(one, "", 1)
                });
                if !rest.replace(" and ", "").trim().is_empty() {
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

type AboutFinding = Box<dyn Fn(&Finding) -> bool>;

/// Whether a sentence is true of an error of a class.
type IsTrueOf = fn(Class) -> bool;

/// How a sentence ends, the aspect that it is about, and the classes of which it is true.
type Ending = (&'static str, Aspect, IsTrueOf);

/// Which findings a sentence about the manner of errors speaks of, and the classes of which it is
/// true.
fn manner(sentence: &str) -> Option<(AboutFinding, IsTrueOf)> {
    let of = |aspect: Aspect| -> AboutFinding { Box::new(move |finding| finding.aspect == aspect) };
    let whole: [Ending; 8] = [
        (
            "there is a hit instead of a miss",
            Aspect::HitOrMiss,
            |class| class == Class::FalseHit,
        ),
        (
            "there is a miss instead of a hit",
            Aspect::HitOrMiss,
            |class| class == Class::FalseMiss,
        ),
        (
            "there is one instead of None",
            Aspect::SampleOrNone,
            |class| class == Class::FalseHit,
        ),
        (
            "there is None instead of one",
            Aspect::SampleOrNone,
            |class| class == Class::FalseMiss,
        ),
        (
            "it continues instead of ending",
            Aspect::Survival,
            |class| class == Class::FalseHit,
        ),
        ("it ends instead of continuing", Aspect::Survival, |class| {
            class == Class::FalseMiss
        }),
        ("is true instead of false", Aspect::Stop, |class| {
            class == Class::FalseHit
        }),
        ("is false instead of true", Aspect::Stop, |class| {
            class == Class::FalseMiss
        }),
    ];
    if let Some((_, aspect, is)) = whole.iter().find(|(end, ..)| sentence.ends_with(end)) {
        return Some((of(*aspect), *is));
    }
    let (label, says) = sentence.split_once(": ")?;
    let label = label.to_owned();
    let is: IsTrueOf = match says {
        "every wrong answer is NaN" => |class| class == Class::NotANumber,
        "every wrong answer is infinite" => |class| class == Class::Infinite,
        "every wrong answer is 0" => |class| class == Class::Zero,
        "right but for the sign" => |class| class == Class::Negated,
        "every wrong answer has the wrong sign" => |class| class == Class::WrongSign,
        "negative where 0 is right" => |class| class == Class::Negative,
        "on the other side of the surface" => |class| class == Class::OtherSide,
        "the right direction with a wrong length" => |class| class == Class::WrongLength,
        "the right numbers in the wrong order" => |class| class == Class::Swapped,
        "not black where black is right" | "not 0 where 0 is right" => {
            |class| class == Class::FalseHit
        }
        "black where black is wrong" | "0 where 0 is wrong" => |class| class == Class::FalseMiss,
        "too small, by less than a factor of 1.5" => |class| class == Class::SlightlyLess,
        "too large, by less than a factor of 1.5" => |class| class == Class::SlightlyMore,
        "nearly right, less than a factor of 1.5 off" => |class| class == Class::Ratio(0),
        _ if says.ends_with(" times the right number") => |class| matches!(class, Class::Ratio(_)),
        _ if says.starts_with("off by less than 1 part in 100,000") => {
            |class| class == Class::Rounded || matches!(class, Class::Off(power) if power <= -17)
        }
        _ => return None,
    };
    Some((Box::new(move |finding| finding.aspect.label() == label), is))
}

/// What contradicts the numbers of a diagnosis; `None` if they agree with the answers.
fn contradict_diagnosis(diagnosis: &Diagnosis, answers: &Signature) -> Option<String> {
    let Diagnosis {
        says, equal, of, ..
    } = diagnosis;
    if equal > of {
        return Some("more are equal than there are".into());
    }
    if says.contains("your answers equal") && equal < of {
        return Some("some are not equal".into());
    }
    if says.contains(" equal those of") && answers.evidence() != Evidence::Exact {
        return Some("they are alike, which is not equal".into());
    }
    if says.starts_with("several mistakes") && *of != answers.wrong() {
        return Some(format!("{} values are wrong", answers.wrong()));
    }
    let guesses = 1 + says.matches("another guess").count();
    if guesses > 3 && !says.starts_with("two mistakes") {
        return Some(format!("{guesses} guesses"));
    }
    let (_, explained) = says.split_once(": the first explains ")?;
    let numbers: Vec<usize> = explained
        .split(|c: char| !c.is_ascii_digit())
        .filter_map(|digits| digits.parse().ok())
        .take(3)
        .collect();
    let [first, wrong, second] = numbers[..] else {
        return Some("it does not say how much each explains".into());
    };
    if wrong != answers.wrong() {
        return Some(format!("{} values are wrong", answers.wrong()));
    }
    let is_rest = first + second == wrong;
    (first + second > wrong || explained.contains("the other") != is_rest)
        .then(|| format!("{first} and {second} of {wrong}"))
}
