//! Builds a handout and runs it as a student would.

use crate::handout::Handout;
use grader::child_processes;
use grader::compile;
use grader::course::Course;
use grader::error::GraderError;
use grader::workspace::Workspace;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use submission::file_tree;

/// The student's project, and where cargo builds it: the same for every handout, so that what two of them share is
/// built once.
struct Desk {
    folder: PathBuf,
    target: PathBuf,
    tests: Tests,
}

/// Which of a handout's tests to build and run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Tests {
    /// All of them.
    All,
    /// Not those of the grader, which are the same in every handout and take longer to build than all the rest. It is
    /// still built, and grades.
    Stages,
}

/// What is wrong with the handout of `part` when it is built and run.
pub fn find(
    workspace: &Workspace,
    course: &Course,
    part: u32,
    handout: &Handout,
    tests: Tests,
    progress: &mut impl FnMut(&str),
) -> Result<Vec<String>, GraderError> {
    let here = format!("handout of part {part}");
    let top = workspace.root().join("target/course_check");
    let desk = Desk {
        folder: top.join("handout"),
        target: top.join("target"),
        tests,
    };
    file_tree::sync_folder(&desk.folder, &handout.files)?;
    let mut complaints = Vec::new();
    progress(&format!("{here}: building it, without a warning"));
    let mut found = desk.build()?;
    let builds = found.is_empty();
    complaints.append(&mut found);
    let formatted = desk.cargo(&["fmt", "--all", "--check"])?;
    if !formatted.status.success() {
        complaints.push(format!(
            "`cargo fmt --check` is not content: {}",
            first_lines(&formatted.stdout)
        ));
    }
    if builds {
        progress(&format!("{here}: running its tests"));
        let tested = desk.cargo(&[TEST, desk.tests.packages(), &["--quiet"]].concat())?;
        if !tested.status.success() {
            complaints.push(format!(
                "`cargo test` fails: {}",
                last_lines(&tested.stdout, &tested.stderr)
            ));
        }
        progress(&format!("{here}: grading it with its own grader"));
        complaints.extend(desk.grade(course, part)?);
    }
    Ok(complaints
        .into_iter()
        .map(|complaint| format!("{here}: {complaint}"))
        .collect())
}

impl Desk {
    fn cargo(&self, arguments: &[&str]) -> Result<Output, GraderError> {
        let mut cargo = Command::new(compile::cargo());
        cargo
            .current_dir(&self.folder)
            .args(arguments)
            .env("CARGO_TARGET_DIR", &self.target)
            // What is built here runs once: it need not be fast, it has to be built fast.
            .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "1")
            .env("CARGO_PROFILE_RELEASE_DEBUG", "0")
            // Handouts differ in little.
            .env("CARGO_INCREMENTAL", "1");
        child_processes::output(&mut cargo)
            .map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))
    }

    /// Builds programs and tests. The compiler's warnings and errors are complaints.
    fn build(&self) -> Result<Vec<String>, GraderError> {
        let of_tests = [TEST, self.tests.packages(), &["--no-run"]].concat();
        let mut complaints = self.warnings(&of_tests)?;
        if complaints.is_empty() && self.tests == Tests::Stages {
            let of_grader = [
                "build",
                "--release",
                "--offline",
                "--locked",
                "--package",
                "grader",
            ];
            complaints = self.warnings(&of_grader)?;
        }
        Ok(complaints)
    }

    /// What the compiler says against the code when cargo builds something.
    fn warnings(&self, build: &[&str]) -> Result<Vec<String>, GraderError> {
        let output = self.cargo(&[build, &["--message-format", "json"]].concat())?;
        let mut complaints: Vec<String> = String::from_utf8_lossy(&output.stdout)
            .lines()
            .filter_map(warning)
            .collect();
        complaints.dedup();
        if !output.status.success() && complaints.is_empty() {
            complaints.push(format!(
                "it does not build: {}",
                last_lines(&[], &output.stderr)
            ));
        }
        Ok(complaints)
    }

    /// Grades with the handout's own grader: carved tasks are not attempted, kept ones full.
    fn grade(&self, course: &Course, part: u32) -> Result<Vec<String>, GraderError> {
        let output = self.cargo(&["grader", "all", "--format", "json", "--no-times"])?;
        let report: Value = match serde_json::from_slice(&output.stdout) {
            Ok(report) => report,
            Err(e) => {
                let said = last_lines(&output.stdout, &output.stderr);
                return Ok(vec![format!(
                    "`cargo grader all` gives no report ({e}): {said}"
                )]);
            }
        };
        let tasks: Vec<&Value> = report["tasks"].as_array().into_iter().flatten().collect();
        let mut complaints = Vec::new();
        for (number, key) in course
            .parts
            .iter()
            .flat_map(|p| p.tasks.iter().map(|task| (p.number, &task.key)))
        {
            let Some(task) = tasks.iter().find(|task| task["key"] == key.as_str()) else {
                complaints.push(format!("its grader says nothing of {key}"));
                continue;
            };
            let carved = number >= part;
            let full = task["score"] == task["max_score"]
                && task["robust_score"] == task["robust_max_score"];
            let right = if carved {
                task["status"] == "not_attempted"
                    && task["score"] == 0.0
                    && task["robust_score"] == 0.0
            } else {
                task["status"] == "passed" && full
            };
            if !right {
                let wanted = if carved {
                    "not attempted"
                } else {
                    "full marks"
                };
                complaints.push(format!(
                    "its grader gives {key} the status {}, {} of {} and {} of {} robust points; right is {wanted}",
                    task["status"], task["score"], task["max_score"], task["robust_score"], task["robust_max_score"]
                ));
            }
        }
        Ok(complaints)
    }
}

impl Tests {
    /// Says to cargo whose tests these are.
    fn packages(self) -> &'static [&'static str] {
        match self {
            Tests::All => &["--workspace"],
            Tests::Stages => &["--workspace", "--exclude", "grader"],
        }
    }
}

/// Tells cargo to test what is there, with nothing but what is there.
const TEST: &[&str] = &["test", "--release", "--offline", "--locked"];

/// What the compiler complains of in one of cargo's JSON messages.
fn warning(line: &str) -> Option<String> {
    let message: Value = serde_json::from_str(line).ok()?;
    let diagnostic = message.get("message")?;
    let place = diagnostic["spans"].as_array()?.first()?;
    Some(format!(
        "{} in {}:{}: {}",
        diagnostic["level"].as_str()?,
        Path::new(place["file_name"].as_str()?).display(),
        place["line_start"],
        diagnostic["message"].as_str()?
    ))
}

/// How many lines of a program's output a complaint quotes.
const QUOTED: usize = 12;

fn first_lines(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    text.lines()
        .take(QUOTED)
        .flat_map(|line| ["\n  ", line])
        .collect()
}

fn last_lines(stdout: &[u8], stderr: &[u8]) -> String {
    let text = [
        String::from_utf8_lossy(stdout),
        String::from_utf8_lossy(stderr),
    ]
    .concat();
    let lines: Vec<&str> = text.lines().collect();
    let last = &lines[lines.len().saturating_sub(QUOTED)..];
    last.iter().flat_map(|line| ["\n  ", line]).collect()
}
