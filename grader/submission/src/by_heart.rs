//! Finds answers that were learned by heart.
//!
//! Students can have the questions of seed 0: they grade themselves with it. So an instructor's run
//! draws another seed, which moves all other questions by exact symmetries, and draws the numbers of
//! fresh ones. Code that is right with seed 0 and wrong with the other recognizes the questions:
//! honest code answers both in the same way, but for a mistake that depends on the move.

use grader::course::Task;
use grader::score::{CaseResult, Status, TaskResult};
use judge::Tier;

/// The seed whose cases students have.
pub(crate) use judge::cases::KNOWN_SEED;

/// Cases with this prefix have other numbers with each seed.
const FRESH: &str = "fresh";

/// With fewer calls, a difference between two seeds may be chance.
const FEWEST_CALLS: usize = 30;

/// One call of so many must be wrong,
const ONE_WRONG_OF: usize = 5;

/// or so many: if most calls are misses, code that always misses is seldom wrong.
const SURELY_NO_CHANCE: usize = 50;

/// Code that knows the questions is right in at least this share of the core points with
/// [`KNOWN_SEED`], and wrong in at least this share of them with another. A mistake that depends on
/// the move, such as a distance that counts as infinite, changes less.
const MOST: f64 = 0.5;

/// Code with so many of them has no function that is not written yet.
const MOST_WRITTEN: f64 = 0.75;

/// So much of them is no evidence that takes points, but a person should look.
const NEARLY_ALL: f64 = 0.9;

/// Whether a task gets no points because its code answers the questions of [`KNOWN_SEED`] only:
/// `drawn` is its result with another seed, `known` that with this one.
pub fn accuses(drawn: &TaskResult, known: &TaskResult) -> bool {
    is_suspicious(drawn) && is_by_heart(&drawn.cases, &known.cases)
}

/// Whether it is worth the time to grade `result` with [`KNOWN_SEED`], too.
pub(crate) fn is_suspicious(result: &TaskResult) -> bool {
    let is_bad = result.score < MOST * result.max_score;
    // What crashes may take as long again.
    let is_cheap = result
        .cases
        .iter()
        .all(|case| is_answered(case) || is_unwritten(case));
    is_bad && is_cheap || result.score > 0.0 && result.cases.iter().any(fails_often)
}

fn is_by_heart(drawn: &[CaseResult], known: &[CaseResult]) -> bool {
    let is_right = |case: &CaseResult| wrong_calls(case) == 0 && is_answered(case);
    let mut right = drawn.iter().zip(known).filter(|(_, known)| is_right(known));
    if right.clone().any(|(drawn, _)| fails_often(drawn)) {
        return true;
    }
    // A function that is not written yet says nothing about another.
    let core = |case: &CaseResult| match case.tier {
        Tier::Core if !is_unwritten(case) => case.max_score,
        _ => 0.0,
    };
    let all: f64 = known.iter().map(core).sum();
    let (known, lost) = right
        .by_ref()
        .fold((0.0, 0.0), |(known, lost), (drawn, case)| {
            let is_lost = !is_right(drawn);
            (
                known + core(case),
                lost + if is_lost { core(case) } else { 0.0 },
            )
        });
    known > 0.0 && known >= MOST * all && lost >= MOST * known
}

/// Why the code of `task` gets no points for its answers: it learned them by heart. `drawn` is its
/// result with `seed`, `known` that with [`KNOWN_SEED`] if it [is suspicious](is_suspicious), and
/// `has_table` says whether its stage may contain a [table](crate::scan::table).
pub(crate) fn why_learned(
    task: &Task,
    seed: u64,
    drawn: &TaskResult,
    known: Option<&TaskResult>,
    has_table: bool,
) -> Option<String> {
    let how = if known.is_some_and(|known| accuses(drawn, known)) {
        format!(
            "it answers the questions of seed {KNOWN_SEED}, but not those of seed {seed}, which differ in their numbers only. It recognizes the questions"
        )
    } else if has_table && has_answers_from_a_table(&drawn.cases) {
        format!(
            "its stage contains a table, and it answers the questions that students have, moved, but not those whose numbers the seed {seed} draws. It has the answers from the table"
        )
    } else {
        return None;
    };
    Some(format!("{}: no points: {how}", task.key))
}

/// Whether code that contains a table of answers has them from there: it is right in most cases
/// whose questions are only moved, and fails those that the seed draws. Code can undo a move before
/// it looks into the table.
fn has_answers_from_a_table(drawn: &[CaseResult]) -> bool {
    let share = share_of_moved(drawn);
    // Who does not know the answer may as well crash or wait, or say that it is not written. A
    // function that is not written yet has no answers in the other cases, either.
    let has_none = |case: &CaseResult| match is_unwritten(case) {
        true => share >= MOST_WRITTEN,
        false => matches!(case.status, Status::Crashed(_)),
    };
    share >= MOST && core(drawn, true).any(|case| fails_often(case) || has_none(case))
}

/// A sentence for the instructor if the code of a task is nearly always right where questions are
/// only moved, and often wrong where the seed draws them, but there is no more evidence: a small
/// table needs no more numbers than code. An unusual mistake has this effect, too.
pub(crate) fn is_to_check(drawn: &TaskResult) -> Option<String> {
    let (task, drawn) = (&drawn.key, &drawn.cases);
    let is_found = share_of_moved(drawn) >= NEARLY_ALL
        && core(drawn, true).any(|case| fails_often(case) || !is_answered(case));
    is_found.then(|| {
        format!(
            "{task}: its answers are right in the cases that students have, and often wrong in those whose numbers the seed draws, so they may come from a table"
        )
    })
}

/// The core cases whose numbers the seed draws, or the others.
fn core(drawn: &[CaseResult], fresh: bool) -> impl Iterator<Item = &CaseResult> {
    let cases = drawn.iter().filter(|case| case.tier == Tier::Core);
    cases.filter(move |case| case.name.starts_with(FRESH) == fresh)
}

/// The share of the core points that is earned in the cases whose questions are only moved.
fn share_of_moved(drawn: &[CaseResult]) -> f64 {
    let (earned, all) = core(drawn, false).fold((0.0, 0.0), |(earned, all), case| {
        (earned + case.earned * case.max_score, all + case.max_score)
    });
    earned / all
}

fn fails_often(case: &CaseResult) -> bool {
    let wrong = wrong_calls(case);
    case.name.starts_with(FRESH)
        && case.calls >= FEWEST_CALLS
        && (wrong * ONE_WRONG_OF >= case.calls || wrong >= SURELY_NO_CHANCE)
}

/// The calls that are wrong in a main answer.
fn wrong_calls(case: &CaseResult) -> usize {
    let main = case.findings.iter().filter(|finding| finding.main);
    main.map(|finding| finding.wrong as usize)
        .max()
        .unwrap_or(0)
}

fn is_unwritten(case: &CaseResult) -> bool {
    matches!(case.status, Status::NotAttempted | Status::Needs(_))
}

fn is_answered(case: &CaseResult) -> bool {
    matches!(case.status, Status::Passed | Status::Failed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use judge::findings::{Aspect, Finding};

    /// A case of 60 calls, `wrong` of which are wrong.
    fn case(name: &str, wrong: u32) -> CaseResult {
        let finding = Finding {
            expected: 60,
            judged: 60,
            wrong,
            main: true,
            ..Finding::new(Aspect::HitOrMiss)
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
            answer_to_all: None,
        }
    }

    fn task_result(cases: Vec<CaseResult>) -> TaskResult {
        TaskResult {
            key: "part1.task3".into(),
            title: String::new(),
            score: 0.0,
            max_score: 3.0,
            robust_score: 0.0,
            robust_max_score: 0.0,
            status: Status::Failed,
            stage: "intersect".into(),
            functions: Vec::new(),
            cases,
        }
    }

    #[test]
    fn code_that_is_wrong_with_one_seed_only_knows_the_other() {
        for (name, drawn, known, is_by_heart_) in [
            ("fresh_rays", 60, 0, true),
            ("fresh_rays", 12, 0, true),
            // Chance, and a mistake.
            ("fresh_rays", 11, 0, false),
            ("fresh_rays", 60, 1, false),
        ] {
            let [drawn, known] =
                [drawn, known].map(|wrong| [case("a", 0), case("b", 0), case(name, wrong)]);
            assert_eq!(is_by_heart(&drawn, &known), is_by_heart_, "{name}");
        }
    }

    #[test]
    fn code_that_always_misses_is_found_where_most_calls_are_misses() {
        let rare = |wrong| {
            [CaseResult {
                calls: 2000,
                ..case("fresh_rays", wrong)
            }]
        };
        assert!(is_by_heart(&rare(200), &rare(0)));
    }

    #[test]
    fn code_that_fails_most_moved_questions_knows_the_others() {
        let cases = |wrong: [u32; 4]| wrong.map(|wrong| case("moved", wrong));
        let right = cases([0; 4]);
        assert!(is_by_heart(&cases([1, 60, 0, 0]), &right));
        // A mistake that depends on the move, in one case.
        assert!(!is_by_heart(&cases([60, 0, 0, 0]), &right));
        // A mistake that is as wrong without the move.
        assert!(!is_by_heart(
            &cases([60, 60, 60, 0]),
            &cases([60, 60, 60, 0])
        ));
        // Code that knows little loses little.
        assert!(!is_by_heart(&cases([60; 4]), &cases([60, 60, 60, 0])));
    }

    #[test]
    fn a_function_that_is_not_written_does_not_hide_another_that_knows_the_questions() {
        let cases = |wrong: [u32; 4]| {
            let mut cases = wrong.map(|wrong| case("moved", wrong));
            for case in &mut cases[..3] {
                case.status = Status::NotAttempted;
            }
            cases
        };
        let (drawn, known) = (cases([0, 0, 0, 60]), cases([0; 4]));
        assert!(is_by_heart(&drawn, &known));
        assert!(is_suspicious(&task_result(drawn.to_vec())));
        assert!(!is_by_heart(&cases([60, 0, 0, 0]), &known));
    }

    #[test]
    fn answers_from_a_table_are_right_in_all_cases_but_the_fresh_ones() {
        let result = |wrong: [u32; 3], earned: [f64; 3]| {
            let names = ["a", "b", "fresh_rays"];
            let cases = names
                .iter()
                .zip(wrong)
                .zip(earned)
                .map(|((name, wrong), earned)| CaseResult {
                    earned,
                    ..case(name, wrong)
                });
            cases.collect::<Vec<_>>()
        };
        assert!(has_answers_from_a_table(&result(
            [0, 0, 30],
            [1.0, 1.0, 0.0]
        )));
        // It knows the answers; it is right; it is as wrong in the others.
        assert!(!has_answers_from_a_table(&result(
            [0, 0, 2],
            [1.0, 1.0, 0.0]
        )));
        assert!(!has_answers_from_a_table(&result([0; 3], [1.0; 3])));
        assert!(!has_answers_from_a_table(&result([30; 3], [0.0; 3])));
        // Whatever the points of the cases are.
        let mut costly = result([0, 0, 30], [1.0, 1.0, 0.0]);
        costly[0].max_score = 5.0;
        assert!(has_answers_from_a_table(&costly));
        costly[0].earned = 0.0;
        assert!(!has_answers_from_a_table(&costly));
    }

    #[test]
    fn who_has_no_answer_to_fresh_questions_has_the_others_from_a_table() {
        let with = |status: Status| {
            let mut cases = ["a", "b", "fresh_rays"].map(|name| case(name, 0));
            cases[0].earned = 1.0;
            cases[1].earned = 1.0;
            cases[2].status = status;
            cases
        };
        let needs = || Status::Needs("part1.task1".into());
        for status in [
            Status::Crashed("panicked".into()),
            Status::NotAttempted,
            needs(),
        ] {
            assert!(
                has_answers_from_a_table(&with(status.clone())),
                "{status:?}"
            );
            // A function that is not written has no answer in another case, either.
            let mut unwritten = with(status.clone());
            unwritten[1].status = status.clone();
            unwritten[1].earned = 0.0;
            let crashes = matches!(status, Status::Crashed(_));
            assert_eq!(has_answers_from_a_table(&unwritten), crashes, "{status:?}");
        }
        assert!(!has_answers_from_a_table(&with(Status::Passed)));
    }

    #[test]
    fn a_person_should_look_at_answers_that_only_moved_questions_have() {
        let result = |wrong: [u32; 3], status: Status| {
            let names = ["a", "b", "fresh_rays"].into_iter().zip(wrong);
            let cases = names.map(|(name, wrong)| CaseResult {
                earned: if wrong == 0 { 1.0 } else { 0.0 },
                ..case(name, wrong)
            });
            let mut cases: Vec<CaseResult> = cases.collect();
            cases[2].status = status;
            task_result(cases)
        };
        let is_to_check = |result| is_to_check(&result).is_some();
        assert!(is_to_check(result([0, 0, 12], Status::Failed)));
        assert!(is_to_check(result([0, 0, 0], Status::NotAttempted)));
        // A mistake: seldom wrong, or wrong in the others, too.
        assert!(!is_to_check(result([0, 0, 11], Status::Failed)));
        assert!(!is_to_check(result([0, 60, 60], Status::Failed)));
        assert!(!is_to_check(result([0, 0, 0], Status::Passed)));
    }

    #[test]
    fn code_that_crashes_with_the_known_seed_does_not_know_it() {
        let mut known = [case("fresh_rays", 0)];
        known[0].status = Status::Crashed("panicked".into());
        assert!(!is_by_heart(&[case("fresh_rays", 60)], &known));
    }
}
