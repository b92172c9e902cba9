//! Remarks about lines of the student's code: the compiler's errors, panics, functions that are
//! wrong or not written yet.

use crate::text::printable;
use grader::build::compile_errors::plain;
use grader::course::sources::{SourceFile, holes, line_of_function};
use grader::report::{Report, Reveal, TaskReport, table};
use grader::score::functions::FunctionStatus;
use grader::score::{Status, TaskResult};
use grader::workers::crash;

/// A remark about a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Annotation {
    /// The file, below the root folder of the workspace, with `/` between its parts.
    pub file: String,
    /// The line, from 1 on.
    pub line: usize,
    /// How serious it is.
    pub level: Level,
    /// A few words.
    pub title: String,
    /// The text, in lines.
    pub message: String,
}

/// How serious a remark is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// It cost core points.
    Error,
    /// It is not written yet.
    Notice,
}

/// GitHub shows at most 10 errors and 10 notices of a step.
const MOST: usize = 10;

/// The most lines of the report in a remark. The report has the others.
const LINES: usize = 24;

/// The remarks about a report. `compiler` has the compiler's messages, `sources` the files that
/// were graded.
pub fn all(
    report: &Report,
    compiler: &str,
    sources: &[SourceFile],
    reveal: Reveal,
) -> Vec<Annotation> {
    let mut remarks = of_compiler(compiler, sources);
    for task in &report.tasks {
        remarks.extend(of_task(task, sources, reveal));
    }
    let mut kept: Vec<Annotation> = Vec::new();
    for remark in remarks {
        let of_level = kept.iter().filter(|other| other.level == remark.level);
        if of_level.count() < MOST && !kept.contains(&remark) {
            kept.push(remark);
        }
    }
    kept
}

/// The compiler's errors: `error[E0308]: mismatched types`, then `  --> stages/a/src/b.rs:3:9`.
fn of_compiler(messages: &str, sources: &[SourceFile]) -> Vec<Annotation> {
    let mut remarks: Vec<Annotation> = Vec::new();
    let mut title: Option<String> = None;
    let messages = plain(messages);
    for line in messages.lines() {
        if line.starts_with("error") {
            title = Some(line.to_owned());
        } else if line.starts_with("warning") {
            title = None;
        }
        let arrow = line.trim_start().strip_prefix("--> ");
        let place = arrow.and_then(|place| crash::place(place.trim()));
        let Some((file, line)) = place.and_then(|place| located(&place, sources)) else {
            continue;
        };
        // The first place of an error is where it is; others belong to its notes.
        if let Some(message) = title.take() {
            remarks.push(Annotation {
                file,
                line,
                level: Level::Error,
                title: "does not compile".into(),
                message,
            });
        }
    }
    remarks
}

/// A file and a line, if the file is one of `sources`.
fn located(place: &(String, usize), sources: &[SourceFile]) -> Option<(String, usize)> {
    let path = place.0.replace('\\', "/");
    let file = sources.iter().find(|file| path.ends_with(&file.path))?;
    Some((file.path.clone(), place.1))
}

fn of_task(task: &TaskReport, sources: &[SourceFile], reveal: Reveal) -> Vec<Annotation> {
    let result = &task.result;
    if result.score >= result.max_score || result.status == Status::DoesNotCompile {
        return Vec::new();
    }
    let mut remarks = of_panics(result, sources);
    remarks.extend(of_holes(result, sources));
    let wrong = result
        .functions
        .iter()
        .filter_map(|function| match function.status {
            FunctionStatus::Wrong { of, wrong } => Some((&function.name, of, wrong)),
            _ => None,
        });
    let text = about(task, reveal);
    remarks.extend(wrong.filter_map(|(name, of, wrong)| {
        let (file, line) = function(name, &result.stage, sources)?;
        Some(Annotation {
            file,
            line,
            level: Level::Error,
            title: format!("{}: {name} is wrong in {wrong} of {of} cases", result.key),
            message: text.clone(),
        })
    }));
    remarks
}

/// What the report says about the task, in few lines. The worst answer as a test would take most of
/// them, and is in the report.
fn about(task: &TaskReport, reveal: Reveal) -> String {
    let short = TaskReport {
        worst_as_test: None,
        ..task.clone()
    };
    let text = printable(&table::task_text(&short, reveal));
    let lines: Vec<&str> = text.trim().lines().collect();
    match lines.len() > LINES {
        true => format!("{}\n... (the report has more)", lines[..LINES].join("\n")),
        false => lines.join("\n"),
    }
}

/// The lines at which cases panicked, each once.
fn of_panics(task: &TaskResult, sources: &[SourceFile]) -> Vec<Annotation> {
    let mut remarks: Vec<Annotation> = Vec::new();
    for case in &task.cases {
        let Status::Crashed(ended) = &case.status else {
            continue;
        };
        let place = ended.panicked_at.as_ref();
        let Some((file, line)) = place.and_then(|place| located(place, sources)) else {
            continue;
        };
        if remarks
            .iter()
            .any(|other| (&other.file, other.line) == (&file, line))
        {
            continue;
        }
        remarks.push(Annotation {
            file,
            line,
            level: Level::Error,
            title: format!("{}: panics", task.key),
            message: format!("{}: {ended}", case.name),
        });
    }
    remarks
}

fn of_holes(task: &TaskResult, sources: &[SourceFile]) -> Vec<Annotation> {
    let of_stage = of_stage(&task.stage, sources);
    let remarks = of_stage.flat_map(|file| {
        let before = holes(&file.text, &task.key);
        before.map(|before| Annotation {
            file: file.path.clone(),
            line: before.trim_end().lines().count(),
            level: Level::Notice,
            title: format!("{}: not written yet", task.key),
            message: task.title.clone(),
        })
    });
    remarks.collect()
}

/// Where the function `name` of `stage` begins.
fn function(name: &str, stage: &str, sources: &[SourceFile]) -> Option<(String, usize)> {
    let mut files = of_stage(stage, sources);
    files.find_map(|file| Some((file.path.clone(), line_of_function(&file.text, name)?)))
}

fn of_stage<'a>(stage: &str, sources: &'a [SourceFile]) -> impl Iterator<Item = &'a SourceFile> {
    let folder = format!("stages/{stage}/");
    sources
        .iter()
        .filter(move |file| file.path.starts_with(&folder))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sources() -> Vec<SourceFile> {
        let text = "//! Map.\n\npub fn intersect_triangle(a: u8) -> u8 {\n    kit::hole!(\n        \"part1.task3\",\n        a\n    )\n}\n";
        vec![SourceFile {
            path: "stages/intersect/src/triangle.rs".into(),
            text: text.into(),
        }]
    }

    #[test]
    fn an_error_of_the_compiler_is_at_its_first_place() {
        let text = "warning: unused\n --> stages/intersect/src/triangle.rs:1:1\n\n\x1b[1merror[E0308]\x1b[0m: mismatched types\n   --> stages/intersect/src/triangle.rs:3:9\n   |\nnote: defined here\n  --> stages/intersect/src/triangle.rs:1:5\nerror: could not compile\n";
        let remarks = of_compiler(text, &sources());
        assert_eq!(remarks.len(), 1, "{remarks:?}");
        assert_eq!(remarks[0].line, 3);
        assert_eq!(remarks[0].message, "error[E0308]: mismatched types");
    }

    #[test]
    fn a_place_outside_the_students_code_is_no_place() {
        let text = "error: no\n --> grader/worker/src/lib.rs:7:1\n";
        assert_eq!(of_compiler(text, &sources()), []);
    }

    #[test]
    fn a_hole_is_at_its_macro_and_a_function_at_its_first_line() {
        let task = TaskResult {
            key: "part1.task3".into(),
            title: "Triangles".into(),
            score: 0.0,
            max_score: 3.0,
            robust_score: 0.0,
            robust_max_score: 0.0,
            status: Status::NotAttempted,
            stage: "intersect".into(),
            functions: Vec::new(),
            cases: Vec::new(),
        };
        let remarks = of_holes(&task, &sources());
        assert_eq!((remarks[0].line, remarks[0].level), (4, Level::Notice));
        let place = function("intersect_triangle", "intersect", &sources());
        assert_eq!(place, Some(("stages/intersect/src/triangle.rs".into(), 3)));
        assert_eq!(function("intersect_triangle", "bvh", &sources()), None);
    }
}
