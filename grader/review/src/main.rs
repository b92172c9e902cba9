//! The program behind `grader review` and `grader bless`.

mod cli;

use base::program::run_commands;
use cli::{bless, review};
use std::process::ExitCode;

fn main() -> ExitCode {
    run_commands([
        (review::command(), review::run),
        (bless::command(), bless::run),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use base::program::{check_help, subprogram_command};

    #[test]
    fn the_stored_help_is_that_of_the_commands() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        let commands = [review::command(), bless::command()];
        check_help(subprogram_command(commands), folder).unwrap();
    }
}
