//! `grader check`: what the compiler and the grader find, in the form in which editors read it.
//!
//! The command first checks the stages with cargo, whose messages are passed on unchanged
//! ([`cargo_check`]), then grades the tasks whose code changed ([`again`]; [`stored`] has the
//! findings of the others), and prints for each function that is to blame ([`blame`]) what is wrong
//! ([`finding`]) as a message of rustc's form ([`rustc_message`]) at the student's function, or at
//! the line that a hint is certainly about ([`meant_line`]).

pub mod again;
pub mod blame;
pub mod cargo_check;
pub mod finding;
pub mod meant_line;
pub mod rustc_message;
pub mod stored;

use crate::course::Task;
use crate::course::chapter::{Section, chapter, section};
use crate::course::sources::{self, SourceFile};
use crate::report::HintLevel;
use finding::Finding;
use rustc_message::{Diagnostic, Level, Mark};

/// The messages about one task: a hint for each function that is not written yet, and a warning for
/// each function that is wrong. `files` are those of the task's stage.
pub fn messages(
    task: &Task,
    files: &[SourceFile],
    findings: &[Finding],
    hint: HintLevel,
    colours: bool,
) -> Vec<Diagnostic> {
    let open = sources::place(task, files).open;
    let gaps = open
        .iter()
        .filter_map(|name| gap(task, files, name, colours));
    let findings = findings.iter();
    let wrong = findings.filter_map(|finding| warning(task, files, finding, hint, colours));
    gaps.chain(wrong).collect()
}

/// The hint at a function that is not written yet.
fn gap(task: &Task, files: &[SourceFile], name: &str, colours: bool) -> Option<Diagnostic> {
    let mut message = format!("not written yet: {} {}", task.key, task.title);
    if let Some(chapter) = chapter(&task.key) {
        message.push_str(&format!(", chapter {chapter}"));
    }
    let mark = mark_of_function(files, name)?;
    let message = Diagnostic::new(Level::Help, &task.key, &message, mark, &[], colours);
    Some(message)
}

/// The warning about what is wrong in a function: where its code panicked, at the line that the
/// hint means, or else at the name of the function.
fn warning(
    task: &Task,
    files: &[SourceFile],
    finding: &Finding,
    hint: HintLevel,
    colours: bool,
) -> Option<Diagnostic> {
    let first = task.holes.first().map(String::as_str);
    let function = finding.function.as_deref().or(first)?;
    let panicked = finding.panicked_at().and_then(|(path, line)| {
        let file = files.iter().find(|file| file.path == path)?;
        Some(Mark::line(&file.path, &file.text, line))
    });
    let meant = || meant(files, function, &finding.clue(hint)?);
    let mark = panicked
        .filter(|_| hint > HintLevel::Cases)
        .or_else(meant)
        .or_else(|| mark_of_function(files, function))?;
    let notes = finding.notes(hint).into_iter();
    let mut children: Vec<(Level, String)> = notes.map(|note| (Level::Note, note)).collect();
    let advice = finding.advice(hint).into_iter();
    children.extend(advice.map(|advice| (Level::Help, advice)));
    if hint >= HintLevel::Remedy
        && let Some(place) = section(&task.key, Section::Mistakes)
    {
        children.push((Level::Help, format!("more in the book: {place}")));
    }
    let title = finding.title(hint);
    let warning = Level::Warning;
    Some(Diagnostic::new(
        warning, &task.key, &title, mark, &children, colours,
    ))
}

/// The line of `function` that a clue is about, if one stands out.
fn meant<'a>(files: &'a [SourceFile], function: &str, clue: &str) -> Option<Mark<'a>> {
    let file = defining(files, function)?;
    let body = sources::body(&file.text, function)?;
    let line = meant_line::of(body, clue)?;
    let first = sources::line_of_function(&file.text, function)?;
    Some(Mark::line(&file.path, &file.text, first + line))
}

/// The name of a function where it is defined.
fn mark_of_function<'a>(files: &'a [SourceFile], name: &str) -> Option<Mark<'a>> {
    let file = defining(files, name)?;
    let body = sources::body(&file.text, name)?;
    let start = body.as_ptr() as usize - file.text.as_ptr() as usize + "pub fn ".len();
    Some(Mark {
        path: &file.path,
        text: &file.text,
        start,
        end: start + name.len(),
    })
}

fn defining<'a>(files: &'a [SourceFile], name: &str) -> Option<&'a SourceFile> {
    files
        .iter()
        .find(|file| sources::defines_function(&file.text, name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::Course;
    use crate::grade::one_by_one::Graded;
    use crate::report::TaskReport;
    use crate::score::{CaseResult, Status, TaskResult};
    use crate::workers::crash::{Crash, CrashKind};
    use judge::Tier;

    const TEXT: &str = "//! Triangles.\n\npub fn test_triangle(t: f64) -> bool {\n    let near = t < min_t;\n    near\n}\n\npub fn record_triangle(t: f64) -> f64 {\n    kit::hole!(\"part1.task3\", t)\n}\n";

    fn task() -> Task {
        let course =
            Course::parse(include_str!("../../../stages/course.toml")).expect("it is valid");
        let mut tasks = course.tasks().filter(|task| task.key == "part1.task3");
        tasks.next().expect("the course has triangles").clone()
    }

    fn files() -> [SourceFile; 1] {
        [SourceFile {
            path: "stages/intersect/src/triangle.rs".into(),
            text: TEXT.into(),
        }]
    }

    fn findings(status: Status) -> Vec<Finding> {
        let task = task();
        let mut case = CaseResult::failed("front_face", Vec::new());
        case.status = status;
        let mut result = TaskResult::new(&task, Vec::new());
        result.cases = vec![case];
        let mut report = TaskReport::from(result);
        report.diagnosis = Some(crate::diagnosis::Diagnosis {
            mistakes: vec!["near".into()],
            says: "your answers equal those of code that tests the wrong end".into(),
            description: String::new(),
            hint: "Which hits are too near is decided by min_t alone.".into(),
            equal: 3,
            of: 3,
            certainty: crate::diagnosis::Certainty::Likely,
            ..Default::default()
        });
        let graded = Graded::for_tests(report);
        Finding::all(&graded, &task, &files(), false).expect("nothing is asked more")
    }

    fn shown(status: Status, hint: HintLevel) -> Vec<Diagnostic> {
        messages(&task(), &files(), &findings(status), hint, false)
    }

    #[test]
    fn a_gap_is_a_hint_at_its_function() {
        let gaps = messages(&task(), &files(), &[], HintLevel::Findings, false);
        let [gap] = gaps.as_slice() else {
            panic!("{gaps:?}")
        };
        assert_eq!((gap.level, gap.spans[0].line_start), (Level::Help, 8));
        let expected = "not written yet: part1.task3 Intersecting triangles, chapter stages/book/src/part1/task3.md";
        assert_eq!(gap.message, expected);
    }

    #[test]
    fn the_hint_level_decides_what_is_said_and_where() {
        let texts = |hint| {
            let messages = shown(Status::Failed, hint);
            let warning = messages.last().expect("a warning").clone();
            let children: Vec<String> =
                warning.children.iter().map(|c| c.message.clone()).collect();
            (
                warning.spans[0].line_start,
                warning.message,
                children.join("\n"),
            )
        };
        let (line, title, notes) = texts(HintLevel::Findings);
        assert_eq!((line, title.as_str()), (3, "front_face fails"));
        assert!(!notes.contains("likely"), "{notes}");
        let (line, _, notes) = texts(HintLevel::Mistake);
        assert!(
            line == 3 && notes.contains("likely: your answers equal"),
            "{notes}"
        );
        let (line, _, notes) = texts(HintLevel::Remedy);
        assert!(
            line == 4 && notes.contains("decided by min_t alone"),
            "{line} {notes}"
        );
    }

    /// It ends the task, so that cases of core points are not run: it is told, and as what it is.
    #[test]
    fn a_loop_that_only_extra_credit_meets_is_told_as_that() {
        let task = task();
        let title = |tier: Tier| {
            let case = CaseResult {
                tier,
                status: Status::Crashed(Crash {
                    kind: CrashKind::Endless,
                    ..Crash::from("did not return")
                }),
                ..CaseResult::failed("far_away", Vec::new())
            };
            let mut result = TaskResult::new(&task, Vec::new());
            result.cases = vec![case];
            let graded = Graded::for_tests(TaskReport::from(result));
            let found = Finding::all(&graded, &task, &files(), false).expect("it is graded");
            found[0].title(HintLevel::Findings)
        };
        let core = "far_away: a call does not end: it did not return";
        assert_eq!(title(Tier::Core), core);
        let extra = "far_away (extra credit): a call does not end: it did not return";
        assert_eq!(title(Tier::Robust), extra);
    }

    #[test]
    fn a_panic_is_shown_at_its_line() {
        let ended = Crash {
            call: Some(2),
            panicked_at: Some(("stages/intersect/src/triangle.rs".into(), 5)),
            ..Crash::from("panicked at stages/intersect/src/triangle.rs:5: no")
        };
        let messages = shown(Status::Crashed(ended), HintLevel::Findings);
        let warning = messages.last().expect("a warning");
        assert_eq!(
            (warning.level, warning.spans[0].line_start),
            (Level::Warning, 5)
        );
        assert!(
            warning.message.contains("front_face panicked at"),
            "{}",
            warning.message
        );
    }
}
