//! The program behind `grader class`.

use base::program::{arguments_of, run_to_exit_code, subprogram_command};
use std::process::ExitCode;

fn main() -> ExitCode {
    let matches = arguments_of(subprogram_command([class::cli::command()]));
    run_to_exit_code(|| match matches.subcommand() {
        Some((_, matches)) => class::cli::run(matches),
        None => unreachable!("clap requires a command"),
    })
}
