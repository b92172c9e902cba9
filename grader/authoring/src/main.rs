//! The program behind `grader course` and `grader mutants`.

mod cli;

use base::program::{Run, run_commands};
use clap::Command;
use cli::{course, mutants};
use std::process::ExitCode;

fn commands() -> [(Command, Run); 2] {
    [
        (course::command(), course::run),
        (mutants::command(), mutants::run),
    ]
}

fn main() -> ExitCode {
    run_commands(commands())
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::program::{check_help, subprogram_command};

    fn command() -> Command {
        subprogram_command(commands().map(|(command, _)| command))
    }

    #[test]
    fn the_stored_help_is_that_of_the_commands() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        check_help(command(), folder).unwrap();
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
