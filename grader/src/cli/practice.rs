//! The command `grader practice`: what helps to learn a task and gives no points.

use super::picture::{task_argument, task_of};
use super::{asking, examples, gym, predict};
use crate::course::Course;
use crate::course::sources;
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
        return exercise(only, &task.key, matches);
    }
    let has_own = own::read(&workspace, task)?.is_some_and(|text| match own::parse(&text) {
        Ok(all) => own::review(&task.key, &all).is_some_and(|of| !of.verdicts.is_empty()),
        // The exercise says what is wrong in the file.
        Err(_) => true,
    });
    if has_own {
        exercise(examples::NAME, &task.key, matches)?;
        outln!();
    }
    let files = sources::read(workspace.root(), &task.stage)?;
    let is_open = sources::place(task, &files).has_hole;
    exercise(questions(is_open), &task.key, matches)
}

/// What is asked about a task: before it is written what to expect, after it what goes wrong.
fn questions(is_open: bool) -> &'static str {
    if is_open { predict::NAME } else { gym::NAME }
}

/// Runs an exercise as its own command does.
fn exercise(name: &str, task: &str, matches: &ArgMatches) -> Result<Exit, GraderError> {
    let (command, run) = own_command(name);
    let matches = command.try_get_matches_from(line_of(name, task, matches));
    run(&matches.map_err(|e| GraderError::new(e.to_string()))?)
}

/// The command line of an exercise: examples are not drawn at random.
fn line_of(name: &str, task: &str, matches: &ArgMatches) -> Vec<String> {
    let seed = matches
        .get_one::<u64>("seed")
        .filter(|_| name != examples::NAME)
        .map(|seed| format!("--seed={seed}"));
    [name.to_owned(), task.to_owned()]
        .into_iter()
        .chain(seed)
        .collect()
}

/// What runs a command.
type Run = fn(&ArgMatches) -> Result<Exit, GraderError>;

/// The command of an exercise and what runs it.
fn own_command(name: &str) -> (Command, Run) {
    match name {
        predict::NAME => (predict::command(), predict::run),
        gym::NAME => (gym::command(), gym::run),
        _ => (examples::command(), examples::run),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_exercise_is_the_command_of_its_name() {
        for name in EXERCISES {
            let (own, _) = own_command(name);
            assert_eq!(own.get_name(), name);
            let line = ["practice", "part1.task3", "--only", name, "--seed", "7"];
            let matches = command().try_get_matches_from(line).expect("it is read");
            let line = line_of(name, "part1.task3", &matches);
            assert!(own.try_get_matches_from(&line).is_ok(), "{line:?}");
            assert_eq!(
                line.contains(&"--seed=7".to_owned()),
                name != examples::NAME
            );
        }
        let other = ["practice", "part1.task3", "--only", "sleep"];
        assert!(command().try_get_matches_from(other).is_err());
    }

    #[test]
    fn a_task_that_is_not_written_yet_is_predicted() {
        assert_eq!(questions(true), predict::NAME);
        assert_eq!(questions(false), gym::NAME);
    }
}
