//! `grader part1`: grades the code in the workspace.

use super::{Format, Verdict, seed_argument, seed_of};
use crate::error::GraderError;
use crate::grade::{self, GradeRequest};
use crate::report;
use crate::report::table::Hint;
use crate::workspace::Workspace;
use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use std::path::{Path, PathBuf};

/// Adds to `command` the arguments that say what to grade and how to show it.
pub fn arguments(command: Command) -> Command {
    command
        .arg(
            Arg::new("what")
                .value_name("WHAT")
                .required(true)
                .help("What to grade: `all`, a part such as `part1`, or a task such as `part1.task3`"),
        )
        .arg(Arg::new("more").num_args(..).hide(true))
        .arg(Format::argument())
        .arg(seed_argument())
        .arg(
            Arg::new("hint")
                .long("hint")
                .value_name("LEVEL")
                .value_parser(["1", "2", "3", "4"])
                .default_value("4")
                .help("How much to reveal: 1 what the cases that fail check, 2 also what is wrong, 3 also the worst ray, 4 also the mistake"),
        )
        .arg(
            Arg::new("no-times")
                .long("no-times")
                .action(ArgAction::SetTrue)
                .help("Leave out the table of speedups"),
        )
}

/// The arguments that say whose code to grade, if not the workspace's own.
pub fn submission_arguments() -> [Arg; 4] {
    let folder = |name: &'static str, help: &'static str| {
        Arg::new(name)
            .long(name)
            .value_name("DIR")
            .value_parser(value_parser!(PathBuf))
            .help(help)
    };
    [
        folder(
            "submission",
            "For instructors: grade the stages in DIR, each among the reference's other stages",
        )
        .conflicts_with("class"),
        folder(
            "class",
            "For instructors: grade every folder in DIR as a submission",
        )
        .requires("out"),
        folder("out", "Where a class's reports and summary.csv go").requires("class"),
        Arg::new("together")
            .long("together")
            .action(ArgAction::SetTrue)
            .help("Also grade all of a submission's stages linked together"),
    ]
}

/// Whether any of [`submission_arguments`] was given.
pub(super) fn is_of_a_submission(matches: &ArgMatches) -> bool {
    let folders = ["submission", "class", "out"];
    matches.get_flag("together") || folders.iter().any(|name| matches.contains_id(name))
}

/// What is to be graded, or an error if it is more than one thing.
pub fn request(matches: &ArgMatches) -> Result<GradeRequest, GraderError> {
    let what = matches
        .get_one::<String>("what")
        .ok_or_else(|| GraderError::new("no task is named. Run `grader part1`"))?;
    if let Some(second) = matches.get_one::<String>("more") {
        return Err(GraderError::new(format!(
            "one at a time: `grader {what}`, then `grader {second}`; or `grader all`"
        )));
    }
    Ok(GradeRequest {
        what: what.clone(),
        seed: seed_of(matches),
    })
}

/// How much the report reveals.
pub fn hint(matches: &ArgMatches) -> Hint {
    match matches.get_one::<String>("hint").map(String::as_str) {
        Some("1") => Hint::Class,
        Some("2") => Hint::Field,
        Some("3") => Hint::Ray,
        _ => Hint::Mistake,
    }
}

pub(super) fn run(matches: &ArgMatches) -> Result<Verdict, GraderError> {
    let request = request(matches)?;
    let workspace = Workspace::above(Path::new("."))?;
    let graded = grade::in_place(&workspace, &request, !matches.get_flag("no-times"))?;
    let json = report::json(&graded.report)?;
    report::write_whole(&workspace.root().join("report.json"), json.as_bytes())?;
    match Format::of(matches) {
        Format::Json => println!("{json}"),
        Format::Table => {
            if !graded.printed.is_empty() {
                println!("your code printed:\n{}\n", graded.printed.trim_end());
            }
            print!("{}", report::table::show(&graded.report, hint(matches)));
        }
    }
    Ok(if graded.report.is_full() {
        Verdict::Full
    } else {
        Verdict::Short
    })
}
