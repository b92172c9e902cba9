//! The command `grader start FOLDER`: makes the folder in which somebody learns alone.

use super::part_number;
use base::program::Exit;
use base::{GraderError, Workspace, errln, out, outln, shell_word};
use clap::{Arg, ArgMatches, Command, value_parser};
use grader::book;
use grader::cli::picture::in_terminal;
use grader::course::Course;
use grader::progress::next_task;
use grader::report::screen;
use handout::repository::Repository;
use handout::{Handout, built, output_folder};
use pictures::{Image, png};
use std::path::{Path, PathBuf};

pub(crate) fn command() -> Command {
    Command::new("start")
        .about("Makes your own folder: the course without solutions, built already, with the next step to take")
        .arg(
            Arg::new("folder")
                .value_name("FOLDER")
                .required(true)
                .value_parser(value_parser!(PathBuf))
                .help("A new folder outside the course, such as ../my-ray-tracer"),
        )
        .arg(
            Arg::new("part")
                .long("part")
                .value_name("N")
                .default_value("1")
                .value_parser(part_number)
                .allow_negative_numbers(true)
                .help("The first part that you write; earlier parts keep the course's code"),
        )
}

pub(crate) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let part: u32 = *matches.get_one("part").expect("it has a default");
    let out: &PathBuf = matches.get_one("folder").expect("clap requires it");
    let checkout = Workspace::above(Path::new("."))?;
    output_folder::check(&checkout, out)?;
    let handout = Handout::carve(&checkout, part)?;
    handout.write(out, false)?;
    built::keep_times(checkout.root(), &handout, out)?;
    // Before there is a target folder in it, which is not committed.
    let repository = Repository::create(out);
    if let Err(why) = built::copy(checkout.root(), out) {
        errln!(
            "What cargo built here is not copied: {why}. The first `cargo grader` builds it again."
        );
    }
    let started = Workspace::above(out)?;
    book::remember_checkout(&started, &checkout)?;
    let course = Course::read(&started)?;
    outln!(
        "{} is your folder. {}",
        out.display(),
        repository.sentence()
    );
    if let Some(task) = course
        .parts
        .iter()
        .find(|it| it.number == part)
        .and_then(|it| it.tasks.last())
    {
        outln!();
        out!("{}", picture(&started, &task.key, part)?);
    }
    let known = next_task::known(&started, &course)?;
    if let Some(place) = next_task::first_open(&known, &[]) {
        outln!(
            "\nFirst: {} {}. {}",
            place.key,
            place.title,
            screen::to_write(Some(place))
        );
    }
    outln!("Next:  cd {} && cargo grader", shell_word(out));
    Ok(Exit::Passed)
}

/// The upper panel of the picture of a task, where the terminal has colours, and a line about it.
fn picture(started: &Workspace, task: &str, part: u32) -> Result<String, GraderError> {
    let path = started.golden_picture(task, "task");
    let sheet = png::read(&path).map_err(|why| GraderError::file("read", &path, why))?;
    let panels = judge::pictures::of(task).map_or(1, |picture| picture.panels.len() as u32);
    let [w, h] = sheet.size();
    let panel = Image::from_fn([w, h / panels.max(1)], |x, y| sheet.get(x, y));
    let about = format!("What Part {part} draws at its end");
    Ok(match in_terminal(&panel) {
        Some(drawn) => format!("{drawn}{about}: each colour is the direction of a surface.\n"),
        None => format!("{about}: {}\n", path.display()),
    })
}
