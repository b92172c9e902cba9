//! The program behind `grader review` and `grader bless`.

mod cli;

use cli::{bless, review};
use grader::cli::{run_to_exit_code, subprogram_command};
use std::process::ExitCode;

fn main() -> ExitCode {
    let matches = subprogram_command([review::command(), bless::command()]).get_matches();
    run_to_exit_code(|| match matches.subcommand() {
        Some(("bless", matches)) => bless::run(matches),
        Some((_, matches)) => review::run(matches),
        None => unreachable!("clap requires a command"),
    })
}
