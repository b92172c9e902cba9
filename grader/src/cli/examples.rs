//! The command `grader examples part1.task3`: judges examples that students write before their
//! code.

use crate::course::Course;
use crate::examples::{FILE, case_of, parse, read, review, sample};
use crate::report::table::number;
use base::program::Exit;
use base::{GraderError, Workspace, out, outln};
use clap::{Arg, ArgMatches, Command};
use judge::examples::why_not;
use std::path::Path;

pub(super) const NAME: &str = "examples";

/// Why examples are data is said here: a student who knows `#[test]` would look for them there.
const LONG: &str = "\
Judges your own examples of a task, which you write before your code: are they right, and what do they miss?

An example is an input and the result that you expect, in `stages/STAGE/examples.toml`. It is no Rust code, so that it \
can be judged before any code compiles: a `#[test]` says whether your code agrees with you, not whether you are right. \
For tests of your own there is `stages/STAGE/tests`, and `cargo test -p STAGE` runs them.

Where a course gives points for examples, the report of the task counts them.";

pub(super) fn command() -> Command {
    Command::new(NAME)
        .about("Judges your own examples of a task, which you write before your code: are they right, and what do they miss?")
        .long_about(LONG)
        .arg(
            Arg::new("task")
                .value_name("TASK")
                .required(true)
                .help("A task such as `part1.task3`; its examples are in `stages/STAGE/examples.toml`"),
        )
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let what: &String = matches.get_one("task").expect("clap requires it");
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let tasks = course.select(what)?;
    let [task] = tasks[..] else {
        return Err(GraderError::new(format!(
            "expected one task such as `part1.task3`, found `{what}`"
        )));
    };
    if let Some(why) = why_not(&task.key) {
        return Err(GraderError::new(format!(
            "examples of {} cannot be judged: {why}. Examples are for {}",
            task.key,
            judge::examples::TASKS.join(", ")
        )));
    }
    let file = format!("stages/{}/{FILE}", task.stage);
    let none = |why: &str| {
        GraderError::new(format!(
            "{why}. Write three to six examples into {file}, before your code, such as\n\n{}\nThen run this command again.",
            sample(&task.key)
        ))
    };
    let Some(text) = read(&workspace, task)? else {
        return Err(none(&format!("there is no {file} yet")));
    };
    let examples = parse(&text).map_err(|e| GraderError::new(format!("{file}: {e}")))?;
    let found = review(&task.key, &examples);
    let Some(found) = found.filter(|found| !found.verdicts.is_empty()) else {
        return Err(none(&format!("{file} has no examples of {}", task.key)));
    };
    out!("{}", found.text(&file, &task.key));
    if let Some(case) = case_of(task, Some(&text)) {
        outln!(
            "\npoints: {} of {}, once two thirds of the core points are yours",
            number(case.score),
            number(case.max_score)
        );
    }
    // Handouts have no mistakes to compare with.
    if workspace.root().join("grader/mutants").is_dir() {
        outln!(
            "\nHow many of the typical mistakes they catch: `cargo grader mutants {} --examples {file}`",
            task.key
        );
    }
    Ok(match found.is_right() {
        true => Exit::Passed,
        false => Exit::Failed,
    })
}
