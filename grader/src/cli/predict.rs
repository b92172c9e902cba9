//! The command `grader predict part1.task3`: asks what the student expects.

use crate::course::Course;
use crate::predict::session::Session;
use crate::predict::store::{Predictions, Round};
use crate::predict::{questions, worked_examples};
use crate::progress::next_task;
use crate::report::terminal::Page;
use base::program::Exit;
use base::program::whole_number;
use base::{GraderError, Workspace, out, outln};
use clap::{Arg, ArgMatches, Command};
use std::hash::{BuildHasher, RandomState};
use std::io::{BufRead, IsTerminal, stdin};
use std::path::Path;

/// The name of the command.
pub(super) const NAME: &str = "predict";

pub(super) fn command() -> Command {
    Command::new(NAME)
        .about("Asks what you expect before you write a task: the chapter's questions, and its worked example with numbers of your own")
        .arg(
            Arg::new("task")
                .value_name("TASK")
                .help("A task such as `part1.task3` [default: the next open task]"),
        )
        .arg(
            Arg::new("seed")
                .long("seed")
                .value_name("N")
                .allow_negative_numbers(true)
                .value_parser(|text: &str| whole_number::<u64>(text, 0, u64::MAX))
                .help("Repeat the numbers of a seed [default: others each time]"),
        )
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let task = match matches.get_one::<String>("task") {
        None => next_task::or_last(&workspace, &course)?,
        Some(what) => match course.select(what)?.as_slice() {
            [task] => *task,
            tasks => {
                return Err(GraderError::new(format!(
                    "expected one task, such as `grader predict {}`; found `{what}`",
                    tasks[0].key
                )));
            }
        },
    };
    let key = &task.key;
    let asked = questions::of(&workspace, key)?;
    let predictions = Predictions::read(&workspace)?;
    // Of the operating system: a hasher's key differs from run to run.
    let seed = matches
        .get_one("seed")
        .copied()
        .unwrap_or_else(|| RandomState::new().hash_one(key) >> 40);
    let example = worked_examples::of(key, seed);
    let mut input = stdin().lock();
    let is_terminal = stdin().is_terminal();
    let is_empty = |input: &mut dyn BufRead| input.fill_buf().is_ok_and(<[u8]>::is_empty);
    if !is_terminal && is_empty(&mut input) {
        return Err(no_answer(
            key,
            "the standard input is no terminal and is empty",
        ));
    }
    outln!(
        "{key}, {}: what do you expect? An empty line skips a question. Nothing here gives points.",
        task.title
    );
    let answers = Session {
        input: &mut input,
        print: &mut |text| out!("{text}"),
        echoes: !is_terminal,
        width: Page::of_stdout().width,
    }
    .run(&asked, example.as_ref(), seed)?;
    let all = asked.len() + example.as_ref().map_or(0, |example| example.asked.len());
    if answers.is_empty() {
        return Err(no_answer(key, "the input ended"));
    }
    let right = answers.iter().filter(|answer| answer.is_right).count();
    let given = answers.len();
    outln!();
    outln!(
        "{right} of {all} predicted rightly.{}",
        if given < all {
            format!(" The input ended after {given}.")
        } else {
            String::new()
        }
    );
    let before = predictions.rounds(key).len();
    predictions.add(&workspace, key, Round { seed, answers })?;
    outln!(
        "Stored for yourself in {} (round {}; `--seed {seed}` repeats the numbers).",
        workspace
            .relative(&crate::predict::store::file(&workspace))
            .display(),
        before + 1
    );
    Ok(Exit::Passed)
}

fn no_answer(key: &str, why: &str) -> GraderError {
    GraderError::new(format!(
        "no answer: {why}. Run `cargo grader predict {key}` in a terminal, or pipe one answer a line, such as \
         `printf 'a\\nb\\n' | cargo grader predict {key}`"
    ))
}
