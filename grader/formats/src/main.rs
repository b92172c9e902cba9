//! The program that writes the formats of course systems about the project that it is called in.

use base::program::{arguments_of, run_to_exit_code};
use base::{GraderError, Workspace};
use formats::command::{command, notes, run};
use formats::{Graded, Outcome, annotation};
use grader::cli::grade::{hint, request};
use grader::course::{Course, sources};
use grader::grade::{self, GradeRequest};
use grader::report::{self, HintLevel, Reveal};
use grader::workers::printed;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let matches = arguments_of(command(HintLevel::Findings));
    run_to_exit_code(|| {
        run(&matches, || {
            let reveal = Reveal {
                hint: hint(&matches),
                extra: matches.get_flag("extra"),
            };
            in_place(
                &Workspace::above(Path::new("."))?,
                &request(&matches)?,
                reveal,
            )
        })
    })
}

fn in_place(
    workspace: &Workspace,
    request: &GradeRequest,
    reveal: Reveal,
) -> Result<Outcome, GraderError> {
    let course = Course::read(workspace)?;
    let graded = grade::in_place(workspace, request, false, true)?;
    let mut files = Vec::new();
    for stage in grade::stages(&course.select(&request.what)?) {
        files.extend(sources::read(workspace.root(), stage)?);
    }
    let json = report::json(&graded.report)?;
    base::write_whole(&workspace.root().join("report.json"), json.as_bytes())?;
    let notes = notes([&*graded.compiler, &printed::format(&graded.printed)]);
    Ok(Outcome::Graded(Box::new(Graded {
        what: request.what.clone(),
        annotations: annotation::all(&graded.report, &graded.compiler, &files, reveal),
        report: graded.report,
        json,
        reveal,
        notes,
    })))
}
