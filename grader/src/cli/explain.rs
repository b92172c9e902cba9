//! The command `grader explain part1.task3/back_face`: what a case tests, drawn.

use super::case::{find, golden};
use super::{seed_argument, seed_of};
use crate::course::Course;
use crate::explain;
use crate::grade;
use crate::report::terminal::Page;
use base::program::Exit;
use base::{GraderError, Workspace, out};
use clap::{Arg, ArgMatches, Command};
use std::path::Path;

pub(super) fn command() -> Command {
    Command::new("explain")
        .about("Shows what a case tests, with a drawing of its inputs; lists the cases of a task")
        .arg(
            Arg::new("case")
                .value_name("TASK[/CASE]")
                .required(true)
                .help(
                    "A task such as `part1.task3`, or a case of it such as `part1.task3/back_face`",
                ),
        )
        .arg(seed_argument())
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let what: &String = matches.get_one("case").expect("clap requires it");
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let seed = seed_of(matches);
    let page = Page::of_stdout();
    match what.split_once('/') {
        None => {
            let tasks = course.select(what)?;
            let specs = grade::specs(&tasks, seed)?;
            for task in tasks {
                out!("{}", explain::task(task, &specs, page));
            }
        }
        Some((key, name)) => {
            let (task, entry) = find(&course, key, name)?;
            let specs = grade::specs(&[task], seed)?;
            let spec = specs
                .iter()
                .find(|spec| spec.is(&task.key, name))
                .ok_or_else(|| {
                    GraderError::new(format!(
                        "course.toml lists {what}, which the grader does not have"
                    ))
                })?;
            let golden = golden(&workspace, spec, seed);
            out!("{}", explain::case(entry, spec, golden.as_ref(), page));
        }
    }
    Ok(Exit::Passed)
}
