//! The program behind `grader class`.

use base::program::{Exit, run_commands, run_to_exit_code};
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
    run_commands([(class::cli::command(), class::cli::run)])
}

#[cfg(test)]
mod tests {
    use base::program::{check_help, subprogram_command};

    #[test]
    fn the_stored_help_is_that_of_the_commands() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        check_help(subprogram_command([class::cli::command()]), folder).unwrap();
    }
}
