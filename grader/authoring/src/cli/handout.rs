//! The command `grader handout --part N --out DIR`: creates the project for students.

use authoring::handout::{Handout, output_folder};
use base::program::{Exit, path_argument};
use base::{GraderError, Workspace, outln};
use clap::{Arg, ArgMatches, Command};
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
}

fn part_number(value: &str) -> Result<u32, String> {
    base::program::whole_number(value, 1, u32::MAX)
        .map_err(|_| "expected a part's number, such as 1".to_owned())
}

pub(crate) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let part: u32 = *matches.get_one("part").expect("clap requires it");
    let out: &PathBuf = matches.get_one("out").expect("clap requires it");
    let workspace = Workspace::above(Path::new("."))?;
    output_folder::check(&workspace, out)?;
    let handout = Handout::carve(&workspace, part)?;
    handout.write(out)?;
    outln!(
        "{}: {} files written, {} solutions removed. Students start with README.md",
        out.display(),
        handout.files.len(),
        handout.removed.len()
    );
    Ok(Exit::Passed)
}
