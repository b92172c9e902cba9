//! The command `grader gym`: mistakes to recognize.

use super::asking::{self, AnswerInput};
use super::picture::in_terminal;
use crate::course::Course;
use crate::grade;
use crate::gym::{exercise, round};
use crate::predict::session::Session;
use crate::report::terminal::Page;
use base::program::Exit;
use base::{GraderError, Workspace, out, outln, write_whole};
use clap::{Arg, ArgMatches, Command};
use judge::plural;
use pictures::png;
use std::path::Path;

/// The name of the command.
pub(super) const NAME: &str = "gym";

pub(super) fn command() -> Command {
    Command::new(NAME)
        .about("Shows pictures and calls of typical mistakes, and asks which mistake it is; gives no points")
        .arg(
            Arg::new("what")
                .value_name("PART")
                .default_value("all")
                .help("A part such as `part1`, or a task"),
        )
        .arg(asking::seed_argument().help("Repeat the questions of this seed [default: a new seed each time]"))
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let what: &String = matches.get_one("what").expect("it has a default");
    let tasks = course.select(what)?;
    let specs = grade::specs(&tasks, 0)?;
    let mut all = Vec::new();
    for task in tasks {
        all.extend(exercise::of(&workspace, task, &specs)?);
    }
    let seed = asking::seed_of(matches);
    let before = round::missed(&workspace);
    let exercises = round::chosen(all, &before, seed);
    let mut input = AnswerInput::of_stdin().ok_or_else(|| {
        GraderError::new(
            "no answer: the standard input is no terminal and is empty. Run this command in a terminal, or pipe one \
             letter a line",
        )
    })?;
    workspace.create_outputs()?;
    let file = workspace.outputs().join("gym.png");
    let page = Page::of_stdout();
    outln!(
        "{} mistakes. Left is the right picture, right that of the mistake; also in {}. An empty line skips one, \
         `q` ends.",
        exercises.len(),
        workspace.relative(&file).display()
    );
    let asked: Vec<String> = exercises.iter().map(exercise::Exercise::id).collect();
    let mut show = |exercise: &exercise::Exercise| {
        let picture = exercise.picture()?;
        write_whole(&file, &png::encode(&picture))?;
        outln!();
        out!("{}", in_terminal(&picture).unwrap_or_default());
        Ok(())
    };
    let mut session = Session {
        input: &mut input.lines,
        print: &mut |text| out!("{text}"),
        echoes: !input.is_terminal,
        width: page.width,
        has_quit: false,
    };
    let outcome = round::run(&mut session, exercises, &mut show, seed)?;
    let mut missed = before;
    missed.retain(|id| !asked.contains(id));
    missed.extend(outcome.missed.iter().cloned());
    round::store(&workspace, &missed)?;
    outln!();
    outln!(
        "{} of {} recognized at once.{}",
        outcome.at_once,
        outcome.asked,
        match missed.len() {
            0 => String::new(),
            n => format!(
                " The next round begins with what is not recognized yet: {}.",
                plural(n, "picture", "pictures")
            ),
        }
    );
    Ok(Exit::Passed)
}
