//! Formats the results of a task's functions, and what costs points without a wrong answer.

use crate::score::functions::{FunctionResult, FunctionStatus};
use crate::score::{CaseResult, Status, TaskResult};
use judge::{Tier, plural};
use std::fmt::Write;

/// The result of each function, if one has a hole: `test_triangle: right in all cases;
/// record_triangle: not written yet`.
pub(super) fn line(task: &TaskResult) -> Option<String> {
    let has_hole = |result: &FunctionResult| {
        use FunctionStatus::{Hole, Unfinished};
        matches!(result.status, Hole | Unfinished { .. })
    };
    task.functions.iter().any(has_hole).then(|| {
        let crashed = task.cases.iter().any(|case| case.crash().is_some());
        let each = task.functions.iter().map(|function| one(function, crashed));
        each.collect::<Vec<String>>().join("; ")
    })
}

/// `crashed` says whether a case of the task has no answers: nobody knows whose fault that is.
fn one(result: &FunctionResult, crashed: bool) -> String {
    let status = match &result.status {
        FunctionStatus::Right if crashed => "right in the cases that do not crash".into(),
        FunctionStatus::Right => "right in all cases".into(),
        FunctionStatus::Wrong { of, wrong } => format!("wrong in {wrong} of {of} cases"),
        FunctionStatus::Hole => "not written yet".into(),
        FunctionStatus::Unfinished { of, open } => {
            format!("reaches code that is not written yet in {open} of {of} cases")
        }
        FunctionStatus::Needs { function } => format!("needs {function}"),
    };
    format!("{}: {status}", result.name)
}

/// The cases that reach code that is not written yet, of a task of which other code is written.
pub(super) fn unwritten(task: &TaskResult) -> Vec<&str> {
    let is_partial = task.status != Status::NotAttempted;
    let cases = task
        .cases
        .iter()
        .filter(|case| is_partial && case.status == Status::NotAttempted);
    cases.map(|case| case.name.as_str()).collect()
}

/// Why the core cases that are right give few points, if the idea of the task is missing.
pub(super) fn reduced(task: &TaskResult) -> Option<String> {
    let core = task.cases.iter().filter(|case| case.tier == Tier::Core);
    let reduced: Vec<&CaseResult> = core.filter(|case| case.lacks_only_the_idea()).collect();
    let why = reduced.first()?.reductions.first()?;
    let cases = plural(
        reduced.len(),
        "other case is right, and",
        "other cases are right, and each",
    );
    Some(format!("{cases} {why}"))
}

/// Adds a line for each thing other than wrong answers that costs points of a case.
pub(super) fn reductions(text: &mut String, case: &CaseResult) {
    for reduction in &case.reductions {
        let _ = writeln!(text, "      {reduction}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_are_listed_if_one_has_a_hole() {
        let result = |name: &str, status| FunctionResult {
            name: name.into(),
            status,
        };
        let mut task = TaskResult {
            key: "part1.task3".into(),
            title: String::new(),
            score: 0.0,
            max_score: 30.0,
            robust_score: 0.0,
            robust_max_score: 0.0,
            status: crate::score::Status::Failed,
            stage: "intersect".into(),
            functions: vec![result("test_triangle", FunctionStatus::Right)],
            cases: Vec::new(),
        };
        assert_eq!(line(&task), None);
        let wrong = FunctionStatus::Wrong { of: 12, wrong: 3 };
        task.functions.push(result("intersect_triangle", wrong));
        let hole = result("record_triangle", FunctionStatus::Hole);
        task.functions.push(hole);
        assert_eq!(
            line(&task).as_deref(),
            Some(
                "test_triangle: right in all cases; intersect_triangle: wrong in 3 of 12 cases; \
                 record_triangle: not written yet"
            )
        );
        let mut crashed = CaseResult::failed("head_on", Vec::new());
        crashed.status = crate::score::Status::Crashed("panicked".into());
        task.cases.push(crashed);
        let says = line(&task).unwrap_or_default();
        assert!(
            says.starts_with("test_triangle: right in the cases that do not crash;"),
            "{says}"
        );
    }
}
