//! `grader handout --part N --out DIR`.

use authoring::handout::{Handout, place};
use clap::{Arg, ArgMatches, Command, value_parser};
use grader::cli::Verdict;
use grader::error::GraderError;
use grader::workspace::Workspace;
use std::path::{Path, PathBuf};

pub(crate) fn command() -> Command {
    Command::new("handout")
        .about("For instructors: carves the project that a student is given")
        .arg(
            Arg::new("part")
                .long("part")
                .value_name("N")
                .required(true)
                .value_parser(part_number)
                .allow_negative_numbers(true)
                .help("The first part that the student writes; the reference of the parts before stays"),
        )
        .arg(
            Arg::new("out")
                .long("out")
                .value_name("DIR")
                .required(true)
                .value_parser(value_parser!(PathBuf))
                .help("A new folder, outside the course"),
        )
}

fn part_number(value: &str) -> Result<u32, String> {
    grader::cli::whole_number(value, 1, u32::MAX)
        .map_err(|_| "give a part's number, such as 1".to_owned())
}

pub(crate) fn run(matches: &ArgMatches) -> Result<Verdict, GraderError> {
    let part: u32 = *matches.get_one("part").expect("clap asks for it");
    let out: &PathBuf = matches.get_one("out").expect("clap asks for it");
    let workspace = Workspace::above(Path::new("."))?;
    place::check(&workspace, out)?;
    let handout = Handout::carve(&workspace, part)?;
    handout.write(out)?;
    println!(
        "{}: {} files, {} solutions carved out. A student starts with its README.md",
        out.display(),
        handout.files.len(),
        handout.taken.len()
    );
    Ok(Verdict::Passed)
}
