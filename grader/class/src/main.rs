//! The program behind `grader class`.

use base::program::{Exit, arguments_of, run_to_exit_code, subprogram_command};
use class::reading::process;
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut arguments = std::env::args_os().skip(1);
    if arguments
        .next()
        .is_some_and(|first| first == process::COMMAND)
    {
        return run_to_exit_code(|| process::run(arguments).map(|()| Exit::Passed));
    }
    let matches = arguments_of(subprogram_command([class::cli::command()]));
    run_to_exit_code(|| match matches.subcommand() {
        Some((_, matches)) => class::cli::run(matches),
        None => unreachable!("clap requires a command"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stored_help_is_that_of_the_commands() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        base::program::check_help(subprogram_command([class::cli::command()]), folder).unwrap();
    }
}
