//! The command `grader completions SHELL`.

use base::program::Exit;
use base::{GraderError, out};
use clap::{Arg, ArgMatches, Command, value_parser};
use clap_complete::{Shell, generate};

pub(super) fn command() -> Command {
    Command::new("completions")
        .about("Prints completions for a shell, and a shell function `grader` that runs `cargo grader`")
        .arg(
            Arg::new("shell")
                .value_name("SHELL")
                .required(true)
                .value_parser(value_parser!(Shell))
                .help("The shell; its start-up file must run what is printed"),
        )
}

pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let shell: Shell = *matches.get_one("shell").expect("clap requires it");
    out!("{}", script(shell));
    Ok(Exit::Passed)
}

/// The completions, after a function: a shell completes the words after one name, and `grader` is
/// shorter than `cargo grader`.
fn script(shell: Shell) -> String {
    let mut completions = Vec::new();
    generate(shell, &mut super::command(), "grader", &mut completions);
    let function = match shell {
        Shell::Fish => "function grader; cargo grader $argv; end\n",
        Shell::PowerShell => "function grader { cargo grader @args }\n",
        Shell::Elvish => "fn grader {|@arguments| cargo grader $@arguments }\n",
        _ => "grader() { cargo grader \"$@\"; }\n",
    };
    let completions = String::from_utf8_lossy(&completions);
    // zsh reads the first line when it looks for completions in files.
    match completions.split_once('\n') {
        Some((first, rest)) if first.starts_with("#compdef") => {
            format!("{first}\n{function}{rest}")
        }
        _ => format!("{function}{completions}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shell_completes_commands_and_flags() {
        for shell in [Shell::Bash, Shell::Zsh, Shell::Fish, Shell::PowerShell] {
            let script = script(shell);
            for word in ["watch", "status", "hint", "grader"] {
                assert!(script.contains(word), "{shell}: no {word}");
            }
            assert!(script.contains("cargo grader"), "{shell}");
        }
        assert!(script(Shell::Zsh).starts_with("#compdef grader\n"));
    }
}
