//! The command `grader class`.

mod alike;
mod engines;
mod marks;
mod run;

pub use run::run;

use crate::reading::intake::Revision;
use crate::roster::table::System;
use base::program::whole_number;
use clap::{Arg, ArgAction, Command, value_parser};
use judge::cases::KNOWN_SEED;
use std::path::PathBuf;

/// The command line.
pub fn command() -> Command {
    let flag = |name: &'static str, help: &'static str| {
        Arg::new(name)
            .long(name)
            .action(ArgAction::SetTrue)
            .help(help)
    };
    let folder = |name: &'static str| {
        Arg::new(name)
            .value_name("DIR")
            .value_parser(value_parser!(PathBuf))
    };
    Command::new("class")
        .about("For instructors: grades a folder of submissions; what is graded already is not graded again")
        .after_help("Exit code: 0 if every submission has a score, 1 if something is yours to decide, 2 if one has none because the grader failed or has not finished.")
        .arg(folder("class").required_unless_present("collect").help(
            "The folder of the class: one folder, zip or tar file, or git clone per submission",
        ))
        .arg(
            folder("out")
                .long("out")
                .value_name("OUT")
                .required(true)
                .help("The folder for gradebook.csv, class.html, students/ and the results of all units; your own by_hand.csv there gives points and words by hand"),
        )
        .arg(
            Arg::new("part")
                .long("part")
                .value_name("N")
                .value_parser(|value: &str| whole_number(value, 1_u32, 99))
                .help("The part to grade; all parts without it"),
        )
        .arg(
            Arg::new("jobs")
                .long("jobs")
                .short('j')
                .value_name("J")
                .value_parser(|value: &str| whole_number(value, 1_usize, 1024))
                .help("How many submissions to grade at a time; as many as there are processors without it"),
        )
        .arg(
            Arg::new("seed")
                .long("seed")
                .value_name("SEED")
                .value_parser(drawn_seed)
                .allow_negative_numbers(true)
                .help("Seed of the random inputs; without it one is drawn for the class and kept in OUT"),
        )
        .arg(
            Arg::new("hint")
                .long("hint")
                .value_name("LEVEL")
                .value_parser(["1", "2", "3", "4"])
                .default_value("2")
                .help("How much the students' pages reveal, as `grader part1 --hint`"),
        )
        .arg(
            Arg::new("commit")
                .long("commit")
                .value_name("NAME")
                .conflicts_with("before")
                .help("Grade this commit, tag or branch of each git clone"),
        )
        .arg(
            Arg::new("before")
                .long("before")
                .value_name("TIME")
                .value_parser(Revision::before)
                .help("Grade the last commit of each git clone before this time, such as \"2026-11-20 18:00\""),
        )
        .arg(flag("with-archives", "With --before or --commit: grade what is no clone as it lies there, instead of asking"))
        .arg(flag("zero-unreadable", "Give 0 points to what could not be read, instead of asking"))
        .arg(
            Arg::new("shard")
                .long("shard")
                .value_name("I/N")
                .value_parser(engines::Shard::parse)
                .help("Grade only part I of N, counted from 1; `--collect` makes the tables when all are done"),
        )
        .arg(flag("list", "Print a command for each submission that is not graded yet, and grade none").conflicts_with("shard"))
        .arg(flag("collect", "Make the tables of what is graded, and grade none").conflicts_with_all(["shard", "list"]))
        .arg(flag("alike", "Compare the code of all submissions, and grade none: writes OUT/alike.html and alike.csv, and OUT/jplag for the program JPlag").conflicts_with_all(["shard", "list", "collect", "regrade"]))
        .arg(flag("regrade", "Grade again what changed since, and show old and new scores; `--yes` replaces them"))
        .arg(flag("yes", "With --regrade: replace the old scores").requires("regrade"))
        .arg(flag(
            "unsandboxed",
            "Grade submissions where they cannot be contained: their code has all your rights",
        ))
        .arg(
            Arg::new("roster")
                .long("roster")
                .value_name("ROSTER")
                .value_parser(value_parser!(PathBuf))
                .help("The students, as the course system exports them (CSV): finds out whose each submission is; a column `team` names who hand in together"),
        )
        .arg(
            Arg::new("for")
                .long("for")
                .value_name("SYSTEM")
                .value_parser(System::ALL.map(System::name))
                .requires("roster")
                .help("Also write the marks as this course system imports them, to OUT"),
        )
        .arg(
            Arg::new("assignment")
                .long("assignment")
                .value_name("NAME")
                .requires("roster")
                .help("The assignment's name in the course system, for Canvas with its number: \"Part 1 (1234)\""),
        )
        .arg(flag("add-extra", "With --roster: add extra credit to the marks").requires("roster"))
        .arg(Arg::new("unit").long("unit").value_name("KEY").hide(true))
        .arg(flag("of-pool", "").hide(true))
        .arg(folder("launcher").long("launcher").hide(true))
        .arg(folder("course").long("course").hide(true))
}

/// Parses the seed of a class. Fails for [`KNOWN_SEED`], whose questions students have, and for
/// what is not a whole number.
fn drawn_seed(value: &str) -> Result<u64, String> {
    match whole_number(value, 0, u64::MAX)? {
        KNOWN_SEED => Err(format!(
            "students have the questions of seed {KNOWN_SEED}, so code could contain their answers: \
             choose another, or leave it out"
        )),
        seed => Ok(seed),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_seed_that_students_have_is_refused() {
        assert_eq!(drawn_seed("1"), Ok(1));
        assert!(drawn_seed("-1").is_err());
        let refused = drawn_seed("0").unwrap_err();
        assert!(refused.contains("students have the questions"), "{refused}");
    }
}
