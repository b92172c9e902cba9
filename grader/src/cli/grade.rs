//! The command `grader part1`: grades the code in the workspace.

use super::{Format, Verdict, seed_argument, seed_of};
use crate::error::GraderError;
use crate::grade::{self, GradeRequest};
use crate::printed;
use crate::report;
use crate::report::table::HintLevel;
use crate::workspace::Workspace;
use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use std::path::{Path, PathBuf};

/// Adds to `command` the arguments for what to grade and how to print the report.
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
                .help("How much to reveal: 1 = what each failed case tests, 2 = also what is wrong, 3 = also the worst ray, 4 = also the likely mistake"),
        )
        .arg(
            Arg::new("no-times")
                .long("no-times")
                .action(ArgAction::SetTrue)
                .help("Leave out the table of speedups"),
        )
}

/// The arguments for grading submissions instead of the workspace's own code.
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
            "For instructors: grade the stages in DIR, each together with the reference's other stages",
        )
        .conflicts_with("class"),
        folder(
            "class",
            "For instructors: grade every folder in DIR as a submission",
        )
        .requires("out"),
        folder("out", "The folder for the reports of a class and its summary.csv")
            .requires("class"),
        Arg::new("together")
            .long("together")
            .action(ArgAction::SetTrue)
            .help("Also grade all stages of a submission linked together"),
    ]
}

/// Whether any of the [`submission_arguments`] is present.
pub(super) fn is_for_submissions(matches: &ArgMatches) -> bool {
    let folders = ["submission", "class", "out"];
    matches.get_flag("together") || folders.iter().any(|name| matches.contains_id(name))
}

/// Reads what to grade. Naming more than one part or task is an error.
pub fn request(matches: &ArgMatches) -> Result<GradeRequest, GraderError> {
    let what = matches
        .get_one::<String>("what")
        .ok_or_else(|| GraderError::new("expected a part or a task, such as `grader part1`"))?;
    if let Some(second) = matches.get_one::<String>("more") {
        return Err(GraderError::new(format!(
            "expected one part or task, found two. Run `grader {what}`, then `grader {second}`; or run `grader all`"
        )));
    }
    Ok(GradeRequest {
        what: what.clone(),
        seed: seed_of(matches),
    })
}

/// Reads how much the report reveals.
pub fn hint(matches: &ArgMatches) -> HintLevel {
    match matches.get_one::<String>("hint").map(String::as_str) {
        Some("1") => HintLevel::Class,
        Some("2") => HintLevel::Field,
        Some("3") => HintLevel::Ray,
        _ => HintLevel::Mistake,
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
                println!("{}", printed::format(&graded.printed));
            }
            print!(
                "{}",
                report::table::format_report(&graded.report, hint(matches))
            );
        }
    }
    Ok(if graded.report.is_full() {
        Verdict::Passed
    } else {
        Verdict::Failed
    })
}
