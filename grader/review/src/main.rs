//! The program behind `grader review` and `grader bless`.

mod cli;

use base::program::{arguments_of, run_to_exit_code, subprogram_command};
use cli::{bless, review};
use std::process::ExitCode;

fn main() -> ExitCode {
    let commands = [review::command(), bless::command()];
    let matches = arguments_of(subprogram_command(commands));
    run_to_exit_code(|| match matches.subcommand() {
        Some(("bless", matches)) => bless::run(matches),
        Some((_, matches)) => review::run(matches),
        None => unreachable!("clap requires a command"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stored_help_is_that_of_the_commands() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        base::program::check_help(
            subprogram_command([review::command(), bless::command()]),
            folder,
        )
        .unwrap();
    }
}
