//! The report as a table, then what failed.

use crate::course::Tier;
use crate::score::{CaseResult, Report, Status, TaskResult};
use comfy_table::{Cell, CellAlignment, Table, presets};
use std::fmt::Write;

/// The report for people.
pub fn show(report: &Report) -> String {
    let mut table = Table::new();
    table
        .load_style(presets::UTF8_HORIZONTAL_ONLY)
        .set_header(["task", "", "core", "robust", ""]);
    for task in &report.tasks {
        table.add_row([
            Cell::new(&task.key),
            Cell::new(&task.title),
            points(task.score, task.max_score),
            points(task.robust_score, task.robust_max_score),
            Cell::new(summary(task)),
        ]);
    }
    let mut text = format!("{table}\n");
    for task in &report.tasks {
        details(&mut text, task);
    }
    let _ = writeln!(
        text,
        "\nscore {} of {}",
        number(report.score),
        number(report.max_score)
    );
    if report.robust_max_score > 0.0 {
        let _ = writeln!(
            text,
            "extra credit {} of {}",
            number(report.robust_score),
            number(report.robust_max_score)
        );
    }
    text
}

fn points(score: f64, max_score: f64) -> Cell {
    let text = if max_score > 0.0 {
        format!("{}/{}", number(score), number(max_score))
    } else {
        String::new()
    };
    Cell::new(text).set_alignment(CellAlignment::Right)
}

/// At most two decimals, none that say nothing.
fn number(points: f64) -> String {
    let text = format!("{points:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

fn summary(task: &TaskResult) -> String {
    match &task.status {
        Status::Failed => {
            let failed = task
                .cases
                .iter()
                .filter(|case| case.status != Status::Passed)
                .count();
            format!("{failed} of {} cases lost points", task.cases.len())
        }
        status => describe(status),
    }
}

fn describe(status: &Status) -> String {
    match status {
        Status::Passed => "passed".into(),
        Status::Failed => "lost points".into(),
        Status::NotAttempted => "not attempted".into(),
        Status::Needs(task) => format!("needs {task}"),
        Status::Crashed(how) => how.clone(),
        Status::DoesNotCompile => "does not compile".into(),
        Status::Skipped => "skipped: earlier cases of this task timed out".into(),
    }
}

fn details(text: &mut String, task: &TaskResult) {
    if matches!(
        task.status,
        Status::Passed | Status::NotAttempted | Status::DoesNotCompile | Status::Needs(_)
    ) {
        return;
    }
    let _ = writeln!(text, "\n{} {}", task.key, task.title);
    for case in task
        .cases
        .iter()
        .filter(|case| case.status != Status::Passed)
    {
        one_case(text, case);
    }
}

fn one_case(text: &mut String, case: &CaseResult) {
    let tier = if case.tier == Tier::Robust {
        " (robust)"
    } else {
        ""
    };
    let _ = writeln!(
        text,
        "  {}{tier}  {}/{}  {}",
        case.name,
        number(case.score),
        number(case.max_score),
        case.about
    );
    if case.status != Status::Failed {
        let _ = writeln!(text, "      {}", describe(&case.status));
    }
    for finding in case.findings.iter().filter(|finding| !finding.passed()) {
        let _ = writeln!(
            text,
            "      {}: wrong on {} of {}",
            finding.aspect.label(),
            finding.wrong,
            finding.judged
        );
        if let Some(worst) = &finding.worst {
            let _ = writeln!(text, "        {}", worst.message);
        }
    }
}
