//! What every program has in common: its command line, and its exit codes.

use crate::files::folder_of;
use crate::{GraderError, VERSION, errln, interrupt};
use clap::error::{ContextKind, ErrorKind};
use clap::{Arg, ArgMatches, Command, value_parser};
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::str::FromStr;

/// The exit codes of every program of the grader, for `--help`.
pub const EXIT_CODES: &str = "Exit code: 0 if every core point is earned, 1 if points are lost, 2 after an error in the grader or its input.";

/// An option `--NAME` that takes the path of a file or a folder, as [`std::path::PathBuf`].
pub fn path_argument(name: &'static str, value_name: &'static str) -> Arg {
    Arg::new(name)
        .long(name)
        .value_name(value_name)
        .value_parser(value_parser!(PathBuf))
}

/// Fails if the folder of a file that one of these options names does not exist: before minutes of
/// work, not only when the file is written.
pub fn check_folders_of(matches: &ArgMatches, options: &[&str]) -> Result<(), GraderError> {
    let files = options
        .iter()
        .filter_map(|option| matches.get_one::<PathBuf>(option));
    for file in files {
        folder_of(file)?;
    }
    Ok(())
}

/// Parses a whole number in `min..=max`. The error names this range.
pub fn whole_number<T: FromStr + PartialOrd + Display>(
    value: &str,
    min: T,
    max: T,
) -> Result<T, String> {
    match value.parse() {
        Ok(number) if min <= number && number <= max => Ok(number),
        _ => Err(format!("expected a whole number from {min} to {max}")),
    }
}

/// The end of a run that met no error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Every core point was earned, or a check found no problem.
    Passed,
    /// Points were lost, or a check found a problem.
    Failed,
}

/// Runs `work` as a whole program and returns its exit code. Prints an error, if there is one, to
/// stderr. Ctrl-C also ends the child processes.
pub fn run_to_exit_code(work: impl FnOnce() -> Result<Exit, GraderError>) -> ExitCode {
    interrupt::install_handler();
    match work() {
        Ok(Exit::Passed) => ExitCode::SUCCESS,
        Ok(Exit::Failed) => ExitCode::from(1),
        Err(error) => {
            if !interrupt::was_interrupted() {
                errln!("error: {error}");
            }
            ExitCode::from(2)
        }
    }
}

/// What a command does.
pub type Run = fn(&ArgMatches) -> Result<Exit, GraderError>;

/// A program that implements some of the commands of `grader`: reads its arguments and runs the one
/// that they name.
pub fn run_commands<const N: usize>(commands: [(Command, Run); N]) -> ExitCode {
    let (commands, runs): (Vec<Command>, Vec<Run>) = commands.into_iter().unzip();
    let names: Vec<String> = commands.iter().map(|it| it.get_name().into()).collect();
    let matches = arguments_of(subprogram_command(commands));
    let named = matches.subcommand().and_then(|(name, rest)| {
        let at = names.iter().position(|known| known == name)?;
        Some((runs[at], rest))
    });
    let (run, rest) = named.expect("clap requires one of the commands");
    run_to_exit_code(|| run(rest))
}

/// The command line of a program that implements some of the commands of `grader`.
pub fn subprogram_command(commands: impl IntoIterator<Item = Command>) -> Command {
    Command::new("grader")
        // Not the name of the file, which nobody typed.
        .bin_name("grader")
        .version(VERSION)
        .subcommand_required(true)
        .after_help(EXIT_CODES)
        .subcommands(commands)
}

/// The name of the file, in the folder of a program's crate, with the help of its commands.
pub const HELP: &str = "help.txt";

/// The line in [`HELP`] above the help of a command, which is called with these words.
fn help_line(words: &[&str]) -> String {
    format!("$ grader {} --help\n", words.join(" "))
}

/// The help in the text of a [`HELP`] file of the command that `words` begin with.
pub fn help_in<'a>(text: &'a str, words: &[&str]) -> Option<&'a str> {
    let mut lengths = (1..=words.len()).rev();
    let (_, rest) = lengths.find_map(|length| text.split_once(&help_line(&words[..length])))?;
    Some(rest.split("\n$ grader ").next().unwrap_or(rest))
}

/// Compares the help of all commands of `command` with the file [`HELP`] in `folder`, from which it
/// is printed before the program is built. With `UPDATE_SNAPSHOTS=1` writes the file. For tests.
pub fn check_help(command: Command, folder: &Path) -> Result<(), String> {
    let mut command = command.term_width(100);
    command.build();
    let mut text = String::new();
    add_help(&command, &mut Vec::new(), &mut text);
    let path = folder.join(HELP);
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        std::fs::write(&path, &text).map_err(|e| e.to_string())?;
    }
    match std::fs::read_to_string(&path) {
        Ok(stored) if stored == text => Ok(()),
        _ => Err(format!(
            "{} is not the help of the commands: run this test with UPDATE_SNAPSHOTS=1",
            path.display()
        )),
    }
}

/// Appends the help of the commands of `command`, which is called with `words`.
fn add_help<'a>(command: &'a Command, words: &mut Vec<&'a str>, text: &mut String) {
    for sub in command.get_subcommands() {
        if sub.get_name() == "help" {
            continue;
        }
        words.push(sub.get_name());
        *text += &format!("{}{}\n", help_line(words), sub.clone().render_help());
        add_help(sub, words, text);
        words.pop();
    }
}

/// Reads the arguments of this process. After an error it prints a message and exits.
pub fn arguments_of(command: Command) -> ArgMatches {
    command
        .try_get_matches()
        .unwrap_or_else(|error| without_misleading_tip(error).exit())
}

/// `error` without clap's tip to write `-- -z` for an unknown flag `-z`: no part, task or folder is
/// called that.
fn without_misleading_tip(mut error: clap::Error) -> clap::Error {
    if error.kind() == ErrorKind::UnknownArgument {
        error.remove(ContextKind::Suggested);
    }
    error
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_help_of_the_longest_command_is_found() {
        let text = "$ grader course --help\nThe course\n\n$ grader course check --help\nChecks\n\n";
        let help = |words: &[&str]| help_in(text, words);
        assert_eq!(help(&["course", "part1"]), Some("The course\n"));
        assert_eq!(help(&["course", "check", "x"]), Some("Checks\n\n"));
        assert_eq!(help(&["mutants"]), None);
    }

    #[test]
    fn an_unknown_flag_is_not_taken_for_a_value() {
        let message = |line: &str| {
            let command = Command::new("grader").arg(path_argument("output", "FILE"));
            let error = command.try_get_matches_from(line.split(' ')).err();
            without_misleading_tip(error.expect("the command line must be refused")).to_string()
        };
        let unknown = message("grader -z");
        assert!(
            unknown.contains("unexpected argument '-z' found"),
            "{unknown}"
        );
        assert!(!unknown.contains("tip:"), "{unknown}");
        let misspelt = message("grader --outptu 3");
        assert!(
            misspelt.contains("a similar argument exists: '--output'"),
            "{misspelt}"
        );
    }
}
