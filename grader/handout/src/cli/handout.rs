//! The command `grader handout --part N --out DIR`: creates the project for students.

use super::part_number;
use base::program::{Exit, path_argument};
use base::{GraderError, Workspace, outln};
use clap::{Arg, ArgAction, ArgMatches, Command};
use grader::book;
use grader::course::Course;
use handout::{Handout, output_folder, vendored};
use std::path::{Path, PathBuf};

pub(crate) fn command() -> Command {
    Command::new("handout")
        .about("For instructors: creates the project for students, without the solutions")
        .arg(
            Arg::new("part")
                .long("part")
                .value_name("N")
                .required(true)
                .value_parser(part_number)
                .allow_negative_numbers(true)
                .help("The first part that the student writes; earlier parts keep the reference's code"),
        )
        .arg(
            path_argument("out", "DIR")
                .required(true)
                .help("A new folder outside the course"),
        )
        .arg(
            Arg::new("vendor")
                .long("vendor")
                .action(ArgAction::SetTrue)
                .help("Put the sources of all libraries into the handout, so that it builds without a network"),
        )
}

/// What students of the handout of `part` write: "To write: 11 functions of 4 tasks in Part 1".
fn to_write(course: &Course, part: u32) -> String {
    let parts = course
        .parts
        .iter()
        .filter(|other| other.number >= part)
        .map(|part| {
            let functions: usize = part.tasks.iter().map(|task| task.holes.len()).sum();
            format!(
                "{functions} functions of {} tasks in Part {}",
                part.tasks.len(),
                part.number
            )
        });
    format!("To write: {}", parts.collect::<Vec<_>>().join(", "))
}

pub(crate) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let part: u32 = *matches.get_one("part").expect("clap requires it");
    let out: &PathBuf = matches.get_one("out").expect("clap requires it");
    let workspace = Workspace::above(Path::new("."))?;
    output_folder::check(&workspace, out)?;
    let vendor = matches.get_flag("vendor");
    let site = book::make_current(&workspace)?;
    let mut handout = Handout::carve(&workspace, part)?;
    if vendor {
        handout.use_vendored_libraries(&workspace)?;
    }
    handout.add_book(&site)?;
    handout.write(out, vendor)?;
    outln!(
        "{}: {} files. {}. Students start with README.md",
        out.display(),
        handout.files.len(),
        to_write(&Course::read(&workspace)?, part)
    );
    if vendor {
        let size = vendored::megabytes(out);
        outln!(
            "vendor/ has the sources of every library, {size} MB: the handout builds without a network"
        );
    }
    Ok(Exit::Passed)
}
