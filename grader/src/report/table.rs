//! Formats the report for people: a table of scores, then the failed cases in as much detail as the
//! hint level allows.

use super::message;
use super::terminal::{stdout_has_colours, style_of};
use super::{HintLevel, Report, Reveal, TaskReport};
use crate::course::chapter::{Section, section};
use crate::diagnosis::Diagnosis;
use crate::score::{CaseResult, Status, TaskResult, order};
use crate::sketch::Sketch;
use comfy_table::{Cell, CellAlignment, Table, presets};
use judge::Tier;
use judge::cases::checked;
use judge::errors::ErrorSpread;
use judge::findings::{Aspect, Finding};
use judge::plural;
use std::fmt::Write;

/// Columns of the drawing in a long report.
const LONG: usize = 80;

/// How many failed cases of a task are shown in full. The others are only named.
const CASES_IN_FULL: usize = 5;

/// Formats the report for people.
pub fn format_report(report: &Report, reveal: Reveal) -> String {
    let mut table = Table::new();
    table
        .load_style(presets::UTF8_BORDERS_ONLY)
        .set_header(["task", "", "core", "extra", "status"]);
    for TaskReport { result: task, .. } in &report.tasks {
        table.add_row([
            Cell::new(&task.key),
            Cell::new(&task.title),
            points(task.score, task.max_score),
            points(task.robust_score, task.robust_max_score),
            Cell::new(summary(task)),
        ]);
    }
    let mut text = format!("{}\n", coloured(&table.to_string(), report));
    rounding_errors(&mut text, report);
    for task in &report.tasks {
        details(&mut text, task, reveal);
    }
    if let Some(speedups) = &report.speedups {
        text.push_str(&super::speedups::format_speedups(speedups));
    }
    let (score, max_score) = (number(report.score), number(report.max_score));
    let _ = writeln!(text, "\nscore {score} of {max_score}");
    if report.robust_max_score > 0.0 {
        let (score, max_score) = (number(report.robust_score), number(report.robust_max_score));
        let _ = writeln!(
            text,
            "extra credit {score} of {max_score}, for answers that stay right where textbook formulas fail"
        );
    }
    for TaskReport { result: task, .. } in &report.tasks {
        for sentence in message::undecided(task) {
            let _ = writeln!(text, "{sentence}");
        }
    }
    for sentence in super::not_judged(report) {
        let _ = writeln!(text, "{sentence}");
    }
    text
}

/// Adds the rounding errors of `t` in the cases whose `t` is right, task by task. They depend on
/// the formula that the code uses.
fn rounding_errors(text: &mut String, report: &Report) {
    let mut lines = String::new();
    for TaskReport { result: task, .. } in &report.tasks {
        for (tier, name) in [(Tier::Core, "core"), (Tier::Robust, "extra")] {
            let cases = task.cases.iter().filter(|case| case.tier == tier);
            let errors = cases
                .flat_map(|case| &case.findings)
                .filter(|finding| finding.aspect == Aspect::T && finding.wrong == 0)
                .flat_map(|finding| &finding.errors);
            if let Some(spread) = ErrorSpread::of(errors) {
                let [p50, p99, max] = [spread.p50, spread.p99, spread.max].map(ulps);
                let percent = 100.0 * spread.of_bound;
                let _ = writeln!(
                    lines,
                    "  {} {name:5}  50 % within {p50} ulp, 99 % within {p99} ulp, all within {max} ulp: {percent:.0} % of the allowed error",
                    task.key
                );
            }
        }
    }
    if !lines.is_empty() {
        let _ = write!(
            text,
            "\nRounding errors of t where all are right, in ulp (units in the last place):\n{lines}"
        );
    }
}

/// A number of ulps with two significant digits, or with all digits before the decimal point.
fn ulps(ulps: f64) -> String {
    if ulps < 10.0 {
        format!("{ulps:.1}")
    } else if ulps < 1e6 {
        format!("{ulps:.0}")
    } else {
        format!("{ulps:.1e}")
    }
}

fn points(score: f64, max_score: f64) -> Cell {
    let text = if max_score > 0.0 {
        format!("{}/{}", number(score), number(max_score))
    } else {
        String::new()
    };
    Cell::new(text).set_alignment(CellAlignment::Right)
}

/// A number of points, with the noun.
fn points_of(points: f64) -> String {
    let noun = if points == 1.0 { "point" } else { "points" };
    format!("{} {noun}", number(points))
}

/// A number of points with at most two decimals and no trailing zeros.
pub(crate) fn number(points: f64) -> String {
    let text = format!("{points:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}

/// Colours each task's status in the table, if stdout has colours.
fn coloured(table: &str, report: &Report) -> String {
    if !stdout_has_colours() {
        return table.to_owned();
    }
    let lines = table.lines().map(|line| {
        let mut results = report.tasks.iter().map(|task| &task.result);
        let row = results.find(|task| line.contains(&task.key));
        let status = row.map(|task| (style_of(task), summary(task)));
        match status.and_then(|(colour, status)| Some((colour, line.rsplit_once(&status)?, status)))
        {
            Some((colour, (before, after), status)) => {
                format!("{before}{colour}{status}{colour:#}{after}")
            }
            None => line.to_owned(),
        }
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// The status of a task in a few words, such as "3 of 12 cases failed".
pub fn summary(task: &TaskResult) -> String {
    let lost = |tier: Tier| {
        let failed = |case: &&CaseResult| {
            let counts = !matches!(case.status, Status::Passed | Status::Needs(_));
            case.tier == tier && counts && !case.is_only_reduced()
        };
        task.cases.iter().filter(failed).count()
    };
    let summary = match &task.status {
        Status::Failed if lost(Tier::Core) > 0 => {
            format!(
                "{} of {} cases failed",
                lost(Tier::Core) + lost(Tier::Robust),
                task.cases.len()
            )
        }
        Status::Failed if lost(Tier::Robust) > 0 => {
            let failed = plural(lost(Tier::Robust), "case", "cases");
            format!("passed; {failed} of extra credit failed")
        }
        Status::Failed => "passed".into(),
        status => return status_text(status),
    };
    match waiting(task) {
        Some(waiting) => format!("{summary}; {waiting}"),
        None => summary,
    }
}

/// How many cases need another task to be written first, and which task.
pub(super) fn waiting(task: &TaskResult) -> Option<String> {
    let mut needs = task.cases.iter().filter_map(|case| match &case.status {
        Status::Needs(other) => Some(other),
        _ => None,
    });
    let count = needs.clone().count();
    let cases = plural(count, "case needs", "cases need");
    needs.next_back().map(|other| format!("{cases} {other}"))
}

/// A status as text.
pub fn status_text(status: &Status) -> String {
    match status {
        Status::Passed => "passed".into(),
        Status::Failed => "failed".into(),
        Status::NotAttempted => "not attempted".into(),
        Status::Needs(task) => format!("needs {task}"),
        Status::Crashed(ended) => ended.to_string(),
        Status::DoesNotCompile => "does not compile".into(),
    }
}

/// What the report says about one task: its failed cases in as much detail as `reveal` allows, or
/// why it has none. Empty if every case passes.
pub fn task_text(report: &TaskReport, reveal: Reveal) -> String {
    let mut text = String::new();
    details(&mut text, report, reveal);
    if text.is_empty() && report.result.status != Status::Passed {
        let _ = writeln!(text, "{}: {}", report.result.key, summary(&report.result));
    }
    text.trim_start().to_owned()
}

fn details(text: &mut String, report: &TaskReport, Reveal { hint, extra }: Reveal) {
    let task = &report.result;
    // Core cases come first.
    let (core, robust): (Vec<_>, Vec<_>) = task
        .failed_cases()
        .partition(|case| case.tier == Tier::Core);
    let unwritten = super::functions::unwritten(task);
    if core.is_empty() && robust.is_empty() && unwritten.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n{}  {}", task.key, task.title);
    if let Some(functions) = super::functions::line(task) {
        let _ = writeln!(text, "  {functions}");
    }
    if !unwritten.is_empty() {
        let names = unwritten.join(", ");
        let _ = writeln!(
            text,
            "  Cases that reach code that is not written yet: {names}"
        );
    }
    if let Some(reduced) = super::functions::reduced(task) {
        let _ = writeln!(text, "  {reduced}");
    }
    if core.is_empty() && robust.is_empty() {
        return;
    }
    // A mistake is a name for lost core points: code without it may still lose extra credit.
    if !core.is_empty() || extra {
        explanation(text, report, hint, !core.is_empty());
    }
    let simplest = report.simplest.as_ref();
    if let Some(call) = simplest.filter(|_| hint >= HintLevel::Findings) {
        let _ = writeln!(
            text,
            "  Simplest such call: {}\n    {}",
            message::input(call),
            message::found(call)
        );
        if let Some(only) = &call.only {
            let _ = writeln!(text, "    ({only})");
        }
        let sketch = call.shown.as_ref().and_then(Sketch::of);
        for line in sketch.iter().flat_map(|sketch| sketch.text(LONG)) {
            let _ = writeln!(text, "{line}");
        }
    }
    failed_cases(text, &core, hint);
    if task.score < task.max_score && !robust.is_empty() {
        // These cases often fail for the same reason as the core cases.
        let _ = writeln!(
            text,
            "  extra credit: {} of {}; the failed cases are shown once every core case passes",
            number(task.robust_score),
            points_of(task.robust_max_score)
        );
    } else if !robust.is_empty() && !extra {
        let _ = writeln!(
            text,
            "  extra credit: {} of {}; `--extra` shows the failed cases",
            number(task.robust_score),
            points_of(task.robust_max_score)
        );
        return;
    } else if !robust.is_empty() {
        text.push_str("  extra credit:\n");
        failed_cases(text, &robust, hint);
    }
    if hint >= HintLevel::Findings
        && let Some(test) = &report.worst_as_test
    {
        let what = match simplest {
            Some(_) => "The simplest call",
            None => "The worst answer",
        };
        let _ = writeln!(
            text,
            "\n  {what} as a test. Save it as stages/{0}/tests/worst.rs (create the folder if necessary), \
             then run `cargo test -p {0} --test worst`:\n",
            task.stage
        );
        test.lines().for_each(|line| {
            let _ = writeln!(text, "    {line}");
        });
    }
}

/// Adds what explains the wrong answers: the known mistake, and what they have in common where this
/// is not shown or not likely. That no known mistake fits is only said about lost core points.
fn explanation(text: &mut String, report: &TaskReport, hint: HintLevel, is_core: bool) {
    let diagnosis = report
        .diagnosis
        .as_ref()
        .filter(|_| hint >= HintLevel::Mistake);
    match diagnosis {
        Some(diagnosis) => {
            let _ = writeln!(
                text,
                "  {}: {}.",
                diagnosis.certainty.label(),
                diagnosis.says
            );
            if hint >= HintLevel::Remedy {
                let before = diagnosis.certainty.before_hint();
                let _ = writeln!(text, "  {before}: {}", diagnosis.hint);
                if let Some(place) = section(&report.result.key, Section::Mistakes) {
                    let _ = writeln!(text, "  More in the book: {place}");
                }
            }
        }
        None if hint >= HintLevel::Mistake && is_core => {
            text.push_str(
                "  No known mistake can be named: none gives these answers, or several do.\n",
            );
        }
        None => {}
    }
    if diagnosis.is_some_and(Diagnosis::is_likely) || hint < HintLevel::Findings {
        return;
    }
    if !report.regularities.is_empty() {
        text.push_str("  What the wrong answers have in common:\n");
    }
    for sentence in &report.regularities {
        let _ = writeln!(text, "  - {sentence}");
    }
    if diagnosis.is_none() {
        text.push_str("  Failed cases:\n");
    }
}

/// Adds the first few cases in full, then the names of the others. Cases that show something new
/// come first.
fn failed_cases(text: &mut String, cases: &[&CaseResult], hint: HintLevel) {
    let cases = order::new_faults_first(cases);
    let (full, rest) = cases.split_at(cases.len().min(CASES_IN_FULL));
    full.iter().for_each(|case| one_case(text, case, hint));
    if !rest.is_empty() {
        let names: Vec<&str> = rest.iter().map(|case| case.name.as_str()).collect();
        let _ = writeln!(text, "  and {}", names.join(", "));
    }
}

fn one_case(text: &mut String, case: &CaseResult, hint: HintLevel) {
    let (score, max_score) = (number(case.score), number(case.max_score));
    let about = if hint >= HintLevel::Findings {
        &case.about
    } else {
        checked(&case.about)
    };
    let _ = writeln!(text, "  {}  {score}/{max_score}  {about}", case.name);
    if case.status != Status::Failed {
        let _ = writeln!(text, "      {}", status_text(&case.status));
    }
    super::functions::reductions(text, case);
    if hint >= HintLevel::Findings {
        let failed = case.findings.iter().filter(|finding| !finding.passed());
        let (wrong, untested): (Vec<_>, Vec<_>) = failed.partition(|finding| finding.wrong > 0);
        wrong.iter().for_each(|finding| one_finding(text, finding));
        if !untested.is_empty() {
            let labels: Vec<&str> = untested
                .iter()
                .map(|finding| finding.aspect.label())
                .collect();
            let _ = writeln!(
                text,
                "      not tested, because earlier fields of every answer are wrong: {}",
                labels.join(", ")
            );
        }
    }
}

fn one_finding(text: &mut String, finding: &Finding) {
    let label = finding.aspect.label();
    let _ = writeln!(
        text,
        "      {label}: wrong on {} of {}",
        finding.wrong, finding.judged
    );
    if let Some(worst) = &finding.worst {
        let _ = writeln!(text, "          {}", worst.message);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn task(statuses: &[Status]) -> TaskResult {
        let cases = statuses.iter().map(|status| CaseResult {
            status: status.clone(),
            ..CaseResult::failed("case", Vec::new())
        });
        TaskResult {
            key: "part2.task3".into(),
            title: String::new(),
            score: 0.0,
            max_score: 1.0,
            robust_score: 0.0,
            robust_max_score: 0.0,
            status: Status::Failed,
            stage: "bvh".into(),
            functions: Vec::new(),
            cases: cases.collect(),
        }
    }

    #[test]
    fn hint_level_1_does_not_show_the_pitfall() {
        let mut task = task(&[Status::Failed]);
        task.cases[0].about = "Rays beside it. Pitfall: an epsilon.".into();
        let shown = |hint| {
            let mut text = String::new();
            details(
                &mut text,
                &task.clone().into(),
                Reveal { hint, extra: false },
            );
            text
        };
        let first = shown(HintLevel::Cases);
        assert!(first.contains("Rays beside it.\n"), "{first}");
        assert!(shown(HintLevel::Findings).contains("Pitfall: an epsilon."));
    }

    #[test]
    fn the_number_of_failed_robust_cases_is_singular_or_plural() {
        let robust = |statuses: &[Status]| {
            let mut task = task(statuses);
            task.cases
                .iter_mut()
                .for_each(|case| case.tier = Tier::Robust);
            summary(&task)
        };
        let one = robust(&[Status::Passed, Status::Failed]);
        assert_eq!(one, "passed; 1 case of extra credit failed");
        let two = robust(&[Status::Failed, Status::Failed]);
        assert_eq!(two, "passed; 2 cases of extra credit failed");
    }

    #[test]
    fn a_case_that_needs_another_task_is_not_counted_as_failed() {
        let needs = Status::Needs("part1.task3".into());
        let waits = task(&[Status::Passed, needs.clone()]);
        assert_eq!(summary(&waits), "passed; 1 case needs part1.task3");
        let both = task(&[Status::Failed, needs.clone(), needs]);
        assert_eq!(
            summary(&both),
            "1 of 3 cases failed; 2 cases need part1.task3"
        );
    }

    #[test]
    fn cases_that_reach_a_gap_are_named() {
        let mut task = task(&[Status::Passed, Status::NotAttempted]);
        task.cases[1].name = "no_samples".into();
        let hint = HintLevel::Findings;
        let shown = task_text(&task.into(), Reveal { hint, extra: false });
        let expected = "Cases that reach code that is not written yet: no_samples";
        assert!(shown.contains(expected), "{shown}");
    }

    #[test]
    fn failed_robust_cases_are_hidden_until_every_core_case_passes() {
        let mut failing = task(&[Status::Failed, Status::Failed]);
        failing.cases[1].tier = Tier::Robust;
        failing.cases[1].name = "by_a_hair".into();
        failing.robust_max_score = 2.0;
        let shown = |task: &TaskResult, extra: bool| {
            let mut text = String::new();
            let hint = HintLevel::Remedy;
            details(&mut text, &task.clone().into(), Reveal { hint, extra });
            text
        };
        let hidden = shown(&failing, true);
        assert!(hidden.contains("extra credit: 0 of 2 points"), "{hidden}");
        assert!(!hidden.contains("by_a_hair"), "{hidden}");
        failing.robust_max_score = 1.0;
        let of_one = shown(&failing, true);
        assert!(of_one.contains("extra credit: 0 of 1 point;"), "{of_one}");
        failing.robust_max_score = 2.0;
        failing.cases[0].status = Status::Passed;
        failing.score = failing.max_score;
        let all = shown(&failing, true);
        assert!(all.contains("extra credit:\n  by_a_hair"), "{all}");
        assert!(!all.contains("no known mistake"), "{all}");
        let one_line = shown(&failing, false);
        assert!(
            one_line.contains("0 of 2 points; `--extra` shows"),
            "{one_line}"
        );
        assert!(!one_line.contains("by_a_hair"), "{one_line}");
    }
}
