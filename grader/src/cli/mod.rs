//! The command line of `grader`.
//!
//! `grader part1` grades here ([`grade`]). The other commands are programs of their own ([`sister`]), so that a student who
//! grades does not compile them. What all these programs share is here: their [`Verdict`] and how they [`end`].

pub mod grade;
mod sister;

use crate::error::GraderError;
use crate::interrupt;
use clap::{Arg, ArgMatches, Command, value_parser};
use std::ffi::OsString;
use std::fmt::Display;
use std::process::ExitCode;
use std::str::FromStr;

/// The exit codes of every program of the grader, for `--help`.
pub const EXIT_CODES: &str =
    "Exit code: 0 every core point, 1 points lost, 2 the grader or its input is at fault.";

/// The commands that are programs of their own: name, package, description.
const SISTERS: [(&str, &str, &str); 6] = [
    (
        "cost",
        "cost",
        "Measures what accuracy costs in time: well-known kernels and yours, side by side",
    ),
    (
        "bless",
        "review",
        "For instructors: accepts what the reference computes now as golden, after showing what that changes",
    ),
    (
        "review",
        "review",
        "For reviewers: writes a page with every difference between the goldens and what the code computes now",
    ),
    (
        "handout",
        "authoring",
        "For instructors: carves the project that a student is given",
    ),
    (
        "course",
        "authoring",
        "For instructors: checks the course itself",
    ),
    (
        "mutants",
        "authoring",
        "For instructors: grades typical mistakes, which must lose points, and correct variants, which must not",
    ),
];

/// The command line of `grader`.
fn command() -> Command {
    let sisters = SISTERS.iter().map(|(name, _, about)| {
        let rest = Arg::new("arguments")
            .value_parser(value_parser!(OsString))
            .num_args(..)
            .trailing_var_arg(true)
            .allow_hyphen_values(true)
            .hide(true);
        Command::new(*name)
            .about(*about)
            .disable_help_flag(true)
            .arg(rest)
    });
    grade::arguments(Command::new("grader"))
        .args(grade::submission_arguments())
        .about("Scores your ray tracer, stage by stage")
        .version(env!("CARGO_PKG_VERSION"))
        .args_conflicts_with_subcommands(true)
        .subcommand_negates_reqs(true)
        .after_help(EXIT_CODES)
        .subcommands(sisters)
}

/// How to print a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// For people.
    Table,
    /// One JSON object.
    Json,
}

impl Format {
    /// The option `--format`.
    pub fn argument() -> Arg {
        Arg::new("format")
            .long("format")
            .help("How to print the report")
            .value_parser(["table", "json"])
            .default_value("table")
    }

    /// What [`Format::argument`] was given.
    pub fn of(matches: &ArgMatches) -> Format {
        match matches.get_one::<String>("format").map(String::as_str) {
            Some("json") => Format::Json,
            _ => Format::Table,
        }
    }
}

/// The option `--seed`.
pub fn seed_argument() -> Arg {
    Arg::new("seed")
        .long("seed")
        .value_name("SEED")
        .help("Seed of the random probes")
        .value_parser(|value: &str| whole_number(value, 0, u64::MAX))
        .default_value("0")
        .allow_negative_numbers(true)
}

/// What [`seed_argument`] was given.
pub fn seed_of(matches: &ArgMatches) -> u64 {
    matches.get_one("seed").copied().unwrap_or(0)
}

/// Reads a whole number in `least..=most`, or says what is allowed.
pub fn whole_number<T: FromStr + PartialOrd + Display>(
    value: &str,
    least: T,
    most: T,
) -> Result<T, String> {
    match value.parse() {
        Ok(number) if least <= number && number <= most => Ok(number),
        _ => Err(format!("give a whole number from {least} to {most}")),
    }
}

/// The outcome of a run that came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every core point, or no complaint.
    Full,
    /// Points were lost, or a check found something.
    Short,
}

/// Runs `work` as the whole of a program: its exit code, after an error has been printed. Ctrl-C ends what it started.
pub fn end(work: impl FnOnce() -> Result<Verdict, GraderError>) -> ExitCode {
    interrupt::watch();
    match work() {
        Ok(Verdict::Full) => ExitCode::SUCCESS,
        Ok(Verdict::Short) => ExitCode::from(1),
        Err(error) => {
            if !interrupt::is_the_cause() {
                eprintln!("error: {error}");
            }
            ExitCode::from(2)
        }
    }
}

/// The command line of a program that has some of the commands of `grader`.
pub fn sister(commands: impl IntoIterator<Item = Command>) -> Command {
    Command::new("grader")
        .version(env!("CARGO_PKG_VERSION"))
        .subcommand_required(true)
        .after_help(EXIT_CODES)
        .subcommands(commands)
}

/// Runs the program `grader`.
pub fn main() -> ExitCode {
    let matches = command().get_matches();
    end(|| run(&matches))
}

fn run(matches: &ArgMatches) -> Result<Verdict, GraderError> {
    if let Some((name, rest)) = matches.subcommand() {
        let sister = SISTERS.iter().find(|(sister, ..)| *sister == name);
        let (_, package, _) = sister.expect("clap knows no other command");
        let arguments = [OsString::from(name)].into_iter().chain(passed_on(rest));
        return sister::run(package, arguments.collect());
    }
    if grade::is_of_a_submission(matches) {
        return sister::run("submission", std::env::args_os().skip(1).collect());
    }
    grade::run(matches)
}

/// The arguments after the name of a command that is a program of its own.
fn passed_on(rest: &ArgMatches) -> impl Iterator<Item = OsString> {
    let arguments = rest.get_many::<OsString>("arguments");
    arguments.unwrap_or_default().cloned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_sound() {
        command().debug_assert();
    }

    #[test]
    fn a_seed_that_is_not_a_whole_number_is_refused() {
        for line in ["grader part1 --seed x", "grader part1 --seed -1"] {
            let refused = command().try_get_matches_from(line.split(' ')).err();
            let message = refused.expect("this line is refused").to_string();
            let allowed = "give a whole number from 0 to";
            assert!(message.contains(allowed), "`{line}`:\n{message}");
            assert!(!message.contains("-- -1"), "`{line}`:\n{message}");
        }
    }

    #[test]
    fn two_tasks_at_once_are_refused() {
        let matches = command().get_matches_from(["grader", "part1", "part2"]);
        let refused = run(&matches).expect_err("two tasks").to_string();
        assert!(
            refused.contains("one at a time: `grader part1`, then `grader part2`"),
            "{refused}"
        );
    }

    #[test]
    fn a_command_takes_its_arguments_as_they_are() {
        let line = ["grader", "cost", "--help", "box", "--seed", "-1"];
        let matches = command().get_matches_from(line);
        let (name, rest) = matches.subcommand().expect("a command");
        assert_eq!(name, "cost");
        assert!(passed_on(rest).eq(line[2..].iter().map(OsString::from)));
    }
}
