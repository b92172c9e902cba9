//! The command `grader part1 --format FORMAT` and `grader part1 --write FORMAT=FILE`, for the
//! formats of course systems.

use crate::classroom50::Assignment;
use crate::settings::Visibility;
use crate::{Format, Graded, Outcome, Settings};
use base::program::{self, Exit};
use base::{GraderError, errln, interrupt, out, write_whole};
use clap::{Arg, ArgAction, ArgMatches, Command};
use grader::build::compile_errors;
use grader::cli::course_systems;
use grader::cli::grade::{arguments, submission_arguments};
use grader::report::{HintLevel, table};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::time::{SystemTime, UNIX_EPOCH};

/// What the files say while grading runs: a grader that is killed leaves this behind.
const UNFINISHED: &str = "Grading did not finish: the grader was stopped, or took more time or memory than the machine gives it.";

/// The command line. Without `--hint`, students read as much as `hint` says.
pub fn command(hint: HintLevel) -> Command {
    arguments(Command::new("grader"), hint)
        .args(submission_arguments())
        .args(course_systems::arguments())
        .arg(
            Arg::new("extra")
                .long("extra")
                .action(ArgAction::SetTrue)
                .help("Also show what extra credit lost, once every core case passes"),
        )
        .about("Grades, and reports in the formats of course systems")
        .after_help(program::EXIT_CODES)
}

/// A file to write.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Target {
    format: Format,
    path: PathBuf,
}

impl Target {
    /// Reads `FORMAT=FILE`.
    fn parse(text: &str) -> Result<Target, GraderError> {
        let names = || Format::ALL.map(Format::name).join(", ");
        let parts = text.split_once('=').filter(|(_, path)| !path.is_empty());
        let (name, path) = parts.ok_or_else(|| {
            GraderError::new(format!(
                "`--write {text}`: expected FORMAT=FILE, such as `--write junit=junit.xml`. The formats are {}",
                names()
            ))
        })?;
        let format = Format::named(name).ok_or_else(|| {
            let instead = match name {
                "csv" => ". `grader class` writes a gradebook, also of one submission",
                _ => "",
            };
            GraderError::new(format!(
                "`--write {text}`: there is no format {name:?}{instead}. The formats are {}",
                names()
            ))
        })?;
        Ok(Target {
            format,
            path: path.into(),
        })
    }
}

/// Grades with `grade`, and writes and prints what comes of it.
pub fn run(
    matches: &ArgMatches,
    grade: impl FnOnce() -> Result<Outcome, GraderError>,
) -> Result<Exit, GraderError> {
    let targets: Vec<Target> = matches
        .get_many::<String>("write")
        .unwrap_or_default()
        .map(|text| Target::parse(text))
        .collect::<Result<_, _>>()?;
    // `table` and `json` are not formats of course systems only: the report is printed in them.
    let printed = matches
        .get_one::<String>("format")
        .map_or("table", String::as_str);
    let settings = settings(matches);
    let formats = targets.iter().map(|target| target.format);
    for format in formats.chain(Format::named(printed)) {
        format.check(&settings)?;
    }
    write_all(
        &targets,
        &Outcome::Infrastructure(UNFINISHED.into()),
        &settings,
    )?;
    let mut outcome = attempt(grade);
    if interrupt::was_interrupted() {
        // Whatever failed last did so because it was ended.
        outcome = Outcome::Infrastructure(UNFINISHED.into());
    }
    write_all(&targets, &outcome, &settings)?;
    match (Format::named(printed), &outcome) {
        (Some(format), _) => out!("{}", format.write(&outcome, &settings)?),
        (None, Outcome::Graded(graded)) => out!("{}", report(graded)),
        (None, _) => {}
    }
    match outcome {
        Outcome::Graded(graded) if graded.report.is_full() => Ok(Exit::Passed),
        Outcome::Graded(_) => Ok(Exit::Failed),
        Outcome::Refused { why, .. } => {
            errln!("cannot be graded: {why}");
            Ok(Exit::Failed)
        }
        Outcome::Infrastructure(why) => Err(GraderError::new(why)),
    }
}

/// Grades with `grade`. A panic of the grader is a failure of the grader.
fn attempt(grade: impl FnOnce() -> Result<Outcome, GraderError>) -> Outcome {
    let failed = |why: GraderError| Outcome::Infrastructure(why.to_string());
    match catch_unwind(AssertUnwindSafe(grade)) {
        Ok(outcome) => outcome.unwrap_or_else(failed),
        Err(panic) => Outcome::Infrastructure(format!("the grader panicked: {}", message(&*panic))),
    }
}

fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("no message")
}

/// The report for people.
fn report(graded: &Graded) -> String {
    let table = table::format_report(&graded.report, graded.reveal);
    match graded.notes.is_empty() {
        true => table,
        false => format!("{}\n{table}", graded.notes),
    }
}

/// The [`Graded::notes`] of these texts: those that are not empty, with a blank line between them.
pub fn notes<const N: usize>(texts: [&str; N]) -> String {
    let texts = texts.map(compile_errors::plain);
    let texts: Vec<&str> = texts.iter().map(|text| text.trim_end()).collect();
    let texts: Vec<&str> = texts.into_iter().filter(|text| !text.is_empty()).collect();
    match texts.is_empty() {
        true => String::new(),
        false => format!("{}\n", texts.join("\n\n")),
    }
}

fn write_all(
    targets: &[Target],
    outcome: &Outcome,
    settings: &Settings,
) -> Result<(), GraderError> {
    for Target { format, path } in targets {
        write_whole(path, format.write(outcome, settings)?.as_bytes())?;
    }
    Ok(())
}

fn settings(matches: &ArgMatches) -> Settings {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let visibility = matches.get_one::<String>("visibility");
    Settings {
        add_extra: matches.get_flag("add-extra"),
        visibility: visibility
            .and_then(|name| Visibility::named(name))
            .unwrap_or_default(),
        assignment: Assignment::read(
            |name| std::env::var(name).ok(),
            now.map_or(0, |now| now.as_secs()),
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_valid_and_knows_every_format() {
        let command = || command(HintLevel::Findings);
        command().debug_assert();
        for format in Format::ALL {
            let line = ["grader", "part1", "--format", format.name()];
            assert!(command().try_get_matches_from(line).is_ok(), "{format:?}");
        }
        let visibilities = Visibility::ALL.map(Visibility::name);
        assert_eq!(visibilities, course_systems::VISIBILITIES);
    }

    #[test]
    fn a_file_has_a_format_and_a_path() {
        let target = Target::parse("junit=a=b.xml").expect("it has both");
        assert_eq!(target.format, Format::JUnit);
        assert_eq!(target.path, PathBuf::from("a=b.xml"));
        for (text, why) in [
            ("junit.xml", "expected FORMAT=FILE"),
            ("junit=", "expected FORMAT=FILE"),
            (
                "xunit=a.xml",
                "no format \"xunit\". The formats are gradescope",
            ),
            ("csv=a.csv", "\"csv\". `grader class` writes a gradebook"),
        ] {
            let error = Target::parse(text).expect_err(text).to_string();
            assert!(error.contains(why), "{error}");
        }
    }
}
