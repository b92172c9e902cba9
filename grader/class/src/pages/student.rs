//! The page of one student.

use super::legend::marks;
use super::{list, missing, page as whole_page};
use crate::by_hand::signed;
use crate::collect::{Case, Details, Row, Status, StudentReport, Task, points};
use crate::plan::Plan;
use ::pages::html::image_uri;
use grader::report::HintLevel;
use judge::Tier;
use maud::{Markup, html};
use submission::Untrusted;

/// At most so many characters of what the compiler or the code printed are shown.
const MAX_TEXT: usize = 20_000;

/// The page of the submission `row`, which reveals as much as `hint` says.
/// `picture` reads the pictures of units by their names.
pub fn page(
    plan: &Plan,
    row: &Row,
    details: Option<&Details>,
    hint: HintLevel,
    picture: &dyn Fn(&str) -> Option<Vec<u8>>,
) -> String {
    let what = &plan.settings.what;
    let [max_core, max_extra] = plan.max_score().map(points);
    let is_held_back = row.status == Status::HeldBack;
    let details = details.filter(|_| !is_held_back);
    let body = html! {
        h1 { (row.who().line()) }
        @match (&row.score, details) {
            (Some(score), Some(_)) => p {
                strong { (points(score.core)) " of " (max_core) " points" }
                ", extra credit " (points(score.extra)) " of " (max_extra)
                @if row.by_hand != 0.0 { ". The code earned " (points(score.core - row.by_hand)) "." }
            },
            (Some(score), None) => p { strong { (points(score.core)) " points" } },
            (None, _) => p { strong { "No score yet." } },
        }
        p.soft {
            (what) ": "
            @match &row.status {
                // Why is for the person who grades: it may name folders of the machine.
                Status::Infrastructure(_) => "the grader failed, not your code. A person looks at it.",
                Status::HeldBack => "held back until your teacher has decided.",
                status => (status.to_string()),
            }
        }
        (list(&row.given))
        @if !is_held_back { (list(&row.notes)) }
        @if let Some((unit, report)) = details {
            @for task in told(report) {
                @let sheet = unit.pictures.get(&task.key).and_then(|name| picture(name));
                (task_section(task, report, hint, sheet.as_deref()))
            }
            h2 { "All tasks" }
            (table(report, row))
            @if !report.compiler.is_empty() {
                h2 { "Why code was not compiled" }
                pre.sentences { (shortened(&report.compiler)) }
            }
            @if !report.printed.is_empty() {
                h2 { "What the code printed" }
                pre { (shortened(&report.printed)) }
            }
            p.soft {
                // Not the seed: who knows it knows every question of a second try.
                @if !report.containment.is_empty() { "Containment: " (report.containment) ". " }
                "Submission " (unit.submission) "."
            }
        }
    };
    whole_page(&format!("{}, {what}", row.who().line()), &body, None)
}

/// The tasks about which there is more to tell than their points. Those that lost core points come
/// first: the page opens with what is wrong.
fn told(report: &StudentReport) -> Vec<&Task> {
    let mut tasks: Vec<&Task> = report.tasks.iter().filter(|task| is_told(task)).collect();
    tasks.sort_by_key(|task| task.score >= task.max_score);
    tasks
}

fn is_told(task: &Task) -> bool {
    task.status != "passed" || task.score < task.max_score
}

fn table(report: &StudentReport, row: &Row) -> Markup {
    let by_hand = |task: &Task| {
        let score = row
            .score
            .as_ref()
            .and_then(|score| score.tasks.get(&task.key));
        score.map_or(0.0, |[core, _]| core - task.score)
    };
    html! {
        div.scroll {
            table {
                tr { th { "task" } th {} th.number { "points" } th.number { "extra" } }
                @for task in &report.tasks {
                    tr {
                        td {
                            @match is_told(task) {
                                true => a href=(format!("#{}", task.key)) { (task.key) },
                                false => (task.key),
                            }
                        }
                        td { (task.title) }
                        td.number {
                            (points(task.score)) " of " (points(task.max_score))
                            @if by_hand(task) != 0.0 { ", by hand " (signed(by_hand(task))) }
                        }
                        td.number { (points(task.robust_score)) " of " (points(task.robust_max_score)) }
                    }
                }
            }
        }
    }
}

fn task_section(
    task: &Task,
    report: &StudentReport,
    hint: HintLevel,
    sheet: Option<&[u8]>,
) -> Markup {
    let share = match task.max_score > 0.0 {
        true => (100.0 * task.score / task.max_score).clamp(0.0, 100.0),
        false => 100.0,
    };
    let lost_points = |case: &&Case| {
        case.tier == Tier::Core
            && case.score < case.max_score
            && case.status != "does_not_compile"
            && (case.status != NOT_ATTEMPTED || task.status != NOT_ATTEMPTED)
    };
    let diagnosis = task.diagnosis.as_ref();
    let test = task.worst_as_test.as_ref();
    html! {
        h2 id=(task.key) { (task.key) " " (task.title) }
        div.meter { span style=(format!("width: {share:.0}%")) {} }
        p { (points(task.score)) " of " (points(task.max_score)) " points. " (status(task, report)) }
        @if let Some(call) = task.simplest.as_ref().filter(|_| hint >= HintLevel::Findings) { (missing::simplest(call)) }
        @if let Some(sheet) = sheet { (picture_of(task, sheet)) }
        @if hint >= HintLevel::Findings { (list(&task.regularities)) }
        @if let Some(diagnosis) = diagnosis.filter(|_| hint >= HintLevel::Mistake) {
            @let is_likely = diagnosis.certainty == "likely";
            p {
                strong { @if is_likely { "Likely:" } @else { "Perhaps:" } }
                " " (diagnosis.says)
            }
            @if hint >= HintLevel::Remedy {
                p { @if !is_likely { "If so: " } (diagnosis.hint) }
            }
        }
        @for case in task.cases.iter().filter(lost_points) { (case_card(case, hint)) }
        @if let Some(test) = test.filter(|_| hint >= HintLevel::Findings) {
            h3 { "The worst answer as a test" }
            pre { (shortened(test)) }
        }
    }
}

/// The picture of a task: expected, the student's, and where they differ.
fn picture_of(task: &Task, file: &[u8]) -> Markup {
    let marks = marks(&task.key, file);
    html! {
        div.thirds.soft { span { "expected" } span { "yours" } span { "where they differ" } }
        img.sheet src=(image_uri("png", file)) alt=(format!("The picture of {}: expected, yours, and where they differ", task.key));
        @if !marks.is_empty() {
            ul.legend.soft {
                @for mark in marks {
                    @let [r, g, b] = mark.colour();
                    li { span.chip style=(format!("background:rgb({r},{g},{b})")) {} (mark.label()) }
                }
            }
        }
    }
}

fn case_card(case: &Case, hint: HintLevel) -> Markup {
    // Why simple formulas fail there is a hint of its own.
    let about = match hint {
        HintLevel::Cases => case.about.split(" Pitfall:").next().unwrap_or_default(),
        _ => &case.about,
    };
    let detail = case.detail.as_ref().map(Untrusted::line);
    html! {
        div.card {
            strong { (case.name) } " "
            span.bad { (points(case.score)) " of " (points(case.max_score)) }
            p { (about) }
            @if case.status == NOT_ATTEMPTED { p { "It reaches code that is not written yet." } }
            @if hint >= HintLevel::Findings {
                @if let Some(detail) = &detail { p { "Your code " (detail.trim_end_matches('.')) "." } }
                @for finding in case.findings.iter().filter(|finding| finding.wrong > 0) {
                    p {
                        (finding.aspect.label()) " wrong on " (finding.wrong) " of "
                        (judge::plural(finding.judged, "call", "calls")) "."
                        @if let Some(worst) = &finding.worst { " " code { (worst.message.line()) } }
                    }
                }
                (list(&case.reductions))
            }
        }
    }
}

/// The status of a task without written code, and of a case that reaches unwritten code.
const NOT_ATTEMPTED: &str = "not_attempted";

/// The sentence about the status of a task.
fn status(task: &Task, report: &StudentReport) -> &'static str {
    match task.status.as_str() {
        "passed" if task.score >= task.max_score => "Everything is right.",
        "not_attempted" if report.missing.contains(&task.stage) => "Its stage was not handed in.",
        "not_attempted" => "It is not written yet.",
        "does_not_compile" if report.refused_stages.contains_key(&task.stage) => {
            "Its stage was refused before it was compiled: the reasons are below."
        }
        "does_not_compile" => "Its stage does not compile: the messages about it are below.",
        "crashed" => "The code crashed.",
        "needs" => "It could not run, because it needs another stage.",
        _ if task.score >= task.max_score => {
            "Every core answer is right. Extra credit is left to earn."
        }
        _ if task.cases.iter().any(|case| case.status == NOT_ATTEMPTED) => {
            "Some cases reach code that is not written yet."
        }
        _ => "Some answers are wrong.",
    }
}

/// The start of a long text.
fn shortened(text: &Untrusted) -> String {
    let text = text.lines();
    match text.char_indices().nth(MAX_TEXT) {
        Some((end, _)) => format!("{}\n... and {} more bytes", &text[..end], text.len() - end),
        None => text.trim_end().to_string(),
    }
}
