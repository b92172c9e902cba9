//! The command line of `grader`.
//!
//! This program does what students do all day: `grader part1` ([`grade`]; `case` for a single
//! case), `grader watch`, `grader check`, `grader status`, `grader explain`,
//! `grader practice`, `grader solution`, `grader book`, `grader reset`, `grader test`. Each other
//! command is a separate program (`subprogram`), so that a student who only grades does not have to
//! compile it. This module contains what they all share: the [`Exit`], the exit codes
//! ([`run_to_exit_code`]) and common options.

mod asking;
mod book;
mod case;
mod check;
mod completions;
pub mod course_systems;
mod doctor;
mod examples;
mod explain;
pub mod grade;
mod gym;
mod help;
mod offline;
mod options;
pub mod picture;
mod practice;
mod predict;
pub mod programs;
mod reset;
mod solution;
mod status;
pub mod subprogram;
mod test;
mod watch;

pub use options::{Format, seed_argument, seed_of};

use crate::report::HintLevel;
use base::GraderError;
use base::program::{Exit, Run, arguments_of, run_to_exit_code};
use clap::{Arg, ArgMatches, Command, value_parser};
use std::ffi::OsString;
use std::process::ExitCode;

/// The commands of this program, in the order of `--help`, where `help` is the last of all.
const COMMANDS: [(fn() -> Command, Run); 18] = [
    (status::command, |_| status::run()),
    (test::command, test::run),
    (watch::command, watch::run),
    (check::command, check::run),
    (explain::command, explain::run),
    (practice::command, practice::run),
    (solution::command, solution::run),
    (reset::command, reset::run),
    (hint_command, hint),
    (book::command, book::run),
    (examples::command, examples::run),
    (picture::command, picture::run),
    (predict::command, predict::run),
    (gym::command, gym::run),
    (doctor::command, |_| doctor::run()),
    (offline::command, |_| offline::run()),
    (completions::command, completions::run),
    (help::command, help::run),
];

/// The commands that are separate programs: name, package, description.
const SUBPROGRAMS: &[(&str, &str, &str)] = &[
    (
        "look",
        "look",
        "Renders a task's picture with your code, and opens a page of what is wrong in the task",
    ),
    (
        "cost",
        "cost",
        "Measures what accuracy costs in time: compares your kernels with well-known ones",
    ),
    (
        "speedup",
        "speedup",
        "Measures what each step from brute force to a wide tree gains in speed, your own steps included",
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
        "start",
        "handout",
        "In the course's checkout: makes your own folder, without the solutions, with the next step to take",
    ),
    (
        "handout",
        "handout",
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

/// The command line of `grader`, whose help lists the commands of a day.
fn command() -> Command {
    help::with_daily_commands(all_commands())
}

/// The same with all that students use in its help.
fn all_commands() -> Command {
    let subprograms = SUBPROGRAMS.iter().map(|(name, _, about)| {
        if let Some(command) = programs::of(name) {
            return command;
        }
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
    let for_instructors = grade::submission_arguments()
        .into_iter()
        .chain(course_systems::arguments());
    let [commands @ .., (help, _)] = COMMANDS;
    grade::arguments(Command::new("grader"), HintLevel::Findings)
        .args(grade::student_arguments())
        .args(for_instructors.map(|argument| argument.hide(true)))
        .mut_arg("format", |argument| argument.hide_possible_values(true))
        .disable_help_subcommand(true)
        .about("Scores your ray tracer, stage by stage")
        .version(base::VERSION)
        .args_conflicts_with_subcommands(true)
        .after_help(help::after())
        .subcommands(commands.iter().map(|(command, _)| command()))
        .subcommands(subprograms)
        .subcommand(help())
}

/// The name of the command for a hint.
const HINT: &str = "hint";

/// `grader hint` is the report at the level of the likely mistake.
fn hint_command() -> Command {
    Command::new(HINT)
        .about("Grades, and also names the likely mistake: --hint 3, as a word")
        .arg(
            Arg::new("what")
                .value_name("TASK")
                .help("The task, such as `part1.task3` [default: the next open task]"),
        )
        .arg(grade::hint_argument(HintLevel::Mistake))
}

/// Grades what `grader hint` names, with the likely mistake.
fn hint(rest: &ArgMatches) -> Result<Exit, GraderError> {
    let level = grade::hint(rest).number().to_string();
    let mut line = vec!["grader".to_owned(), "--hint".into(), level];
    line.extend(rest.get_one::<String>("what").cloned());
    let matches = command().try_get_matches_from(line);
    grade::run(&matches.map_err(|e| GraderError::new(e.to_string()))?)
}

/// Runs the program `grader`.
pub fn main() -> ExitCode {
    let matches = arguments_of(command());
    run_to_exit_code(|| run(&matches))
}

fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    if let Some((name, rest)) = matches.subcommand() {
        let is_named = |(command, _): &&(fn() -> Command, Run)| command().get_name() == name;
        if let Some((_, run)) = COMMANDS.iter().find(is_named) {
            return run(rest);
        }
        let subprogram = SUBPROGRAMS.iter().find(|(other, ..)| *other == name);
        let Some((_, package, _)) = subprogram else {
            unreachable!("`{name}` is in neither list of commands");
        };
        if name == programs::LOOK && !picture::look(rest)? {
            return Ok(Exit::Passed);
        }
        // A command is always the first argument.
        return subprogram::run(package, std::env::args_os().skip(1).collect());
    }
    if grade::is_for_submissions(matches) {
        return subprogram::run("submission", std::env::args_os().skip(1).collect());
    }
    if course_systems::is_requested(matches) {
        return subprogram::run("formats", std::env::args_os().skip(1).collect());
    }
    if let Some(word) = matches.get_one::<String>("what")
        && let Some(meant) = help::command_like(word)
    {
        return Err(GraderError::new(format!(
            "there is no command `{word}`, and the course has no such task: did you mean `cargo grader {meant}`?"
        )));
    }
    grade::run(matches)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_commands_that_print_them_take_the_formats_of_course_systems() {
        let takes = |argument: Arg| {
            let command = Command::new("a").arg(argument);
            command
                .try_get_matches_from(["a", "--format", "junit"])
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
        let error = command()
            .try_get_matches_from(["grader", "part1.task3", "--call", "2"])
            .expect_err("no case")
            .to_string();
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
    fn arguments_of_a_subprogram_are_not_read_before_it_does() {
        let line = ["grader", "mutants", "--help", "part1", "--seed", "-1"];
        let matches = command().get_matches_from(line);
        let (name, _) = matches.subcommand().expect("a command");
        assert_eq!(name, "mutants");
    }

    #[test]
    fn a_misspelt_command_is_named() {
        for (word, meant) in [("staus", "status"), ("exlpain", "explain"), ("lok", "look")] {
            let matches = command().get_matches_from(["grader", word]);
            let error = run(&matches).expect_err("no such command").to_string();
            let question = format!("did you mean `cargo grader {meant}`?");
            assert!(error.contains(&question), "{error}");
        }
        for word in ["all", "part1", "part1.task3", "prat1", "nothing"] {
            assert_eq!(help::command_like(word), None, "{word}");
        }
    }

    #[test]
    fn a_misspelt_flag_of_a_students_program_is_named_before_it_is_built() {
        for (line, right) in [
            ("grader look --no-opn", "--no-open"),
            ("grader cost --qick", "--quick"),
            ("grader speedup --larges 1000", "--largest"),
            ("grader part1 --hnt 3", "--hint"),
        ] {
            let error = command().try_get_matches_from(line.split(' ')).err();
            let message = error.expect("the flag does not exist").to_string();
            assert!(
                message.contains(&format!("'{right}'")),
                "`{line}`:\n{message}"
            );
        }
    }
}
