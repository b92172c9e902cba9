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

/// Whether the code of a task answers the cases of [`KNOWN_SEED`] only: `drawn` is its result with
/// another seed, `known` that with this one.
pub(crate) fn is_by_heart(drawn: &TaskResult, known: &TaskResult) -> bool {
    let mut pairs = drawn.cases.iter().zip(&known.cases);
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
