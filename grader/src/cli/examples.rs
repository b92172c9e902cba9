//! The command `grader examples part1.task3`: judges examples that students write before their
//! code.

use crate::course::Course;
use crate::examples::{parse, review, sample};
use base::program::Exit;
use base::{GraderError, Workspace, out, outln};
use clap::{Arg, ArgMatches, Command};
use judge::examples::situations_of;
use std::path::Path;

pub(super) const NAME: &str = "examples";

pub(super) fn command() -> Command {
    Command::new(NAME)
        .about("Judges your own examples of a task, which you write before your code: are they right, and what do they miss?")
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
    if situations_of(&task.key).is_none() {
        return Err(GraderError::new(format!(
            "examples of {} cannot be judged: a single call has no single right result, or a handout cannot tell the right one without the formula that you write. Examples are for {}",
            task.key,
            judge::examples::TASKS.join(", ")
        )));
    }
    let file = format!("stages/{}/examples.toml", task.stage);
    let path = workspace.root().join(&file);
    let none = |why: &str| {
        GraderError::new(format!(
            "{why}. Write three to six examples into {file}, before your code, such as\n\n{}\nThen run `cargo grader examples {}` again.",
            sample(&task.key),
            task.key
        ))
    };
    if !path.exists() {
        return Err(none(&format!("there is no {file} yet")));
    }
    let text = std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
    let examples = parse(&text).map_err(|e| GraderError::new(format!("{file}: {e}")))?;
    let found = review(&task.key, &examples);
    let Some(found) = found.filter(|found| !found.verdicts.is_empty()) else {
        return Err(none(&format!("{file} has no examples of {}", task.key)));
    };
    out!("{}", found.text(&file, &task.key));
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
