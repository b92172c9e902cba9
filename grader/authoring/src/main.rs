//! The program behind `grader course` and `grader mutants`.

mod cli;

use base::program::{arguments_of, run_to_exit_code, subprogram_command};
use clap::Command;
use cli::{course, mutants};
use std::process::ExitCode;

fn command() -> Command {
    subprogram_command([course::command(), mutants::command()])
}

fn main() -> ExitCode {
    let matches = arguments_of(command());
    run_to_exit_code(|| match matches.subcommand() {
        Some(("course", matches)) => course::run(matches),
        Some((_, matches)) => mutants::run(matches),
        None => unreachable!("clap requires a command"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stored_help_is_that_of_the_commands() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        base::program::check_help(command(), folder).unwrap();
    }

    #[test]
    fn errors_about_numbers_name_the_accepted_values() {
        let line = ["grader", "mutants", "--seeds", "0"];
        let error = command().try_get_matches_from(line).err();
        let message = error.expect("the command line must be refused").to_string();
        let expected = "expected a whole number from 1 to";
        assert!(message.contains(expected), "{message}");
        // Not clap's own advice, to write `-- -1`.
        assert!(!message.contains("-- -1"), "{message}");
    }
}
