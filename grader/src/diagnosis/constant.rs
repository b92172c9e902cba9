//! Answers that are the same in every call, as those of code that is not finished. A known mistake
//! may give the same answers; that they never change is said first.

use super::mistake::{Certainty, Diagnosis};
use crate::score::{CaseResult, Status};
use judge::Tier;
use judge::snapshot;
use std::collections::BTreeMap;
use wire::{Answer, Work};

/// Fewer equal answers may be chance, or right.
const FEWEST_ANSWERS: usize = 10;

/// From this share of the failed cases on, the equal answers are what is wrong.
const SHARE: f64 = 2.0 / 3.0;

/// The answer to every call of a case, if there is only one.
pub(crate) fn answer_to_all(work: &Work, answer: &Answer) -> Option<String> {
    if !answer.is_the_same_for_all_calls() {
        return None;
    }
    let lines = snapshot::full(work, answer)?.lines;
    let first = lines.first()?;
    Some(match first.is_miss() {
        true => "nothing".to_string(),
        false => first.answer_text().replace('=', " = "),
    })
}

/// What is said of code that gives one answer to all calls of its failed cases, or else of the
/// known mistake that the answers look like.
pub(super) fn or_known(cases: &[CaseResult], known: Option<Diagnosis>) -> Option<Diagnosis> {
    let failed: Vec<&CaseResult> = cases
        .iter()
        .filter(|case| case.tier == Tier::Core && case.status == Status::Failed)
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
    let Some((answer, &(count, calls))) = most else {
        return known;
    };
    if calls < FEWEST_ANSWERS || (count as f64) < SHARE * failed.len() as f64 {
        return known;
    }
    let what = "gives the same answer to every call";
    let hint = "Is the function finished? Its answer must depend on its arguments.";
    let (mut mistakes, also, hints) = match known {
        Some(known) if known.is_likely() => (
            known.mistakes,
            format!("; code that {} does so, too", known.description),
            format!("{hint} Or: {}", known.hint),
        ),
        _ => (Vec::new(), String::new(), hint.to_string()),
    };
    mistakes.insert(0, "constant_answers".into());
    Some(Diagnosis {
        mistakes,
        says: format!(
            "your code {what}: all {calls} answers in {count} of {} failed cases are {answer}{also}",
            failed.len()
        ),
        description: what.into(),
        hint: hints,
        equal: calls,
        of: calls,
        certainty: Certainty::Likely,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::diagnose;
    use crate::diagnosis::tests::known;
    use crate::signature::Signature;
    use judge::findings::{Aspect, Class, Findings};

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

    fn says(cases: &[CaseResult]) -> String {
        let signature = Signature::of(cases);
        let known = diagnose(&[known("this", signature.clone())], &signature);
        or_known(cases, known).expect("the mistake is known").says
    }

    #[test]
    fn what_never_changes_is_said_before_a_known_mistake() {
        let black = Some("radiance = (0,0,0)");
        assert_eq!(
            says(&[case("one", 8, black), case("two", 7, black)]),
            "your code gives the same answer to every call: all 15 answers in 2 of 2 failed cases \
             are radiance = (0,0,0); code that does this does so, too"
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
    }
}
