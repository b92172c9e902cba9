//! Finds answers that were learned by heart.
//!
//! Students can have the cases of seed 0: they grade themselves with it. So an instructor's run
//! draws another seed. But only some cases of a task depend on the seed. If one of them fails in
//! many calls, and with seed 0 in none, the code recognizes the questions: honest code cannot fail
//! so for one seed only.

use grader::course::Task;
use grader::score::{CaseResult, Status, TaskResult};

/// Cases with this prefix depend on the seed.
const FRESH: &str = "fresh";

/// With fewer calls, a difference between two seeds may be chance.
const FEWEST_CALLS: usize = 30;

/// One call of so many must be wrong.
const ONE_WRONG_OF: usize = 5;

/// The seed whose cases students have.
pub(crate) const KNOWN_SEED: u64 = 0;

/// Whether it is worth the time to grade `result` with [`KNOWN_SEED`], too.
pub(crate) fn is_suspicious(result: &TaskResult) -> bool {
    result.score > 0.0 && result.cases.iter().any(fails_often)
}

/// Whether the code of a task answers the cases of [`KNOWN_SEED`] only: `drawn` are its results with
/// another seed, `known` those with this one.
pub(crate) fn is_by_heart(drawn: &[CaseResult], known: &[CaseResult]) -> bool {
    let mut pairs = drawn.iter().zip(known);
    pairs.any(|(drawn, known)| fails_often(drawn) && wrong_calls(known) == 0 && is_answered(known))
}

/// What is said about such a task.
pub(crate) fn sentence(task: &Task, seed: u64) -> String {
    format!(
        "{}: no points: it answers the cases of seed {KNOWN_SEED}, but not those of seed {seed} that differ in their numbers only. It recognizes the questions",
        task.key
    )
}

fn fails_often(case: &CaseResult) -> bool {
    case.name.starts_with(FRESH)
        && case.calls >= FEWEST_CALLS
        && wrong_calls(case) * ONE_WRONG_OF >= case.calls
}

/// The calls that are wrong in a main answer.
fn wrong_calls(case: &CaseResult) -> usize {
    let main = case.findings.iter().filter(|finding| finding.main);
    main.map(|finding| finding.wrong as usize)
        .max()
        .unwrap_or(0)
}

fn is_answered(case: &CaseResult) -> bool {
    matches!(case.status, Status::Passed | Status::Failed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use judge::Tier;
    use judge::tally::{Aspect, Finding};

    /// A case of 60 calls, `wrong` of which are wrong.
    fn case(name: &str, wrong: u32) -> CaseResult {
        let finding = Finding {
            aspect: Aspect::HitOrMiss,
            expected: 60,
            judged: 60,
            wrong,
            main: true,
            functions: Vec::new(),
            worst: None,
            faults: Vec::new(),
            detectable: None,
            spread: None,
            errors: Vec::new(),
            judged_calls: Vec::new(),
        };
        CaseResult {
            name: name.into(),
            tier: Tier::Core,
            score: 0.0,
            earned: 0.0,
            max_score: 1.0,
            status: Status::Failed,
            about: String::new(),
            findings: vec![finding],
            reductions: Vec::new(),
            shares: Vec::new(),
            with_neighbours: false,
            calls: 60,
            crash: None,
        }
    }

    #[test]
    fn code_that_is_wrong_with_one_seed_only_knows_the_other() {
        for (name, drawn, known, is_by_heart_) in [
            ("fresh_rays", 60, 0, true),
            ("fresh_rays", 12, 0, true),
            // Chance, a mistake, and a case that no seed changes.
            ("fresh_rays", 11, 0, false),
            ("fresh_rays", 60, 1, false),
            ("front_face", 60, 0, false),
        ] {
            let [drawn, known] = [drawn, known].map(|wrong| [case("a", 0), case(name, wrong)]);
            assert_eq!(is_by_heart(&drawn, &known), is_by_heart_, "{name}");
        }
    }

    #[test]
    fn code_that_crashes_with_the_known_seed_does_not_know_it() {
        let mut known = [case("fresh_rays", 0)];
        known[0].status = Status::Crashed("panicked".into());
        assert!(!is_by_heart(&[case("fresh_rays", 60)], &known));
    }
}
