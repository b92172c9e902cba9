//! The program behind `grader handout`, `grader course` and `grader mutants`.

mod cli;

use clap::{Parser, Subcommand};
use grader::cli::{EXIT_CODES, end};
use std::process::ExitCode;

/// For authors of the course.
#[derive(Parser)]
#[command(name = "grader", version, after_help = EXIT_CODES)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Carves the project that a student is given.
    Handout(cli::handout::Arguments),
    /// Checks the course itself.
    #[command(subcommand)]
    Course(cli::course::Course),
    /// Grades typical mistakes, which must lose points, and correct variants, which must not.
    Mutants(cli::mutants::Mutants),
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    end(|| match cli.command {
        Command::Handout(handout) => handout.run(),
        Command::Course(course) => course.run(),
        Command::Mutants(mutants) => mutants.run(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_that_cannot_be_used_are_refused_with_those_that_can() {
        for (line, allowed) in [
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
            let refused = Cli::try_parse_from(line.split(' ')).err();
            let message = refused.expect("this line is refused").to_string();
            assert!(message.contains(allowed), "`{line}`:\n{message}");
            assert!(!message.contains("-- -1"), "`{line}`:\n{message}");
        }
    }
}
