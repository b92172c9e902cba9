//! The program behind `grader review`, `grader bless` and `grader look`.

mod cli;

use base::program::{arguments_of, run_to_exit_code, subprogram_command};
use cli::look;
#[cfg(feature = "submissions")]
use cli::{bless, review};
use grader::cli::programs;
use std::process::ExitCode;

#[cfg(feature = "submissions")]
fn main() -> ExitCode {
    let commands = [review::command(), bless::command(), programs::look()];
    let matches = arguments_of(subprogram_command(commands));
    run_to_exit_code(|| match matches.subcommand() {
        Some(("bless", matches)) => bless::run(matches),
        Some(("look", matches)) => look::run(matches),
        Some((_, matches)) => review::run(matches),
        None => unreachable!("clap requires a command"),
    })
}

#[cfg(not(feature = "submissions"))]
fn main() -> ExitCode {
    let matches = arguments_of(subprogram_command([programs::look()]));
    run_to_exit_code(|| match matches.subcommand() {
        Some((_, matches)) => look::run(matches),
        None => unreachable!("clap requires a command"),
    })
}

#[cfg(all(test, feature = "submissions"))]
mod tests {
    use super::*;

    #[test]
    fn the_stored_help_is_that_of_the_commands() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        base::program::check_help(
            subprogram_command([review::command(), bless::command(), programs::look()]),
            folder,
        )
        .unwrap();
    }
}
