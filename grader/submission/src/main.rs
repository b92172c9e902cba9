//! The command `grader part2 --submission DIR`: grades what a student handed in.

mod course_systems;

use base::program::{self, Exit};
use base::{GraderError, Workspace, out, outln, shell_word};
use clap::ArgMatches;
use grader::cli::Format;
use grader::cli::course_systems::is_requested;
use grader::cli::grade::hint;
use grader::course::Course;
use grader::report::{self, HintLevel, Reveal, table};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use submission::arguments::{containment, seeded_request};
use submission::clean_workspace::CleanWorkspace;
use submission::one::Options;
use submission::{Layout, SubmissionReport, read, shown};

fn main() -> ExitCode {
    let command = |hint| {
        formats::command::command(hint)
            .about("Grades what students handed in, in a clean copy of the course")
    };
    let matches = program::arguments_of(command(HintLevel::Remedy));
    if !is_requested(&matches) {
        return program::run_to_exit_code(|| run(&matches));
    }
    // Students read these files.
    let matches = program::arguments_of(command(HintLevel::Findings));
    program::run_to_exit_code(|| {
        formats::command::run(&matches, || course_systems::grade(&matches))
    })
}

/// How many ignored files are named. The others are only counted.
const IGNORED_NAMED: usize = 20;

fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    grade_one(matches, &workspace, folder(matches)?)
}

/// The folder of the submission.
fn folder(matches: &ArgMatches) -> Result<&Path, GraderError> {
    let folder = |name| matches.get_one::<PathBuf>(name);
    match (folder("submission"), folder("class")) {
        (Some(folder), _) => Ok(folder),
        (None, Some(folder)) => Err(moved(matches, folder)),
        (None, None) => Err(GraderError::new(
            "`--together` needs a submission: add `--submission DIR`",
        )),
    }
}

fn grade_one(
    matches: &ArgMatches,
    workspace: &Workspace,
    folder: &Path,
) -> Result<Exit, GraderError> {
    let options = Options {
        request: seeded_request(matches)?,
        together: matches.get_flag("together"),
        pictures: false,
    };
    let course = Course::read(workspace)?;
    course.select(&options.request.what)?;
    let submission = read::Submission::read(folder, &course, workspace.root())?;
    let clean = CleanWorkspace::open(workspace, containment(matches, workspace)?)?;
    let report = SubmissionReport::of(&submission, workspace, &clean, &options)?;
    let json = report::json(&report)?;
    base::write_whole(&workspace.root().join("report.json"), json.as_bytes())?;
    match Format::of(matches) {
        Format::Json => outln!("{json}"),
        Format::Table => out!("{}", show(&report, hint(matches))),
    }
    Ok(if report.scores.is_full() {
        Exit::Passed
    } else {
        Exit::Failed
    })
}

/// What to run instead of `grader part2 --class DIR`.
fn moved(matches: &ArgMatches, folder: &Path) -> GraderError {
    let what = matches.get_one::<String>("what").map(String::as_str);
    let part: Option<u32> = what
        .and_then(|what| what.strip_prefix("part"))
        .and_then(|number| number.parse().ok());
    let part = part.map_or_else(String::new, |number| format!(" --part {number}"));
    GraderError::new(format!(
        "a class is graded by a command of its own: run `grader class {} --out OUT{part}`",
        shell_word(folder)
    ))
}

/// Formats the report for people.
fn show(report: &SubmissionReport, hint: HintLevel) -> String {
    let mut text = String::new();
    let reveal = Reveal { hint, extra: true };
    if let Some(sentence) = report.about_changed_given() {
        let _ = writeln!(text, "{sentence}");
    }
    let ignored = report.other_ignored();
    if !ignored.is_empty() {
        let named = ignored.iter().take(IGNORED_NAMED);
        let _ = writeln!(
            text,
            "ignored files (only stages/<stage>/src/**/*.rs is graded):"
        );
        for name in named {
            let _ = writeln!(text, "  {name}");
        }
        let more = ignored.len().saturating_sub(IGNORED_NAMED);
        if more > 0 {
            let _ = writeln!(text, "  and {more} more");
        }
    }
    for stage in &report.missing {
        let _ = writeln!(text, "not handed in: stages/{stage}/src");
    }
    for sentence in &report.to_check {
        let _ = writeln!(text, "please look at {sentence}");
    }
    for sentence in &report.by_heart {
        let _ = writeln!(text, "{sentence}");
    }
    if !report.compiler.is_empty() {
        let _ = writeln!(text, "\n{}", report.compiler.trim_end());
    }
    if !report.printed.is_empty() {
        let _ = writeln!(text, "\n{}", report.printed.trim_end());
    }
    let _ = writeln!(text, "\ncontainment: {}", report.containment);
    let _ = writeln!(
        text,
        "seed: {0} (`--seed {0}` repeats this run)",
        report.seed
    );
    let _ = writeln!(
        text,
        "\nscores of each stage when the other stages are the reference's:\n{}",
        table::format_report(&report.scores, reveal)
    );
    if let Some(together) = &report.together {
        let _ = writeln!(
            text,
            "scores when all stages are the submission's:\n{}",
            table::format_report(together, reveal)
        );
    }
    // Messages of panics and names of files are the student's, too.
    shown(&text, Layout::Lines)
}
