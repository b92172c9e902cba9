//! The page of one student.

use super::{escape, list, page as whole_page};
use crate::collect::{Case, Class, Row, StudentReport, Task, points};
use grader::report::HintLevel;
use std::fmt::Write;

/// At most so many characters of what the compiler or the code printed are shown.
const MAX_TEXT: usize = 20_000;

/// The page of the submission `row`, which reveals as much as `hint` says.
pub fn page(class: &Class, row: &Row, hint: HintLevel) -> String {
    let what = &class.plan.settings.what;
    let mut html = format!("<h1>{}</h1>\n", escape(&row.name));
    match (&row.score, &row.graded) {
        (Some(score), Some(_)) => {
            let [max_core, max_extra] = class.max_score();
            let _ = writeln!(
                html,
                "<p><strong>{} of {} points</strong>, extra credit {} of {}</p>",
                points(score.core),
                points(max_core),
                points(score.extra),
                points(max_extra)
            );
        }
        (Some(_), None) => html.push_str("<p><strong>0 points</strong></p>\n"),
        (None, _) => html.push_str("<p><strong>No score yet.</strong></p>\n"),
    }
    let _ = writeln!(
        html,
        "<p class=\"soft\">{}: {}</p>",
        escape(what),
        escape(&row.status.to_string())
    );
    html.push_str(&list(&row.notes));
    if let Some((unit, report)) = &row.graded {
        html.push_str(&table(report));
        for task in &report.tasks {
            html.push_str(&task_section(task, report, hint));
        }
        if !report.compiler.is_empty() {
            let _ = write!(
                html,
                "<h2>Why code was not compiled</h2>\n<pre class=\"sentences\">{}</pre>\n",
                escape(&shortened(&report.compiler))
            );
        }
        if !report.printed.is_empty() {
            let _ = write!(
                html,
                "<h2>What the code printed</h2>\n<pre>{}</pre>\n",
                escape(&shortened(&report.printed))
            );
        }
        let _ = write!(
            html,
            "<p class=\"soft\">Random inputs: seed {}. ",
            unit.seed
        );
        if !report.containment.is_empty() {
            let _ = write!(html, "Containment: {}. ", escape(&report.containment));
        }
        let _ = writeln!(html, "Submission {}.</p>", escape(&unit.submission));
    }
    whole_page(&format!("{}, {what}", row.name), &html)
}

fn table(report: &StudentReport) -> String {
    let mut html = String::from(
        "<div class=\"scroll\"><table>\n<tr><th>task</th><th></th><th class=\"number\">points</th><th class=\"number\">extra</th></tr>\n",
    );
    for task in &report.tasks {
        let _ = writeln!(
            html,
            "<tr><td><a href=\"#{0}\">{0}</a></td><td>{1}</td><td class=\"number\">{2} of {3}</td><td class=\"number\">{4} of {5}</td></tr>",
            escape(&task.key),
            escape(&task.title),
            points(task.score),
            points(task.max_score),
            points(task.robust_score),
            points(task.robust_max_score)
        );
    }
    html + "</table></div>\n"
}

fn task_section(task: &Task, report: &StudentReport, hint: HintLevel) -> String {
    let share = match task.max_score > 0.0 {
        true => (100.0 * task.score / task.max_score).clamp(0.0, 100.0),
        false => 100.0,
    };
    let mut html = format!(
        "<h2 id=\"{0}\">{0} {1}</h2>\n<div class=\"meter\"><span style=\"width: {share:.0}%\"></span></div>\n<p>{2} of {3} points. {4}</p>\n",
        escape(&task.key),
        escape(&task.title),
        points(task.score),
        points(task.max_score),
        status(task, report)
    );
    if hint >= HintLevel::Findings && !task.regularities.is_empty() {
        html.push_str(&list(&task.regularities));
    }
    if let Some(diagnosis) = task
        .diagnosis
        .as_ref()
        .filter(|_| hint >= HintLevel::Mistake)
    {
        let label = match diagnosis.certainty.as_str() {
            "likely" => "Likely",
            _ => "Perhaps",
        };
        let _ = writeln!(
            html,
            "<p><strong>{label}:</strong> {}</p>",
            escape(&diagnosis.says)
        );
        if hint >= HintLevel::Remedy {
            let _ = writeln!(html, "<p>{}</p>", escape(&diagnosis.hint));
        }
    }
    let is_told = |case: &&Case| {
        case.tier == "core"
            && case.score < case.max_score
            && !["not_attempted", "does_not_compile"].contains(&case.status.as_str())
    };
    for case in task.cases.iter().filter(is_told) {
        html.push_str(&case_card(case, hint));
    }
    if let Some(test) = task
        .worst_as_test
        .as_ref()
        .filter(|_| hint >= HintLevel::Findings)
    {
        let _ = writeln!(
            html,
            "<h3>The worst answer as a test</h3>\n<pre>{}</pre>",
            escape(&shortened(test))
        );
    }
    html
}

fn case_card(case: &Case, hint: HintLevel) -> String {
    // Why simple formulas fail there is a hint of its own.
    let about = match hint {
        HintLevel::Cases => case.about.split(" Pitfall:").next().unwrap_or_default(),
        _ => &case.about,
    };
    let mut html = format!(
        "<div class=\"card\"><strong>{}</strong> <span class=\"bad\">{} of {}</span>\n<p>{}</p>\n",
        escape(&case.name),
        points(case.score),
        points(case.max_score),
        escape(about)
    );
    if hint >= HintLevel::Findings {
        if let Some(detail) = &case.detail {
            let _ = writeln!(
                html,
                "<p>Your code {}.</p>",
                escape(detail.trim_end_matches('.'))
            );
        }
        for finding in case.findings.iter().filter(|finding| finding.wrong > 0) {
            let _ = write!(
                html,
                "<p>{} wrong on {} of {} calls.",
                escape(finding.aspect.label()),
                finding.wrong,
                finding.judged
            );
            if let Some(worst) = &finding.worst {
                let _ = write!(html, " <code>{}</code>", escape(&worst.message));
            }
            html.push_str("</p>\n");
        }
        html.push_str(&list(&case.reductions));
    }
    html + "</div>\n"
}

/// The sentence about the status of a task.
fn status(task: &Task, report: &StudentReport) -> &'static str {
    match task.status.as_str() {
        "passed" => "Everything is right.",
        "not_attempted" if report.missing.contains(&task.stage) => "Its stage was not handed in.",
        "not_attempted" => "It is not written yet.",
        "does_not_compile" if report.refused_stages.contains_key(&task.stage) => {
            "Its stage was refused before it was compiled: the reasons are below."
        }
        "does_not_compile" => "Its stage does not compile: the messages about it are below.",
        "crashed" => "The code crashed.",
        "needs" => "It could not run, because it needs another stage.",
        _ => "Some answers are wrong.",
    }
}

/// The start of a long text.
fn shortened(text: &str) -> String {
    match text.char_indices().nth(MAX_TEXT) {
        Some((end, _)) => format!("{}\n... and {} more bytes", &text[..end], text.len() - end),
        None => text.trim_end().to_string(),
    }
}
