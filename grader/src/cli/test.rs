//! The command `grader test`: runs the worked examples of a part.
//!
//! `cargo test` cannot end with this summary. Each stage is a test program of its own, none of them
//! knows the others, and cargo ends at the first that fails. The programs run here are those that
//! `cargo test` builds, so nothing is built twice.

use crate::build::{WORKED_EXAMPLE, build_worked_example};
use crate::course::{Course, Task};
use crate::progress::next_task::{self, Known};
use crate::report::wrap::columns;
use base::program::Exit;
use base::{GraderError, Workspace, child_processes, out, outln};
use clap::{Arg, ArgMatches, Command};
use judge::plural;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

pub(super) fn command() -> Command {
    Command::new("test")
        .about("Runs the worked examples of a part, as tests: the first to make pass")
        .arg(Arg::new("what").value_name("PART").help(
            "A part such as `part1`, a task, or `all` [default: the part of the next open task]",
        ))
}

/// What became of the worked example of a task.
#[derive(Clone, Debug, PartialEq, Eq)]
enum ExampleState {
    Open,
    Passes,
    DoesNotCompile,
    /// It fails, and the test program printed this.
    Fails(String),
}

impl ExampleState {
    fn words(&self) -> &'static str {
        match self {
            ExampleState::Open => "not written yet",
            ExampleState::Passes => "passes",
            ExampleState::DoesNotCompile => "does not compile",
            ExampleState::Fails(_) => "fails",
        }
    }
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let known = next_task::known(&workspace, &course)?;
    let tasks = match matches.get_one::<String>("what") {
        Some(what) => course.select(what)?,
        None => course.select(next_task::or_last(&workspace, &course)?.part_key())?,
    };
    let mut programs = BTreeMap::new();
    let mut results = Vec::new();
    for task in tasks {
        let is_open = |it: &Known| it.place.key == task.key && it.place.has_hole;
        let state = match known.iter().any(is_open) {
            true => ExampleState::Open,
            false => state_of(task, workspace.root(), &mut programs)?,
        };
        results.push((task, state));
    }
    out!("{}", format_results(&course, &results));
    let next = results.iter().find(|(_, it)| *it != ExampleState::Passes);
    if let Some((task, _)) = next {
        outln!("Next: {}; run `cargo grader {0}`", task.key);
    }
    let is_wrong =
        |outcome: &ExampleState| !matches!(outcome, ExampleState::Open | ExampleState::Passes);
    Ok(match results.iter().any(|(_, it)| is_wrong(it)) {
        true => Exit::Failed,
        false => Exit::Passed,
    })
}

/// Runs the worked example of a task that is written. `programs` are the test programs of the
/// stages that are built; `None` for those that do not compile.
fn state_of<'a>(
    task: &'a Task,
    root: &Path,
    programs: &mut BTreeMap<&'a str, Option<PathBuf>>,
) -> Result<ExampleState, GraderError> {
    let program = match programs.get(task.stage.as_str()) {
        Some(program) => program.clone(),
        None => build_worked_example(root, &task.stage)?,
    };
    programs.insert(&task.stage, program.clone());
    let Some(program) = program else {
        return Ok(ExampleState::DoesNotCompile);
    };
    let run = |option: &str| {
        let mut command = std::process::Command::new(&program);
        let stage = root.join("stages").join(&task.stage);
        command
            .current_dir(stage)
            .args([&task.key.replace('.', "_"), option]);
        let output = child_processes::output(&mut command);
        output.map_err(|e| GraderError::file("run", &program, e))
    };
    // Without a test of this name nothing would fail.
    if run("--list")?.stdout.starts_with(b"0 tests") {
        let file = format!("stages/{}/tests/{WORKED_EXAMPLE}.rs", task.stage);
        return Ok(ExampleState::Fails(format!(
            "{file} has no test of {}\n",
            task.key
        )));
    }
    let output = run("--quiet")?;
    Ok(match output.status.success() {
        true => ExampleState::Passes,
        false => ExampleState::Fails(
            [output.stdout, output.stderr]
                .map(|printed| String::from_utf8_lossy(&printed).into_owned())
                .concat(),
        ),
    })
}

/// What the tests printed that fail, a line for each task, and one for each part.
fn format_results(course: &Course, results: &[(&Task, ExampleState)]) -> String {
    let mut text = String::new();
    for (_, outcome) in results {
        if let ExampleState::Fails(printed) = outcome {
            text.push_str(printed);
        }
    }
    let widest = results.iter().map(|(task, _)| columns(&task.title)).max();
    for (task, outcome) in results {
        let padding = " ".repeat(widest.unwrap_or(0) - columns(&task.title));
        let words = outcome.words();
        text += &format!("{}  {}{padding}  {words}\n", task.key, task.title);
    }
    for part in &course.parts {
        let is_of_part = |key: &str| part.tasks.iter().any(|task| task.key == key);
        let of_part = || results.iter().filter(|(task, _)| is_of_part(&task.key));
        let passing = of_part()
            .filter(|(_, it)| *it == ExampleState::Passes)
            .count();
        if of_part().count() > 0 {
            text += &format!(
                "Part {}: {passing} of {}\n",
                part.number,
                plural(
                    of_part().count(),
                    "worked example passes",
                    "worked examples pass"
                )
            );
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::of_this_checkout;

    #[test]
    fn the_last_line_counts_the_examples_that_pass() {
        let (_, course) = of_this_checkout();
        let outcomes = [
            ExampleState::Passes,
            ExampleState::Fails("t = 3\n".into()),
            ExampleState::Open,
            ExampleState::DoesNotCompile,
        ];
        let results: Vec<_> = course.tasks().zip(outcomes).collect();
        let text = format_results(&course, &results);
        assert!(text.starts_with("t = 3\n"), "{text}");
        assert!(text.contains("  fails\n"), "{text}");
        assert!(
            text.ends_with("Part 1: 1 of 4 worked examples pass\n"),
            "{text}"
        );
        let text = format_results(&course, &results[..1]);
        assert!(text.ends_with("1 of 1 worked example passes\n"), "{text}");
    }
}
