//! The command `grader practice`: what helps to learn a task and gives no points.

use super::picture::{task_argument, task_of};
use super::{asking, examples, gym, predict};
use crate::course::sources;
use crate::course::{Course, Task};
use crate::examples as own;
use base::program::Exit;
use base::{GraderError, Workspace, outln};
use clap::{Arg, ArgMatches, Command};
use std::path::Path;

/// The exercises: each is also a command of its own, an older word.
const EXERCISES: [&str; 3] = [predict::NAME, gym::NAME, examples::NAME];

pub(super) fn command() -> Command {
    Command::new("practice")
        .about("Asks about a task: what you expect before you write it, then which mistakes you recognize; judges your own examples")
        .arg(task_argument())
        .arg(
            Arg::new("only")
                .long("only")
                .value_name("EXERCISE")
                .value_parser(EXERCISES)
                .help("`predict`: the chapter's questions; `gym`: mistakes to recognize by what they do; `examples`: are your own examples right, and what do they miss?"),
        )
        .arg(asking::seed_argument().help("Repeat the numbers of a seed [default: others each time]"))
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let task = task_of(matches, &workspace, &course)?;
    if let Some(only) = matches.get_one::<String>("only") {
        return exercise(only, task, matches);
    }
    let has_own = own::read(&workspace, task)?.is_some_and(|text| match own::parse(&text) {
        Ok(all) => own::review(&task.key, &all).is_some_and(|of| !of.verdicts.is_empty()),
        // The exercise says what is wrong in the file.
        Err(_) => true,
    });
    if has_own {
        exercise(examples::NAME, task, matches)?;
        outln!();
    }
    let files = sources::read(workspace.root(), &task.stage)?;
    exercise(
        match sources::place(task, &files).has_hole {
            true => predict::NAME,
            false => gym::NAME,
        },
        task,
        matches,
    )
}

/// Runs an exercise as its own command does.
fn exercise(name: &str, task: &Task, matches: &ArgMatches) -> Result<Exit, GraderError> {
    let seed = matches
        .get_one::<u64>("seed")
        .filter(|_| name != examples::NAME)
        .map(|seed| format!("--seed={seed}"));
    let line = [name.to_owned(), task.key.clone()].into_iter().chain(seed);
    let read = |command: Command| {
        let matches = command.try_get_matches_from(line);
        matches.map_err(|e| GraderError::new(e.to_string()))
    };
    match name {
        predict::NAME => predict::run(&read(predict::command())?),
        gym::NAME => gym::run(&read(gym::command())?),
        _ => examples::run(&read(examples::command())?),
    }
}
