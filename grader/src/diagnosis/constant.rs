//! Answers that are the same in every call, or a field of them that is, as those of code that is
//! not finished. A known mistake may give the same answers; that they never change is said first.

use super::constant_values::{ConstantField, Constants, SAME_ANSWER, SAME_FIELD};
use super::diagnose;
use super::mistake::{Certainty, Claim, Diagnosis, Known};
use crate::score::{CaseResult, Status};
use crate::signature::Signature;
use judge::Tier;
use judge::findings::{Aspect, Finding, WrongNumbers};
use judge::snapshot;
use std::collections::BTreeMap;
use wire::{Answer, Work};

/// Fewer equal answers may be chance, or right.
const FEWEST_ANSWERS: usize = 10;

/// From this share of the failed cases on, the equal answers are what is wrong.
const SHARE: f64 = 2.0 / 3.0;

/// An answer that is a miss, or has nothing in it.
const NOTHING: &str = "nothing";

/// The answer to every call of a case, if there is only one.
pub(crate) fn answer_to_all(work: &Work, answer: &Answer) -> Option<String> {
    if !answer.is_the_same_for_all_calls() {
        return None;
    }
    let lines = snapshot::full(work, answer)?.lines;
    let first = lines.first()?;
    Some(match first.is_miss() {
        true => NOTHING.to_string(),
        false => first.answer_text().replace('=', " = "),
    })
}

/// What is said of code that gives one answer to all calls of its failed cases, or one value in a
/// field of its answers, or else of the known mistake that the answers of `student` look like.
pub(super) fn or_known(
    cases: &[CaseResult],
    known: &[Known],
    student: &Signature,
) -> Option<Diagnosis> {
    let guess = diagnose(known, student);
    let fields = constant_fields(cases);
    let constants = match whole_answer(cases) {
        Some(answer) => answer,
        None if fields.is_empty() => return guess,
        None => Constants::Fields(fields),
    };
    let is_empty = match &constants {
        Constants::Answer { .. } => true,
        Constants::Fields(fields) => fields.iter().any(ConstantField::is_empty),
    };
    let exact = guess.as_ref().filter(|guess| guess.is_exact());
    if exact.is_some() && !is_empty {
        // A name says more than that a value never changes.
        return guess;
    }
    let functions = constants.functions();
    let rest = student.elsewhere(&functions);
    let of_rest = || {
        let known = known.iter().map(|known| Known {
            signature: known.signature.elsewhere(&functions),
            ..known.clone()
        });
        let known: Vec<Known> = known.filter(|known| !known.signature.is_empty()).collect();
        let is_alike = |guess: &Diagnosis| matches!(guess.claim, Claim::Alike(_));
        diagnose(&known, &rest).filter(|guess| guess.is_likely() && is_alike(guess))
    };
    let (before, other) = match (exact, &constants) {
        (Some(exact), _) => ("", Some(exact.clone())),
        (None, Constants::Fields(_)) if rest.has_core_faults() => ("elsewhere ", of_rest()),
        // That nothing is given is no sign of a mistake that gives something.
        (None, _) => ("", guess.filter(|guess| guess.is_likely() && !is_empty)),
    };
    let hint = match &constants {
        Constants::Answer { text, .. } if text == NOTHING => {
            "Is this part finished? If it is, a condition sends every call away."
        }
        _ => "Is this part finished? What it gives must depend on its arguments.",
    };
    let name = match &constants {
        Constants::Answer { .. } => "constant_answers",
        Constants::Fields(_) => "constant_field",
    };
    let (also, hints, others) = other.map_or_else(Default::default, |other| {
        let also = format!("; {before}{}", other.says);
        (also, format!(" Or: {}", other.hint), other.mistakes)
    });
    let (equal, description) = match &constants {
        Constants::Answer { calls, .. } => (*calls, SAME_ANSWER),
        Constants::Fields(fields) => (fields.iter().map(|field| field.wrong).sum(), SAME_FIELD),
    };
    Some(Diagnosis {
        mistakes: [name.to_owned()].into_iter().chain(others).collect(),
        says: constants.says() + &also,
        description: description.into(),
        hint: hint.to_owned() + &hints,
        equal,
        of: equal,
        certainty: Certainty::Likely,
        claim: Claim::Constant(constants),
        ..Diagnosis::default()
    })
}

/// The answer to all calls of the failed cases, if it is the same in most of them and no case that
/// passed has another.
fn whole_answer(cases: &[CaseResult]) -> Option<Constants> {
    let core = || cases.iter().filter(|case| case.tier == Tier::Core);
    let failed: Vec<&CaseResult> = core()
        .filter(|case| case.status == Status::Failed)
        .filter(|case| case.findings.iter().any(|finding| finding.wrong > 0))
        .collect();
    let mut calls_with: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for case in &failed {
        if let Some(answer) = &case.answer_to_all {
            let (count, calls) = calls_with.entry(answer).or_default();
            *count += 1;
            *calls += case.calls;
        }
    }
    let most = calls_with.iter().max_by_key(|(_, counts)| **counts);
    let (answer, &(count, calls)) = most?;
    if core().any(|case| passed_with_another(case, answer)) {
        return None;
    }
    let is_most = calls >= FEWEST_ANSWERS && count as f64 >= SHARE * failed.len() as f64;
    is_most.then(|| Constants::Answer {
        text: answer.to_string(),
        calls,
        cases: [count, failed.len()],
    })
}

/// Whether the right answers of a case are not all this one.
pub(crate) fn passed_with_another(case: &CaseResult, answer: &str) -> bool {
    case.status == Status::Passed && case.answer_to_all.as_deref() != Some(answer)
}

/// The fields that are the same in all wrong answers of core cases, although different ones are
/// expected, and in the right ones, where they may also be 0.
pub(crate) fn constant_fields(cases: &[CaseResult]) -> Vec<ConstantField> {
    let counts = |case: &&CaseResult| case.tier == Tier::Core && !case.with_neighbours;
    let all = cases.iter().filter(counts).flat_map(own_findings);
    let findings = all.filter(|finding| may_be_constant(finding.aspect));
    let mut all: BTreeMap<(Aspect, Option<&'static str>, usize), WrongNumbers> = BTreeMap::new();
    for finding in findings.clone() {
        for numbers in &finding.numbers {
            let key = (finding.aspect, numbers.function, numbers.expected.len());
            all.entry(key)
                .and_modify(|before| before.add(numbers))
                .or_insert_with(|| numbers.clone());
        }
    }
    let constant = all.into_iter().filter_map(|((aspect, function, _), of)| {
        let field = ConstantField {
            aspect,
            function,
            numbers: of.same?,
            wrong: of.count as usize,
        };
        let mut right = findings
            .clone()
            .filter(|finding| finding.aspect == aspect)
            .flat_map(|finding| &finding.right_numbers);
        let changes = right.any(|right| right.differ_from(function, &field.numbers));
        (field.wrong >= FEWEST_ANSWERS && !changes && of.expected_differ).then_some(field)
    });
    constant.collect()
}

/// The findings of a case that tell of the code's own numbers: where the wrong primitive is hit,
/// the others are those of this primitive.
fn own_findings(case: &CaseResult) -> impl Iterator<Item = &Finding> + Clone {
    let is_of_primitive = |finding: &&Finding| finding.aspect == Aspect::Primitive;
    let mut primitives = case.findings.iter().filter(is_of_primitive);
    let other_is_hit = primitives.any(|finding| finding.wrong > 0);
    let all = case.findings.iter();
    all.filter(move |finding| !other_is_hit || is_of_primitive(finding))
}

/// Whether the field is computed in each call. Hit or miss has no numbers; a count, a range or the
/// ray after the call may be what the caller gave.
fn may_be_constant(aspect: Aspect) -> bool {
    !aspect.is_decision()
        && !aspect.is_of_all_calls()
        && !matches!(
            aspect,
            Aspect::Calls | Aspect::Rays | Aspect::Range | Aspect::RayAfter | Aspect::UnitLength
        )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::tests::known;
    use judge::findings::{Class, Findings, Message};

    /// A failed case of `calls` calls, all black where they should be bright.
    fn case(name: &str, calls: usize, answer_to_all: Option<&str>) -> CaseResult {
        let mut findings = Findings::default();
        for call in 0..calls {
            let class = Some(Class::FalseMiss);
            findings.judge_class(Aspect::Radiance, call, class, 1.0, String::new);
        }
        CaseResult {
            calls,
            answer_to_all: answer_to_all.map(str::to_string),
            ..CaseResult::failed(name, findings.into_vec())
        }
    }

    fn said(cases: &[CaseResult], mistake: &[CaseResult]) -> Diagnosis {
        let all = [known("this", Signature::of(mistake))];
        or_known(cases, &all, &Signature::of(cases)).expect("something is said")
    }

    #[test]
    fn what_never_changes_is_said_before_a_known_mistake() {
        let black = Some("radiance = (0,0,0)");
        let says = |cases: &[CaseResult]| said(cases, cases).says;
        assert_eq!(
            says(&[case("one", 8, black), case("two", 7, black)]),
            "your code gives the same answer to every call: all 15 answers in 2 of 2 failed cases \
             are radiance = (0,0,0); your answers equal those of code that does this: on 15 of 15 \
             calls"
        );
        let equal = "your answers equal those of code that does this";
        let others = [
            // A few equal answers, and equal ones in half of the cases.
            [case("one", 3, black), case("two", 3, black)],
            [case("one", 80, black), case("two", 70, None)],
        ];
        for cases in others {
            assert!(says(&cases).starts_with(equal), "{}", says(&cases));
        }
        // Right answers that differ: the code does depend on its arguments.
        let passed = |answer| CaseResult {
            status: Status::Passed,
            ..case("right", 0, answer)
        };
        let with = |answer| says(&[case("one", 20, black), passed(answer)]);
        assert!(with(None).starts_with(equal), "{}", with(None));
        assert!(with(black).starts_with("your code gives the same answer"));
    }

    /// Code that gives nothing does not make a mistake of which only most answers are the same.
    #[test]
    fn nothing_is_no_sign_of_a_mistake_that_gives_something() {
        let black = Some("radiance = (0,0,0)");
        let cases = [case("one", 100, black)];
        let mistake = [case("one", 97, None)];
        let says = diagnose(
            &[known("this", Signature::of(&mistake))],
            &Signature::of(&cases),
        );
        assert!(says.is_some_and(|known| known.is_likely()));
        assert_eq!(said(&cases, &mistake).mistakes, ["constant_answers"]);
    }

    /// A case of two functions with `wrong` answers of the second, and what is expected there.
    fn of_field(name: &str, yours: impl Fn(u32) -> [f64; 2], missed: u32) -> CaseResult {
        let mut findings = Findings::default();
        for call in 0..20 + missed {
            let class = (call >= 20).then_some(Class::FalseMiss);
            let number = call as usize;
            findings.count_for("hits");
            findings.judge_class(Aspect::HitOrMiss, number, class, 1.0, String::new);
            if class.is_none() {
                let yours = yours(call);
                let expected = [f64::from(call + 1), 0.5];
                let is_right = yours == expected || yours == [9.0; 2];
                findings.judge(Aspect::Barycentrics, number, is_right, 1.0, || {
                    Message::default().compares(yours, expected)
                });
            }
        }
        CaseResult::failed(name, findings.into_vec())
    }

    #[test]
    fn a_field_that_never_changes_is_said_first() {
        let zero = |_| [0.0; 2];
        let both = |missed| [of_field("one", zero, missed), of_field("two", zero, 0)];
        // The mistake misses in the same calls and has right weights.
        let right = |call| [f64::from(call + 1), 0.5];
        let misses = [of_field("one", right, 12)];
        let weights = "your code gives the same value where other calls need other values: \
                       barycentric weights of hits are (0, 0) in all 40 wrong answers";
        let alone = said(&both(0), &misses);
        assert_eq!(alone.says, weights);
        assert_eq!(alone.mistakes, ["constant_field"]);
        let two = said(&both(12), &misses);
        let elsewhere = "; elsewhere your answers are all wrong in the same way as those of code \
                         that does this: on 12 of 12 calls";
        assert_eq!(two.says, weights.to_owned() + elsewhere);
        assert_eq!(two.mistakes, ["constant_field", "this"]);
        // Numbers that change, also in a right answer, of this case or of another one.
        let changing = |call| [f64::from(call), 0.0];
        let once = |call| if call == 19 { [9.0; 2] } else { [0.0; 2] };
        assert_eq!(constant_fields(&[of_field("one", changing, 0)]), []);
        assert_eq!(constant_fields(&[of_field("one", once, 0)]), []);
        let with = |others: usize| {
            let others = (0..others).map(|_| of_field("right", right, 0));
            let cases = [of_field("one", zero, 0)].into_iter().chain(others);
            constant_fields(&cases.collect::<Vec<_>>()).len()
        };
        assert_eq!([0, 1].map(with), [1, 0]);
        // The end of a shadow ray is no radiance.
        let of_radiance = |is_beside: bool| {
            let mut findings = Findings::default();
            for call in 1..20 {
                findings.judge(Aspect::Radiance, call, false, 1.0, || match is_beside {
                    true => Message::default().compares_beside(0.0, call as f64),
                    false => Message::default().compares([0.0; 3], [call as f64; 3]),
                });
            }
            constant_fields(&[CaseResult::failed("lamps", findings.into_vec())]).len()
        };
        assert_eq!([true, false].map(of_radiance), [0, 1]);
        // The numbers of another primitive.
        let mut of_other = of_field("one", zero, 0);
        let mut hit = Findings::default();
        hit.judge(Aspect::Primitive, 0, false, 1.0, Message::default);
        of_other.findings.extend(hit.into_vec());
        assert_eq!(constant_fields(&[of_other]), []);
    }
}
