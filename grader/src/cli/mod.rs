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
use std::process::ExitCode;

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
