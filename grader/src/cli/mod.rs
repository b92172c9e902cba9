//! The command line of `grader`.
//!
//! `grader part1` grades here ([`grade`]). The other commands are programs of their own ([`sister`]), so that a student who
//! grades does not compile them. What all these programs share is here: their [`Verdict`] and how they [`end`].

pub mod grade;
mod sister;

use crate::error::GraderError;
use crate::interrupt;
use clap::{Args, Parser, Subcommand, ValueEnum};
use grade::GradeArguments;
use std::ffi::OsString;
use std::fmt::Display;
use std::process::ExitCode;
use std::str::FromStr;

/// The exit codes of every program of the grader, for `--help`.
pub const EXIT_CODES: &str =
    "Exit code: 0 every core point, 1 points lost, 2 the grader or its input is at fault.";

/// Scores your ray tracer, stage by stage.
#[derive(Parser)]
#[command(
    name = "grader",
    version,
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = EXIT_CODES
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    grade: Option<GradeArguments>,
    #[command(flatten)]
    submission: SubmissionArguments,
}

/// The commands that are programs of their own. Each takes its arguments as they are.
#[derive(Subcommand)]
enum Command {
    /// Measures what accuracy costs in time: well-known kernels and yours, side by side.
    #[command(disable_help_flag = true)]
    Cost(Rest),
    /// For instructors: accepts what the reference computes now as golden, after showing what that changes.
    #[command(disable_help_flag = true)]
    Bless(Rest),
    /// For reviewers: writes a page with every difference between the goldens and what the code computes now.
    #[command(disable_help_flag = true)]
    Review(Rest),
    /// For instructors: carves the project that a student is given.
    #[command(disable_help_flag = true)]
    Handout(Rest),
    /// For instructors: checks the course itself.
    #[command(disable_help_flag = true)]
    Course(Rest),
    /// For instructors: grades typical mistakes, which must lose points, and correct variants, which must not.
    #[command(disable_help_flag = true)]
    Mutants(Rest),
}

/// Arguments that are passed on.
#[derive(Args)]
struct Rest {
    #[arg(hide = true, trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<OsString>,
}

/// Whose code to grade, if not the workspace's own. The program `submission` reads these again.
#[derive(Args)]
struct SubmissionArguments {
    /// For instructors: grade the stages in DIR, each among the reference's other stages.
    #[arg(long, value_name = "DIR")]
    submission: Option<OsString>,
    /// For instructors: grade every folder in DIR as a submission.
    #[arg(long, value_name = "DIR")]
    class: Option<OsString>,
    /// Also grade all of a submission's stages linked together.
    #[arg(long)]
    together: bool,
    /// Where a class's reports and summary.csv go.
    #[arg(long, value_name = "DIR")]
    out: Option<OsString>,
}

impl SubmissionArguments {
    fn is_any(&self) -> bool {
        self.submission.is_some() || self.class.is_some() || self.together || self.out.is_some()
    }
}

/// How to print a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people.
    Table,
    /// One JSON object.
    Json,
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

/// Reads the seed of random probes.
pub fn seed(value: &str) -> Result<u64, String> {
    whole_number(value, 0, u64::MAX)
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

/// Runs the program `grader`.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    end(|| run(cli))
}

fn run(cli: Cli) -> Result<Verdict, GraderError> {
    let given = || std::env::args_os().skip(1).collect();
    let named = |name: &str, rest: Rest| {
        let mut arguments = vec![OsString::from(name)];
        arguments.extend(rest.arguments);
        arguments
    };
    match (cli.command, cli.grade) {
        (Some(Command::Cost(rest)), _) => sister::run("cost", rest.arguments),
        (Some(Command::Bless(rest)), _) => sister::run("review", named("bless", rest)),
        (Some(Command::Review(rest)), _) => sister::run("review", named("review", rest)),
        (Some(Command::Handout(rest)), _) => sister::run("authoring", named("handout", rest)),
        (Some(Command::Course(rest)), _) => sister::run("authoring", named("course", rest)),
        (Some(Command::Mutants(rest)), _) => sister::run("authoring", named("mutants", rest)),
        (None, Some(_)) if cli.submission.is_any() => sister::run("submission", given()),
        (None, Some(grade)) => grade.run(),
        (None, None) => Err(GraderError::new(
            "no task is named. Run `grader part1`, or `grader --help` for all commands",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_that_is_not_a_whole_number_is_refused() {
        for line in ["grader part1 --seed x", "grader part1 --seed -1"] {
            let refused = Cli::try_parse_from(line.split(' ')).err();
            let message = refused.expect("this line is refused").to_string();
            let allowed = "give a whole number from 0 to";
            assert!(message.contains(allowed), "`{line}`:\n{message}");
            assert!(!message.contains("-- -1"), "`{line}`:\n{message}");
        }
    }

    #[test]
    fn two_tasks_at_once_are_refused() {
        let cli = Cli::try_parse_from(["grader", "part1", "part2"]).expect("it is parsed");
        let refused = run(cli).expect_err("and refused").to_string();
        assert!(
            refused.contains("one at a time: `grader part1`, then `grader part2`"),
            "{refused}"
        );
    }

    #[test]
    fn a_command_takes_its_arguments_as_they_are() {
        let line = ["grader", "cost", "--help", "box", "--seed", "-1"];
        let cli = Cli::try_parse_from(line).expect("it is parsed");
        let Some(Command::Cost(rest)) = cli.command else {
            panic!("another command");
        };
        assert_eq!(rest.arguments, line[2..]);
    }
}
