//! `grader --help` lists the commands of a day, `grader help more` what else students use, `grader
//! help instructors` the rest.

use super::{Format, SUBPROGRAMS, course_systems, grade, programs, subprogram};
use crate::report::terminal::stdout_has_colours;
use base::program::{EXIT_CODES, Exit};
use base::{GraderError, out};
use clap::{Arg, ArgMatches, Command};
use std::ffi::OsString;

/// The name of the command.
pub(super) const NAME: &str = "help";

/// The topics that are not commands.
const MORE: &str = "more";
const INSTRUCTORS: &str = "instructors";

/// The programs beside the grader that students use.
const FOR_STUDENTS: [&str; 4] = ["start", "look", "cost", "speedup"];

/// The commands of a day, beside grading.
const DAILY: [&str; 5] = ["watch", "look", "hint", "book", "status"];

/// The options of a day.
const DAILY_OPTIONS: [&str; 5] = ["hint", "long", "extra", "case", "call"];

/// Older words for what another command does. They still work.
const OLDER: [&str; 4] = [super::picture::NAME, "predict", "gym", "examples"];

fn is_for_students(name: &str) -> bool {
    FOR_STUDENTS.contains(&name)
}

/// `whole` without what is not of a day.
pub(super) fn with_daily_commands(whole: Command) -> Command {
    let whole = whole.mut_subcommands(|command| {
        let is_daily = DAILY.contains(&command.get_name());
        command.hide(!is_daily)
    });
    whole.mut_args(|argument| {
        let is_daily =
            argument.is_positional() || DAILY_OPTIONS.contains(&argument.get_id().as_str());
        let is_hidden = argument.is_hide_set();
        argument.hide(is_hidden || !is_daily)
    })
}

/// The last lines of `grader --help`.
pub(super) fn after() -> String {
    format!(
        "{EXIT_CODES}\n\nMore commands and options: grader help more. For instructors: grader help instructors"
    )
}

pub(super) fn command() -> Command {
    Command::new(NAME)
        .about("Prints this message, or the help of a command")
        .arg(Arg::new("topic").value_name("COMMAND").help(
            "A command, `more` for the other commands, or `instructors` for those that they use",
        ))
}

/// The command that `word` is a misspelling of. Parts and tasks are not commands.
pub(super) fn command_like(word: &str) -> Option<String> {
    let whole = super::command();
    let names = whole.get_subcommands().map(Command::get_name);
    let likeness = |name: &str| strsim::damerau_levenshtein(word, name);
    let nearest = names.min_by_key(|name| likeness(name))?;
    let is_like = word.len() > 2 && likeness(nearest) <= MOST_SLIPS;
    is_like.then(|| nearest.to_owned())
}

/// The most slips in a misspelt command: letters left out, added, swapped or changed.
const MOST_SLIPS: usize = 2;

/// Prints the help of a command, of the whole program, or for instructors.
pub(super) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let mut whole = super::command();
    let mut named = match matches.get_one::<String>("topic").map(String::as_str) {
        None => whole,
        Some(MORE) => more(),
        Some(INSTRUCTORS) => for_instructors(),
        Some(name) => {
            let mut others = SUBPROGRAMS
                .iter()
                .filter(|(name, ..)| programs::of(name).is_none());
            if let Some((_, package, _)) = others.find(|(other, ..)| *other == name) {
                return subprogram::run(package, [name, "--help"].map(OsString::from).to_vec());
            }
            let known = whole.find_subcommand_mut(name).cloned();
            known.ok_or_else(|| {
                GraderError::new(format!(
                    "there is no command `{name}`. `grader --help` lists the commands, `grader help {INSTRUCTORS}` those for instructors"
                ))
            })?
        }
    };
    let help = named.render_help();
    match stdout_has_colours() {
        true => out!("{}", help.ansi()),
        false => out!("{help}"),
    }
    Ok(Exit::Passed)
}

/// The commands and options of students that are not of a day.
fn more() -> Command {
    let whole = super::all_commands();
    let is_more = |command: &&Command| {
        let name = command.get_name();
        let is_of_others =
            SUBPROGRAMS.iter().any(|(other, ..)| *other == name) && !is_for_students(name);
        !DAILY.contains(&name) && !OLDER.contains(&name) && !is_of_others
    };
    let commands: Vec<Command> = whole.get_subcommands().filter(is_more).cloned().collect();
    let is_of_more = |argument: &&Arg| {
        !argument.is_positional()
            && !argument.is_hide_set()
            && !DAILY_OPTIONS.contains(&argument.get_id().as_str())
    };
    let options: Vec<Arg> = whole.get_arguments().filter(is_of_more).cloned().collect();
    Command::new("grader")
        .bin_name("grader")
        .about("What students use besides the commands of a day. `grader help COMMAND` has more about a command")
        .override_usage("grader <COMMAND>\n       grader [WHAT] [OPTIONS]")
        .disable_help_flag(true)
        .disable_help_subcommand(true)
        .args(options)
        .subcommands(commands.into_iter().map(|command| command.hide(false)))
}

/// The commands and options that students do not need.
fn for_instructors() -> Command {
    let programs = SUBPROGRAMS
        .iter()
        .filter(|(name, ..)| !is_for_students(name));
    let programs = programs.map(|(name, _, about)| Command::new(*name).about(*about));
    Command::new("grader")
        .bin_name("grader")
        .about("What instructors and reviewers use. `grader help COMMAND` has more about a command")
        .override_usage("grader <COMMAND>\n       grader part1 --submission <DIR> [OPTIONS]")
        .disable_help_flag(true)
        .disable_help_subcommand(true)
        .args(grade::submission_arguments())
        .args(course_systems::arguments())
        .arg(Format::argument_with_course_systems())
        .after_help(EXIT_CODES)
        .subcommands(programs)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As wide as a terminal that is not the one of the tests.
    fn text(command: Command) -> String {
        command.term_width(100).render_help().to_string()
    }

    #[test]
    fn students_see_what_is_theirs_and_where_the_rest_is() {
        let help = text(crate::cli::command());
        let more = text(more());
        for theirs in ["watch", "look", "hint", "book", "status", "--hint"] {
            assert!(help.contains(&format!("  {theirs} ")), "{theirs}:\n{help}");
            assert!(
                !more.contains(&format!("\n  {theirs} ")),
                "{theirs}:\n{more}"
            );
        }
        for theirs in [
            "start", "explain", "practice", "solution", "cost", "speedup", "check",
        ] {
            assert!(more.contains(&format!("  {theirs} ")), "{theirs}:\n{more}");
            assert!(
                !help.contains(&format!("\n  {theirs} ")),
                "{theirs}:\n{help}"
            );
        }
        assert!(help.lines().count() < 40, "{help}");
        assert!(!help.contains("For instructors: c"), "{help}");
        for other in [
            "  gym",
            "  predict ",
            "mutants",
            "bless",
            "handout",
            "export",
            "--submission",
            "--write",
            "gradescope",
        ] {
            assert!(
                !help.contains(other) && !more.contains(other),
                "{other}:\n{help}{more}"
            );
        }
        assert!(
            help.contains("grader help instructors") && help.contains("grader help more"),
            "{help}"
        );
    }

    #[test]
    fn every_command_and_option_is_in_one_of_the_two() {
        let instructors = text(for_instructors());
        let both = format!(
            "{}{}{instructors}",
            text(crate::cli::command()),
            text(more())
        );
        for command in crate::cli::command().get_subcommands() {
            let name = command.get_name();
            let is_there = both.contains(&format!("  {name} "));
            assert!(is_there != OLDER.contains(&name), "{name}:\n{both}");
        }
        // An option that only says where it has moved to is in neither.
        let moved = grade::submission_arguments();
        let moved: Vec<_> = moved.iter().filter(|it| it.is_hide_set()).collect();
        for argument in crate::cli::command().get_arguments() {
            if moved.iter().any(|it| it.get_id() == argument.get_id()) {
                continue;
            }
            let Some(long) = argument.get_long() else {
                continue;
            };
            assert!(both.contains(&format!("--{long}")), "{long}:\n{both}");
        }
        assert!(instructors.contains("gradescope"), "{instructors}");
    }

    #[test]
    fn a_command_that_does_not_exist_is_an_error() {
        let matches = command().get_matches_from(["help", "mutant"]);
        let error = run(&matches).expect_err("there is none").to_string();
        assert!(error.contains("there is no command `mutant`"), "{error}");
    }
}
