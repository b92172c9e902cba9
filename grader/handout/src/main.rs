//! The program behind `grader start` and `grader handout`.

mod cli;

use base::program::{Run, run_commands};
use clap::Command;
use cli::{handout, start};
use std::process::ExitCode;

fn commands() -> [(Command, Run); 2] {
    [
        (start::command(), start::run),
        (handout::command(), handout::run),
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
    fn usage_names_the_command_that_was_typed() {
        let error = command().try_get_matches_from(["target/release/handout", "handout"]);
        let message = error.expect_err("options are missing").to_string();
        assert!(message.contains("Usage: grader handout "), "{message}");
    }

    #[test]
    fn errors_about_parts_name_the_accepted_values() {
        for line in [
            "grader handout --part x --out a",
            "grader handout --part -1 --out a",
            "grader handout --part 99999999999 --out a",
            "grader start a --part x",
        ] {
            let error = command().try_get_matches_from(line.split(' ')).err();
            let message = error.expect("the command line must be refused").to_string();
            let expected = "a part's number, such as 1";
            assert!(message.contains(expected), "`{line}`:\n{message}");
            // Not clap's own advice, to write `-- -1`.
            assert!(!message.contains("-- -1"), "`{line}`:\n{message}");
        }
    }
}
