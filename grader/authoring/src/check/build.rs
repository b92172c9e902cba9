//! Builds a handout and runs it as a student would.

use base::{GraderError, Workspace, child_processes};
use files::file_tree;
use grader::course::Course;
use handout::Handout;
use judge::Tier;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The project of a handout and its target directory. All handouts use the same folders, so that
/// cargo builds what they share only once.
struct StudentProject {
    folder: PathBuf,
    target: PathBuf,
    tests: Tests,
    /// Cargo's arguments that select the packages whose tests are run.
    packages: Vec<String>,
}

/// Which of a handout's tests to build and run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Tests {
    /// All tests.
    All,
    /// All tests except those of the crates below `grader/`. Those are the same in every handout
    /// and take longer to build than all others. The grader itself is still built and run.
    Stages,
}

/// Builds and runs the handout of `part` and returns a message for each problem.
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
    let project = StudentProject {
        folder: top.join("handout"),
        target: top.join("target"),
        tests,
        packages: tests.packages(handout),
    };
    file_tree::sync_folder(&project.folder, &handout.files)?;
    let mut problems = Vec::new();
    progress(&format!("{here}: building it"));
    let mut found = project.build()?;
    let builds = found.is_empty();
    problems.append(&mut found);
    let formatted = project.cargo(&["fmt", "--all", "--check"])?;
    if !formatted.status.success() {
        problems.push(format!(
            "`cargo fmt --check` fails: {}",
            first_lines(&formatted.stdout)
        ));
    }
    if builds {
        progress(&format!("{here}: running its tests"));
        let tested = project.cargo(&project.test(&["--quiet"]))?;
        if !tested.status.success() {
            problems.push(format!(
                "`cargo test` fails: {}",
                last_lines(&tested.stdout, &tested.stderr)
            ));
        }
        progress(&format!("{here}: grading it with its own grader"));
        problems.extend(project.grade(course, part)?);
    }
    Ok(problems
        .into_iter()
        .map(|problem| format!("{here}: {problem}"))
        .collect())
}

impl StudentProject {
    fn cargo(&self, arguments: &[&str]) -> Result<Output, GraderError> {
        let mut cargo = Command::new(child_processes::cargo());
        cargo
            .current_dir(&self.folder)
            .args(arguments)
            .env("CARGO_TARGET_DIR", &self.target)
            // The programs run only once, so the build time matters more than the run time.
            .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "1")
            .env("CARGO_PROFILE_RELEASE_DEBUG", "0")
            // Handouts differ only in a few files.
            .env("CARGO_INCREMENTAL", "1");
        child_processes::output(&mut cargo)
            .map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))
    }

    /// The arguments of `cargo test`, with `more` at the end.
    fn test<'a>(&'a self, more: &[&'a str]) -> Vec<&'a str> {
        let packages = self.packages.iter().map(String::as_str);
        let arguments = TEST.iter().copied().chain(packages);
        arguments.chain(more.iter().copied()).collect()
    }

    /// Builds programs and tests. Returns the compiler's warnings and errors.
    fn build(&self) -> Result<Vec<String>, GraderError> {
        let mut problems = self.warnings(&self.test(&["--no-run"]))?;
        if problems.is_empty() && self.tests == Tests::Stages {
            let of_grader = [
                "build",
                "--release",
                "--offline",
                "--locked",
                "--package",
                "grader",
            ];
            problems = self.warnings(&of_grader)?;
        }
        Ok(problems)
    }

    /// Runs a build with cargo and returns the compiler's warnings and errors.
    fn warnings(&self, build: &[&str]) -> Result<Vec<String>, GraderError> {
        let output = self.cargo(&[build, &["--message-format", "json"]].concat())?;
        let mut problems: Vec<String> = String::from_utf8_lossy(&output.stdout)
            .lines()
            .filter_map(warning)
            .collect();
        problems.dedup();
        if !output.status.success() && problems.is_empty() {
            problems.push(format!(
                "it does not build: {}",
                last_lines(&[], &output.stderr)
            ));
        }
        Ok(problems)
    }

    /// Grades the handout with its own grader: tasks to write must be *not attempted*, the others
    /// must have all points.
    fn grade(&self, course: &Course, part: u32) -> Result<Vec<String>, GraderError> {
        let output = self.cargo(&["grader", "all", "--format", "json", "--no-times"])?;
        let report: Value = match serde_json::from_slice(&output.stdout) {
            Ok(report) => report,
            Err(e) => {
                let output = last_lines(&output.stdout, &output.stderr);
                return Ok(vec![format!(
                    "`cargo grader all` prints no report ({e}): {output}"
                )]);
            }
        };
        let tasks: Vec<&Value> = report["tasks"].as_array().into_iter().flatten().collect();
        let mut problems = Vec::new();
        let of_all = course
            .parts
            .iter()
            .flat_map(|part| part.tasks.iter().map(|task| (part.number, task)));
        for (number, of_course) in of_all {
            let key = &of_course.key;
            let Some(task) = tasks.iter().find(|task| task["key"] == key.as_str()) else {
                problems.push(format!("its grader does not report {key}"));
                continue;
            };
            let carved = number >= part;
            // A handout has no examples of a student's.
            let full = task["score"] == task["max_score"]
                && task["robust_score"] == of_course.points_of_cases(Tier::Robust);
            let as_expected = if carved {
                task["status"] == "not_attempted"
                    && task["score"] == 0.0
                    && task["robust_score"] == 0.0
            } else {
                task["status"] == "passed" && full
            };
            if !as_expected {
                let expected = if carved {
                    "not attempted"
                } else {
                    "all points"
                };
                problems.push(format!(
                    "its grader reports {key} as {}, with {} of {} core points and {} of {} robust points; expected {expected}",
                    task["status"], task["score"], task["max_score"], task["robust_score"], task["robust_max_score"]
                ));
            }
        }
        Ok(problems)
    }
}

impl Tests {
    /// Cargo's arguments that select the packages whose tests are run.
    fn packages(self, handout: &Handout) -> Vec<String> {
        let mut arguments = vec!["--workspace".to_string()];
        if self == Tests::Stages {
            let manifests = handout.files.keys().filter(|path| {
                path.starts_with("grader")
                    && path.file_name().is_some_and(|name| name == "Cargo.toml")
            });
            // A package has the name of its folder.
            let names = manifests.filter_map(|path| path.parent()?.file_name()?.to_str());
            arguments.extend(names.flat_map(|name| ["--exclude".to_string(), name.to_string()]));
        }
        arguments
    }
}

/// The arguments of `cargo test`: offline, and with the versions of the lock file.
const TEST: &[&str] = &["test", "--release", "--offline", "--locked"];

/// The compiler's warning or error in one of cargo's JSON messages, if it has one.
fn warning(line: &str) -> Option<String> {
    let message: Value = serde_json::from_str(line).ok()?;
    let diagnostic = message.get("message")?;
    let span = diagnostic["spans"].as_array()?.first()?;
    Some(format!(
        "{} in {}:{}: {}",
        diagnostic["level"].as_str()?,
        Path::new(span["file_name"].as_str()?).display(),
        span["line_start"],
        diagnostic["message"].as_str()?
    ))
}

/// How many lines of a program's output a message quotes.
const QUOTED_LINES: usize = 12;

fn first_lines(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    text.lines()
        .take(QUOTED_LINES)
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
    let last = &lines[lines.len().saturating_sub(QUOTED_LINES)..];
    last.iter().flat_map(|line| ["\n  ", line]).collect()
}
