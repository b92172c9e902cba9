//! The command line: `grader part1`, and beside it subcommands, a file each.
//!
//! Each subcommand is a struct of arguments with a `run` that answers how the program ends.

mod bless;
mod cost;
mod course;
mod grade;
mod handout;
mod mutants;
mod review;
mod submission;

use crate::error::GraderError;
use crate::interrupt;
use clap::{Parser, Subcommand, ValueEnum};
use std::fmt::Display;
use std::process::ExitCode;
use std::str::FromStr;

/// Scores your ray tracer, stage by stage.
#[derive(Parser)]
#[command(
    name = "grader",
    version,
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "Exit code: 0 every core point, 1 points lost, 2 the grader or its input is at fault."
)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    grade: Option<grade::Grade>,
    #[command(flatten)]
    submission: submission::Submission,
}

#[derive(Subcommand)]
enum Command {
    /// Shows what accuracy costs in time: well-known kernels and yours, side by side.
    Cost(cost::Cost),
    /// For instructors: takes what the reference answers now as golden, after showing what that changes.
    Bless(bless::Bless),
    /// For reviewers: writes a page with every difference between the goldens and what the code answers now.
    Review(review::Review),
    /// For instructors: carves the project that a student is given.
    Handout(handout::Arguments),
    /// For instructors: looks after the course itself.
    #[command(subcommand)]
    Course(course::Course),
    /// For instructors: grades typical mistakes, which must lose points, and correct variants, which must not.
    Mutants(mutants::Mutants),
}

/// How to print a report.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum Format {
    Table,
    Json,
}

/// Reads a whole number from `least` up, and says so where it is none.
fn whole_number<T: FromStr + PartialOrd + Display>(
    value: &str,
    least: T,
    most: T,
) -> Result<T, String> {
    match value.parse() {
        Ok(number) if least <= number && number <= most => Ok(number),
        _ => Err(format!("give a whole number from {least} to {most}")),
    }
}

fn seed(value: &str) -> Result<u64, String> {
    whole_number(value, 0, u64::MAX)
}

/// How a run that came to its end ends the program.
enum Verdict {
    /// Every core point, or nothing to complain of.
    Full,
    /// Points were lost, or a check found something.
    Short,
}

/// Runs the program.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    interrupt::watch();
    match run(cli) {
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

fn run(cli: Cli) -> Result<Verdict, GraderError> {
    match (cli.command, cli.grade) {
        (Some(Command::Bless(bless)), _) => bless.run(),
        (Some(Command::Cost(cost)), _) => cost.run(),
        (Some(Command::Review(review)), _) => review.run(),
        (Some(Command::Handout(handout)), _) => handout.run(),
        (Some(Command::Course(course)), _) => course.run(),
        (Some(Command::Mutants(mutants)), _) => mutants.run(),
        (None, Some(grade)) => grade.run(&cli.submission),
        (None, None) => Err(GraderError::new(
            "say what to grade: `grader part1`, or `grader --help` for all there is",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(line: &str) -> String {
        let refused = Cli::try_parse_from(line.split(' ')).err();
        refused.expect("this line is refused").to_string()
    }

    #[test]
    fn numbers_that_cannot_be_used_say_what_is_allowed() {
        for (line, allowed) in [
            ("grader part1 --seed x", "give a whole number from 0 to"),
            ("grader part1 --seed -1", "give a whole number from 0 to"),
            ("grader cost --seed -1", "give a whole number from 0 to"),
            ("grader mutants --seeds 0", "give a whole number from 1 to"),
            (
                "grader handout --part x --out a",
                "a part's number, such as 1",
            ),
            (
                "grader handout --part -1 --out a",
                "a part's number, such as 1",
            ),
            (
                "grader handout --part 99999999999 --out a",
                "a part's number",
            ),
        ] {
            let told = refusal(line);
            assert!(told.contains(allowed), "`{line}` says:\n{told}");
            assert!(!told.contains("-- -1"), "a tip that cannot help:\n{told}");
        }
    }

    #[test]
    fn one_thing_is_graded_at_a_time() {
        let cli = Cli::try_parse_from(["grader", "part1", "part2"]).expect("it is understood");
        let refused = run(cli).err().expect("and refused").to_string();
        assert!(
            refused.contains("one at a time: `grader part1`, then `grader part2`"),
            "{refused}"
        );
    }
}
