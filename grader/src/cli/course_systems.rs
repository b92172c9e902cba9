//! The options for reports in the formats of course systems.
//!
//! They are handled by a program of its own, so that `grader part1` compiles nothing for them.

use clap::{Arg, ArgAction, ArgMatches};

/// The formats that `grader` itself does not print.
pub const FORMATS: [&str; 6] = [
    "gradescope",
    "classroom50",
    "prairielearn",
    "junit",
    "actions",
    "markdown",
];

/// The values of `--visibility`, as Gradescope calls them.
pub const VISIBILITIES: [&str; 4] = ["visible", "after_due_date", "after_published", "hidden"];

/// The options that say what the files of course systems contain, and where they are.
pub fn arguments() -> [Arg; 3] {
    [
        Arg::new("write")
            .long("write")
            .value_name("FORMAT=FILE")
            .action(ArgAction::Append)
            .help("Also write the report to FILE, in this format; may be repeated. A failure of the grader is written, too"),
        Arg::new("add-extra")
            .long("add-extra")
            .action(ArgAction::SetTrue)
            .help("Add extra credit to the total score of a course system, instead of only showing it"),
        Arg::new("visibility")
            .long("visibility")
            .value_name("WHEN")
            .value_parser(VISIBILITIES)
            .default_value(VISIBILITIES[0])
            .help("When students see the results, for gradescope"),
    ]
    .map(|argument| argument.help_heading("For instructors"))
}

/// Whether a report in one of these formats is asked for.
pub fn is_requested(matches: &ArgMatches) -> bool {
    let format = matches.get_one::<String>("format");
    matches.contains_id("write") || format.is_some_and(|name| FORMATS.contains(&name.as_str()))
}
