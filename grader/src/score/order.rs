//! Orders failed cases: those that show a fault of a new kind come first.

use crate::score::{CaseResult, Status, TaskResult};
use judge::Tier;
use judge::findings::{Aspect, Class, Fault};
use std::collections::BTreeSet;

/// A kind of fault that a case shows.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind<'a> {
    /// The case has no answers, for this reason.
    NoAnswer(&'a str),
    /// A wrong answer of a function, in one aspect and of one class, if the class has a name.
    Wrong(Aspect, Option<&'static str>, Option<Class>),
}

/// The failed core cases of a task, or, if none failed, its robust ones; those that show a new kind
/// of fault come first.
pub(crate) fn failed_cases_that_count(task: &TaskResult) -> Vec<&CaseResult> {
    let of = |tier: Tier| {
        let failed = task.failed_cases().filter(|case| case.tier == tier);
        new_faults_first(&failed.collect::<Vec<_>>())
    };
    match of(Tier::Core) {
        core if core.is_empty() => of(Tier::Robust),
        core => core,
    }
}

/// Puts the cases first that show a kind of fault that no case before them shows. The others repeat
/// what is known. Otherwise the order stays as it is: the course goes from simple cases to hard
/// ones.
pub(crate) fn new_faults_first<'a>(cases: &[&'a CaseResult]) -> Vec<&'a CaseResult> {
    let mut known = BTreeSet::new();
    let (mut ordered, repeating): (Vec<&CaseResult>, Vec<&CaseResult>) =
        cases.iter().partition(|case| {
            let before = known.len();
            known.extend(kinds(case));
            known.len() > before
        });
    ordered.extend(repeating);
    ordered
}

fn kinds(case: &CaseResult) -> Vec<Kind<'_>> {
    match &case.status {
        Status::Crashed(ended) => return vec![Kind::NoAnswer(&ended.how)],
        Status::Needs(task) => return vec![Kind::NoAnswer(task)],
        _ => {}
    }
    let wrong = case.findings.iter().flat_map(|finding| {
        let of = |fault: &Fault| Kind::Wrong(finding.aspect, fault.function, named(fault.class));
        finding.faults.iter().map(of)
    });
    wrong.collect()
}

/// The class, if it is a kind of its own. Others depend on the size of the error.
fn named(class: Class) -> Option<Class> {
    matches!(
        class,
        Class::Named(_) | Class::FalseHit | Class::FalseMiss | Class::NotANumber
    )
    .then_some(class)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workers::crash::Crash;
    use judge::findings::Findings;

    /// A failed case with one fault of each class.
    fn case(name: &str, faults: &[(Aspect, Class)]) -> CaseResult {
        let mut findings = Findings::default();
        for (aspect, class) in faults {
            findings.judge_class(*aspect, 0, Some(*class), 1.0, String::new);
        }
        CaseResult::failed(name, findings.into_vec())
    }

    fn order(cases: &[CaseResult]) -> Vec<&str> {
        let cases: Vec<&CaseResult> = cases.iter().collect();
        let ordered = new_faults_first(&cases).into_iter();
        ordered.map(|case| case.name.as_str()).collect()
    }

    #[test]
    fn cases_that_repeat_known_faults_come_last() {
        let miss = (Aspect::HitOrMiss, Class::FalseMiss);
        let hit = (Aspect::HitOrMiss, Class::FalseHit);
        let small = (Aspect::T, Class::Off(-3));
        let large = (Aspect::T, Class::Off(5));
        let cases = [
            case("one", &[miss]),
            case("two", &[miss]),
            case("three", &[miss, small]),
            case("four", &[large]),
            case("five", &[hit]),
        ];
        assert_eq!(order(&cases), ["one", "three", "five", "two", "four"]);
    }

    #[test]
    fn the_same_crash_is_known() {
        let crashed = |name: &str, how: &str, call: u32| CaseResult {
            status: Status::Crashed(Crash {
                call: Some(call),
                ..how.into()
            }),
            ..case(name, &[])
        };
        let cases = [
            crashed("one", "panicked at lib.rs:3: too small", 0),
            crashed("two", "panicked at lib.rs:3: too small", 7),
            crashed("three", "ran out of time", 0),
        ];
        assert_eq!(order(&cases), ["one", "three", "two"]);
    }
}
