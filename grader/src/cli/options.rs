//! Options that several commands have.

use super::course_systems;
use base::program::whole_number;
use clap::{Arg, ArgMatches};

/// How to print a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A table and explanations, for people.
    Table,
    /// One JSON object, for programs.
    Json,
}

impl Format {
    /// The option `--format`.
    pub fn argument() -> Arg {
        Arg::new("format")
            .long("format")
            .help("How to print the report: `table`, or `json` for programs")
            .value_parser(Format::NAMES)
            .default_value("table")
    }

    /// The option `--format` of a command that also prints the formats of course systems.
    pub fn argument_with_course_systems() -> Arg {
        let names = Format::NAMES.into_iter().chain(course_systems::FORMATS);
        Format::argument().value_parser(names.collect::<Vec<_>>())
    }

    const NAMES: [&str; 2] = ["table", "json"];

    /// Reads the option that [`Format::argument`] defines.
    pub fn of(matches: &ArgMatches) -> Format {
        match matches.get_one::<String>("format").map(String::as_str) {
            Some("json") => Format::Json,
            _ => Format::Table,
        }
    }
}

/// The option `--seed`.
pub fn seed_argument() -> Arg {
    Arg::new("seed")
        .long("seed")
        .value_name("SEED")
        .help("Seed of the random inputs, such as rays. A seed other than 0 also moves all other inputs by exact symmetries, as an instructor's run does")
        .value_parser(|value: &str| whole_number(value, 0, u64::MAX))
        .default_value("0")
        .allow_negative_numbers(true)
}

/// Reads the option that [`seed_argument`] defines.
pub fn seed_of(matches: &ArgMatches) -> u64 {
    matches.get_one("seed").copied().unwrap_or(0)
}
