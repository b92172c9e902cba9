//! The command `grader solution part1.task3`: the reference beside your own code, once you have all
//! core points.
//!
//! A handout has no reference. A folder that `grader start` made knows the checkout beside it.

use super::picture::{TASK, task_argument, task_of};
use crate::book::checkout_of;
use crate::course::{Course, Task, sources};
use crate::progress::next_task;
use crate::report::wrap::columns;
use base::program::Exit;
use base::{GraderError, Workspace, out, outln};
use clap::{ArgMatches, Command};
use std::path::Path;

pub(super) fn command() -> Command {
    Command::new("solution")
        .about("Shows the course's code of a task beside yours, once you have all its core points")
        .arg(
            task_argument()
                .help("The task, such as `part1.task3` [default: the last complete one]"),
        )
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let Some(checkout) = checkout_of(&workspace) else {
        return Err(GraderError::new(
            "this folder has no reference to show: it was not made by `grader start`, or the course's checkout is \
             not where it was",
        ));
    };
    let known = next_task::known(&workspace, &course)?;
    let is_complete = |task: &&Task| {
        let mut complete = known.iter().filter(|known| known.is_complete());
        complete.any(|known| known.place.key == task.key)
    };
    let task = match matches.contains_id(TASK) {
        true => task_of(matches, &workspace, &course)?,
        false => course.tasks().filter(is_complete).last().ok_or_else(|| {
            GraderError::new("no task is complete yet, and a solution is shown only then")
        })?,
    };
    if !is_complete(&task) {
        return Err(GraderError::new(format!(
            "{0} is not complete yet: its last report must have all core points, for the present code. Run `cargo grader {0}`; `cargo grader hint {0}` names the likely mistake",
            task.key
        )));
    }
    let files = [&workspace, &checkout].map(|of| sources::read(of.root(), &task.stage));
    let [yours, reference] = files;
    let (yours, reference) = (yours?, reference?);
    for name in &task.holes {
        let [yours, theirs] = [&yours, &reference].map(|files| {
            let mut files = files.iter();
            let body = files.find_map(|file| sources::body(&file.text, name));
            body.map(without_markers).unwrap_or_default()
        });
        out!("{}\n", beside(&yours, &theirs, terminal_columns()));
    }
    let stage = checkout.root().join("stages").join(&task.stage);
    outln!(
        "First yours, then the course's. Its whole stage: {}",
        stage.display()
    );
    Ok(Exit::Passed)
}

/// The code without the comments at which handouts are cut.
fn without_markers(code: &str) -> String {
    const MARKERS: [&str; 3] = ["// BEGIN SOLUTION", "// STUB:", "// END SOLUTION"];
    let is_kept = |line: &&str| {
        let line = line.trim_start();
        !MARKERS.iter().any(|marker| line.starts_with(marker))
    };
    let lines = code.lines().filter(is_kept);
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// The columns of the terminal, of which code beside code needs many.
fn terminal_columns() -> usize {
    let columns = std::env::var("COLUMNS").ok();
    columns.and_then(|text| text.parse().ok()).unwrap_or(80)
}

/// Two pieces of code beside each other, or the second below the first where they do not fit.
fn beside(left: &str, right: &str, most: usize) -> String {
    let widest = |text: &str| text.lines().map(columns).max().unwrap_or(0);
    let width = widest(left);
    if width + 3 + widest(right) > most {
        return format!("{left}{}\n{right}", "-".repeat(8));
    }
    let mut lines = [left.lines(), right.lines()];
    let mut text = String::new();
    for _ in 0..left.lines().count().max(right.lines().count()) {
        let [left, right] = lines
            .each_mut()
            .map(|lines| lines.next().unwrap_or_default());
        let padding = " ".repeat(width - columns(left));
        let line = format!("{left}{padding} | {right}");
        text += line.trim_end();
        text += "\n";
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_is_beside_code_where_it_fits() {
        assert_eq!(beside("a\nbcd\n", "e\n", 7), "a   | e\nbcd |\n");
        assert_eq!(beside("a\nbcd\n", "e\n", 6), "a\nbcd\n--------\ne\n");
    }

    #[test]
    fn the_marks_of_solutions_are_not_shown() {
        let code = "fn f() {\n    // BEGIN SOLUTION(part1.task1)\n    1\n    // STUB: kit::hole!(\"part1.task1\")\n    // END SOLUTION(part1.task1)\n}";
        assert_eq!(without_markers(code), "fn f() {\n    1\n}\n");
    }
}
