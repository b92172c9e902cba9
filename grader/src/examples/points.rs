//! The points that a course may give for a student's examples.

use super::{parse, review};
use crate::course::Task;
use crate::score::{CaseResult, Status};
use judge::Tier;
use judge::plural;

/// What a report says that it is about.
const ABOUT: &str = "Your own examples of the task are right, and touch several of its situations.";

/// What the examples of `task` earn, if the course gives points for them: all points if they touch
/// half of its situations, a share if they touch fewer, and none as long as one of them is wrong.
/// `text` is `examples.toml` of the task's stage, if there is such a file.
pub fn case_of(task: &Task, text: Option<&str>) -> Option<CaseResult> {
    let entry = task.entry_of_examples()?;
    let (earned, why) = share(&task.key, text.unwrap_or_default());
    let status = match earned {
        None => Status::NotAttempted,
        Some(share) if share < 1.0 => Status::Failed,
        Some(_) => Status::Passed,
    };
    let share = earned.unwrap_or(0.0);
    let reductions = match status {
        Status::Passed => Vec::new(),
        _ => vec![format!(
            "{why}: `cargo grader practice {} --only examples`",
            task.key
        )],
    };
    Some(CaseResult {
        name: entry.name,
        tier: Tier::Robust,
        score: entry.points * share,
        max_score: entry.points,
        earned: share,
        status,
        about: ABOUT.into(),
        findings: Vec::new(),
        reductions,
        shares: Vec::new(),
        with_neighbours: false,
        calls: 0,
        answer_to_all: None,
    })
}

/// The share of their points that the examples in `text` earn, and why it is not 1. `None` if there
/// are no examples of the task.
fn share(task: &str, text: &str) -> (Option<f64>, String) {
    let Ok(examples) = parse(text) else {
        return (Some(0.0), "examples.toml cannot be read".into());
    };
    let found = review(task, &examples);
    let Some(found) = found.filter(|found| !found.verdicts.is_empty()) else {
        return (None, "none are written".into());
    };
    let wrong = found.wrong();
    if wrong > 0 {
        let why = plural(wrong, "example is wrong", "examples are wrong");
        return (Some(0.0), why);
    }
    let touched = found.touched();
    let wanted = found.situations.len().div_ceil(2);
    let share = touched.min(wanted) as f64 / wanted as f64;
    (
        Some(share),
        format!("{touched} of {wanted} situations touched"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::Course;
    use crate::examples::sample;

    fn course(examples: &str) -> Course {
        let list = include_str!("../../../stages/course.toml");
        let key = "key = \"part1.task3\"\n";
        Course::parse(&list.replace(key, &format!("{key}{examples}\n"))).expect("it is valid")
    }

    fn earned(text: Option<&str>) -> (f64, Status, Vec<String>) {
        let course = course("examples = 3.5");
        let task = course.select("part1.task3").expect("it exists")[0];
        assert_eq!(
            task.points(Tier::Robust),
            task.points_of_cases(Tier::Robust) + 3.5
        );
        let case = case_of(task, text).expect("it has points");
        (case.score, case.status, case.reductions)
    }

    #[test]
    fn right_examples_earn_points_by_the_situations_that_they_touch() {
        let one = sample("part1.task3");
        let (score, status, why) = earned(Some(one));
        assert_eq!((score, status), (0.5, Status::Failed));
        assert_eq!(
            why,
            ["1 of 7 situations touched: `cargo grader practice part1.task3 --only examples`"]
        );
        // Beyond two edges each, at an end of the range, behind the origin, not unit, on an edge.
        let others = [
            ("o = [1, 1, -1]", "o = [3, 3, -1]", "\"miss\""),
            ("o = [1, 1, -1]", "o = [1, -1, -1]", "\"miss\""),
            ("o = [1, 1, -1]", "o = [-1, 1, -1]", "\"miss\""),
            ("o = [1, 1, -1]", "o = [1, 1, 1]", "\"miss\""),
            ("d = [0, 0, 1]", "d = [0, 0, 2]", "0.5"),
            ("o = [1, 1, -1]", "o = [2, 0, -1]", "1"),
        ];
        let other = |(from, to, expected): (&str, &str, &str)| {
            one.replace(from, to)
                .replace("expected = 1 ", &format!("expected = {expected} "))
        };
        let all: String = others.map(other).concat() + one;
        assert_eq!(earned(Some(&all)), (3.5, Status::Passed, Vec::new()));
        let wrong = format!("{all}{}", one.replace("expected = 1 ", "expected = 7 "));
        let (score, status, why) = earned(Some(&wrong));
        assert_eq!((score, status), (0.0, Status::Failed));
        assert!(why[0].starts_with("1 example is wrong"), "{why:?}");
    }

    #[test]
    fn without_examples_or_points_there_is_nothing_to_earn() {
        for none in [None, Some(""), Some(sample("part1.task4"))] {
            let (score, status, _) = earned(none);
            assert_eq!((score, status), (0.0, Status::NotAttempted));
        }
        let (score, _, why) = earned(Some("[[triangle]]\nq = 1"));
        assert!(score == 0.0 && why[0].starts_with("examples.toml cannot be read"));
        let course = course("");
        let task = course.select("part1.task3").expect("it exists")[0];
        assert!(case_of(task, None).is_none());
    }
}
