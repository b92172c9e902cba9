//! The command line of `grader`.
//!
//! This program does what students do all day: `grader part1` ([`grade`]; `case` for a single
//! case), `grader watch`, `grader status`, `grader explain`, `grader picture`. Each other command
//! is a separate program (`subprogram`), so that a student who only grades does not have to compile
//! it. This module contains what they all share: the [`Exit`], the exit codes
//! ([`run_to_exit_code`]) and common options.

mod case;
pub mod course_systems;
mod explain;
pub mod grade;
mod help;
pub mod picture;
mod status;
mod subprogram;
mod watch;

use crate::report::HintLevel;
use base::GraderError;
use base::program::{Exit, arguments_of, run_to_exit_code, whole_number};
use clap::{Arg, ArgMatches, Command, value_parser};
use std::ffi::OsString;
use std::process::ExitCode;

/// The commands that are separate programs: name, package, description.
const SUBPROGRAMS: &[(&str, &str, &str)] = &[
    (
        "look",
        "review",
        "Shows what is wrong in a task: writes a page with pictures and rays, and opens it in the browser",
    ),
    (
        "cost",
        "cost",
        "Measures what accuracy costs in time: compares your kernels with well-known ones",
    ),
    (
        "speedup",
        "speedup",
        "Measures what each step from brute force to a wide tree gains in speed: yours are among them",
    ),
    (
        "bless",
        "review",
        "For instructors: shows how the reference's results differ from the goldens, then stores them as new goldens",
    ),
    (
        "review",
        "review",
        "For reviewers: writes an HTML page with every difference between the goldens and the code's results",
    ),
    (
        "class",
        "class",
        "For instructors: grades a folder of submissions; what is graded already is not graded again",
    ),
    (
        "handout",
        "authoring",
        "For instructors: creates the project for students, without the solutions",
    ),
    (
        "export",
        "export",
        "For instructors: writes what Gradescope, Classroom 50, PrairieLearn or GitHub Actions needs to grade",
    ),
    (
        "course",
        "authoring",
        "For instructors: checks the course itself, compares it with another version",
    ),
    (
        "mutants",
        "authoring",
        "For instructors: grades typical mistakes, which must lose points, and correct variants, which must not",
    ),
];

/// The command line of `grader`.
fn command() -> Command {
    let subprograms = SUBPROGRAMS.iter().map(|(name, _, about)| {
        let rest = Arg::new("arguments")
            .value_parser(value_parser!(OsString))
            .num_args(..)
            .trailing_var_arg(true)
            .allow_hyphen_values(true)
            .hide(true);
        Command::new(*name)
            .about(*about)
            .disable_help_flag(true)
            .hide(!help::is_for_students(name))
            .arg(rest)
    });
    let for_instructors = grade::submission_arguments().into_iter();
    let for_instructors = for_instructors.chain(course_systems::arguments());
    grade::arguments(Command::new("grader"), HintLevel::Findings)
        .args(grade::student_arguments())
        .args(for_instructors.map(|argument| argument.hide(true)))
        .mut_arg("format", |argument| argument.hide_possible_values(true))
        .disable_help_subcommand(true)
        .about("Scores your ray tracer, stage by stage")
        .version(base::VERSION)
        .args_conflicts_with_subcommands(true)
        .after_help(help::after())
        .subcommands([
            status::command(),
            watch::command(),
            explain::command(),
            picture::command(),
        ])
        .subcommands(subprograms)
        .subcommand(help::command())
}

/// How to print a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A table and explanations, for people.
    Table,
    /// One JSON object, for programs.
    Json,
}

impl Format {
    /// The option `--format`.
    pub fn argument() -> Arg {
        Arg::new("format")
            .long("format")
            .help("How to print the report: `table`, or `json` for programs")
            .value_parser(Format::NAMES)
            .default_value("table")
    }

    /// The option `--format` of a command that also prints the formats of course systems.
    pub fn argument_with_course_systems() -> Arg {
        let names = Format::NAMES.into_iter().chain(course_systems::FORMATS);
        Format::argument().value_parser(names.collect::<Vec<_>>())
    }

    const NAMES: [&str; 2] = ["table", "json"];

    /// Reads the option that [`Format::argument`] defines.
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
        .help("Seed of the random inputs, such as rays. Another than 0 also moves all other inputs by exact symmetries, as an instructor's run does")
        .value_parser(|value: &str| whole_number(value, 0, u64::MAX))
        .default_value("0")
        .allow_negative_numbers(true)
}

/// Reads the option that [`seed_argument`] defines.
pub fn seed_of(matches: &ArgMatches) -> u64 {
    matches.get_one("seed").copied().unwrap_or(0)
}

/// Runs the program `grader`.
pub fn main() -> ExitCode {
    let matches = arguments_of(command());
    run_to_exit_code(|| run(&matches))
}

fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    if let Some((name, rest)) = matches.subcommand() {
        if name == picture::NAME {
            return picture::run(rest);
        }
        let subprogram = SUBPROGRAMS.iter().find(|(other, ..)| *other == name);
        let Some((_, package, _)) = subprogram else {
            return match name {
                "status" => status::run(),
                "watch" => watch::run(rest),
                help::NAME => help::run(rest),
                _ => explain::run(rest),
            };
        };
        let arguments = [OsString::from(name)]
            .into_iter()
            .chain(forwarded_arguments(rest));
        return subprogram::run(package, arguments.collect());
    }
    if course_systems::is_requested(matches) {
        return subprogram::run("formats", std::env::args_os().skip(1).collect());
    }
    if grade::is_for_submissions(matches) {
        return subprogram::run("submission", std::env::args_os().skip(1).collect());
    }
    grade::run(matches)
}

/// The arguments after the name of a command that is a separate program.
fn forwarded_arguments(rest: &ArgMatches) -> impl Iterator<Item = OsString> {
    let arguments = rest.get_many::<OsString>("arguments");
    arguments.unwrap_or_default().cloned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_commands_that_print_them_take_the_formats_of_course_systems() {
        let takes = |argument: Arg| {
            let command = Command::new("a").arg(argument);
            command
                .try_get_matches_from(["a", "--format", "csv"])
                .is_ok()
        };
        assert!(!takes(Format::argument()));
        assert!(takes(Format::argument_with_course_systems()));
    }

    #[test]
    fn the_command_line_is_valid() {
        command().debug_assert();
    }

    #[test]
    fn a_seed_that_is_not_a_whole_number_is_an_error() {
        for line in ["grader part1 --seed x", "grader part1 --seed -1"] {
            let error = command().try_get_matches_from(line.split(' ')).err();
            let message = error.expect("the command line must be refused").to_string();
            let expected = "expected a whole number from 0 to";
            assert!(message.contains(expected), "`{line}`:\n{message}");
            // Not clap's own advice, to write `-- -1`.
            assert!(!message.contains("-- -1"), "`{line}`:\n{message}");
        }
    }

    #[test]
    fn a_student_sees_less_by_default_than_an_instructor() {
        let of = |command: Command, line: &str| {
            let matches = command.get_matches_from(line.split(' '));
            grade::hint(&matches)
        };
        assert_eq!(of(command(), "grader part1"), HintLevel::Findings);
        assert_eq!(of(command(), "grader part1 --hint 1"), HintLevel::Cases);
        let instructor = || grade::arguments(Command::new("grader"), HintLevel::Remedy);
        assert_eq!(of(instructor(), "grader part1"), HintLevel::Remedy);
        assert_eq!(
            of(instructor(), "grader part1 --hint 3"),
            HintLevel::Mistake
        );
    }

    #[test]
    fn a_call_needs_its_case_and_a_case_its_task() {
        let error = command().try_get_matches_from(["grader", "part1.task3", "--call", "2"]);
        let error = error.expect_err("no case").to_string();
        assert!(error.contains("--case"), "{error}");
        let matches = command().get_matches_from(["grader", "--case", "range"]);
        let error = run(&matches).expect_err("no task").to_string();
        assert!(error.contains("expected the task of the case"), "{error}");
    }

    #[test]
    fn two_tasks_at_once_are_an_error() {
        let matches = command().get_matches_from(["grader", "part1", "part2"]);
        let error = run(&matches).expect_err("two tasks").to_string();
        assert!(
            error.contains("found two. Run `grader part1`, then `grader part2`"),
            "{error}"
        );
    }

    #[test]
    fn arguments_of_a_subprogram_are_forwarded_unchanged() {
        let line = ["grader", "cost", "--help", "box", "--seed", "-1"];
        let matches = command().get_matches_from(line);
        let (name, rest) = matches.subcommand().expect("a command");
        assert_eq!(name, "cost");
        assert!(forwarded_arguments(rest).eq(line[2..].iter().map(OsString::from)));
    }
}
