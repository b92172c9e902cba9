//! The command `grader predict part1.task3`: asks what the student expects.

use super::asking::{self, AnswerInput};
use crate::course::Course;
use crate::predict::session::Session;
use crate::predict::store::{self, Predictions, Round};
use crate::predict::{questions, worked_examples};
use crate::progress::next_task;
use crate::report::terminal::Page;
use base::program::Exit;
use base::{GraderError, Workspace, out, outln};
use clap::{Arg, ArgMatches, Command};
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
        .arg(asking::seed_argument().help("Repeat the numbers of a seed [default: others each time]"))
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
    let seed = asking::seed_of(matches);
    let example = worked_examples::of(key, seed);
    let nothing = || no_answer(key, "the standard input is no terminal and is empty");
    let mut input = AnswerInput::of_stdin().ok_or_else(nothing)?;
    outln!(
        "{key}, {}: what do you expect? An empty line skips a question, `q` ends. Nothing here gives points.",
        task.title
    );
    let mut session = Session {
        input: &mut input.lines,
        print: &mut |text| out!("{text}"),
        echoes: !input.is_terminal,
        width: Page::of_stdout().width,
        has_quit: false,
    };
    let answers = session.run(&asked, example.as_ref(), seed)?;
    let has_quit = session.has_quit;
    let all = asked.len() + example.as_ref().map_or(0, |example| example.asked.len());
    if answers.is_empty() && has_quit {
        outln!("\nNo question is answered: nothing is stored.");
        return Ok(Exit::Passed);
    }
    if answers.is_empty() {
        return Err(no_answer(key, "the input ended"));
    }
    let right = answers.iter().filter(|answer| answer.is_right).count();
    let given = answers.len();
    outln!();
    outln!(
        "{right} of {all} predicted rightly.{}",
        if given < all {
            let how = if has_quit { "You" } else { "The input" };
            format!(" {how} ended after {given}.")
        } else {
            String::new()
        }
    );
    let before = predictions.rounds(key).len();
    predictions.add(&workspace, key, Round { seed, answers })?;
    outln!(
        "Stored for yourself in {} (round {}; `--seed {seed}` repeats the numbers).",
        workspace.relative(&store::file(&workspace)).display(),
        before + 1
    );
    Ok(Exit::Passed)
}

fn no_answer(key: &str, why: &str) -> GraderError {
    GraderError::new(format!(
        "no answer: {why}. Run this command in a terminal, or pipe one answer a line, such as \
         `printf 'a\\nb\\n' | cargo grader practice {key} --only predict`"
    ))
}
