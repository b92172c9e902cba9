//! Formats the results of a task's functions, and what costs points without a wrong answer.

use crate::score::functions::{FunctionResult, FunctionStatus};
use crate::score::{CaseResult, TaskResult};
use std::fmt::Write;

/// The result of each function, if one has a hole: `test_triangle: right in all cases;
/// record_triangle: not written yet`.
pub(super) fn line(task: &TaskResult) -> Option<String> {
    let has_hole = |result: &FunctionResult| result.status == FunctionStatus::Hole;
    task.functions.iter().any(has_hole).then(|| {
        let results: Vec<String> = task.functions.iter().map(one).collect();
        results.join("; ")
    })
}

fn one(result: &FunctionResult) -> String {
    let status = match &result.status {
        FunctionStatus::Right => "right in all cases".into(),
        FunctionStatus::Wrong { of, wrong } => format!("wrong in {wrong} of {of} cases"),
        FunctionStatus::Hole => "not written yet".into(),
        FunctionStatus::Needs { function } => format!("needs {function}"),
    };
    format!("{}: {status}", result.name)
}

/// Adds a line for each thing other than wrong answers that costs points of a case.
pub(super) fn reductions(text: &mut String, case: &CaseResult) {
    for reduction in &case.reductions {
        let _ = writeln!(text, "      {reduction}");
    }
}
