//! `grader part2 --submission DIR` and `grader part2 --class DIR --out DIR`: grades what was handed in.

use clap::{ArgMatches, Command};
use grader::cli::grade::{arguments, hint, request, submission_arguments};
use grader::cli::{self, Format, Verdict};
use grader::course::Course;
use grader::error::GraderError;
use grader::report;
use grader::report::table::{self, HintLevel};
use grader::workspace::Workspace;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use submission::job::Job;
use submission::{Judgement, class, read};

fn main() -> ExitCode {
    let command = arguments(Command::new("grader"))
        .args(submission_arguments())
        .about("Grades what was handed in, in a clean copy of the course")
        .after_help(cli::EXIT_CODES);
    let matches = command.get_matches();
    cli::run_to_exit_code(|| run(&matches))
}

/// Of many ignored files this many are named.
const IGNORED_NAMED: usize = 20;

fn run(matches: &ArgMatches) -> Result<Verdict, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let folder = |name| matches.get_one::<PathBuf>(name);
    match (folder("submission"), folder("class"), folder("out")) {
        (Some(folder), ..) => grade_one(matches, &workspace, folder),
        (None, Some(folder), Some(out)) => grade_class(matches, &workspace, folder, out),
        _ => Err(GraderError::new(
            "`--together` is for a submission: name it with `--submission DIR` or `--class DIR`",
        )),
    }
}

fn grade_one(
    matches: &ArgMatches,
    workspace: &Workspace,
    folder: &Path,
) -> Result<Verdict, GraderError> {
    let request = request(matches)?;
    let course = Course::read(workspace)?;
    course.select(&request.what)?;
    let submission = read::Submission::read(folder, &course, workspace.root())?;
    let job = Job::open(workspace)?;
    let judgement = Judgement::of(
        &submission,
        workspace,
        &job,
        &request,
        matches.get_flag("together"),
    )?;
    let json = report::json(&judgement)?;
    report::write_whole(&workspace.root().join("report.json"), json.as_bytes())?;
    match Format::of(matches) {
        Format::Json => println!("{json}"),
        Format::Table => print!("{}", show(&judgement, hint(matches))),
    }
    Ok(if judgement.report.is_full() {
        Verdict::Passed
    } else {
        Verdict::Failed
    })
}

fn grade_class(
    matches: &ArgMatches,
    workspace: &Workspace,
    folder: &Path,
    out: &Path,
) -> Result<Verdict, GraderError> {
    let text = |judgement: &Judgement| show(judgement, hint(matches));
    let request = request(matches)?;
    let summary = class::grade(
        workspace,
        folder,
        out,
        &request,
        matches.get_flag("together"),
        text,
    )?;
    println!(
        "{} submissions graded: {}",
        summary.graded,
        out.join("summary.csv").display()
    );
    for refused in &summary.refused {
        println!("not graded: {refused}");
    }
    Ok(if summary.refused.is_empty() {
        Verdict::Passed
    } else {
        Verdict::Failed
    })
}

/// A judgement for people.
fn show(judgement: &Judgement, hint: HintLevel) -> String {
    let mut text = String::new();
    if !judgement.ignored.is_empty() {
        let named = judgement.ignored.iter().take(IGNORED_NAMED);
        let _ = writeln!(
            text,
            "ignored, since a submission is stages/<stage>/src/**/*.rs alone:"
        );
        for name in named {
            let _ = writeln!(text, "  {name}");
        }
        let more = judgement.ignored.len().saturating_sub(IGNORED_NAMED);
        if more > 0 {
            let _ = writeln!(text, "  and {more} more");
        }
    }
    for stage in &judgement.missing {
        let _ = writeln!(text, "not handed in: stages/{stage}/src");
    }
    for place in &judgement.reaches_out {
        let _ = writeln!(
            text,
            "reaches for something outside its own code, so look at it: {place}"
        );
    }
    if !judgement.compiler.is_empty() {
        let _ = writeln!(text, "\n{}", judgement.compiler.trim_end());
    }
    if !judgement.printed.is_empty() {
        let _ = writeln!(
            text,
            "\nthe code printed:\n{}",
            judgement.printed.trim_end()
        );
    }
    let _ = writeln!(
        text,
        "\neach stage among the reference's:\n{}",
        table::format_report(&judgement.report, hint)
    );
    if let Some(together) = &judgement.together {
        let _ = writeln!(
            text,
            "all stages of the submission together:\n{}",
            table::format_report(together, hint)
        );
    }
    text
}
