//! The program behind `grader look`: writes a page for students and opens it.

use base::program::{Exit, run_commands};
use base::{GraderError, Workspace, browser, outln, write_whole};
use clap::ArgMatches;
use grader::build::BuildRoot;
use grader::cli::picture::task_of;
use grader::cli::programs;
use grader::course::Course;
use grader::grade;
use grader::grade::picture::file_stem;
use look::{Look, student_page};
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    run_commands([(programs::look(), run)])
}

fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let task = task_of(matches, &workspace, &course)?;
    let specs = grade::specs(&[task], 0)?;
    let workers = grade::workers(&BuildRoot::of(&workspace), &[task], &specs, false)?;
    let look = Look::of(&workspace, &course, task, &specs, &workers)?;
    let out = workspace.for_students(&format!("{}.html", file_stem(&task.key)))?;
    write_whole(&out, student_page::write(&look).as_bytes())?;
    outln!("{}: {}", task.key, student_page::summary(&look));
    outln!("page: {}", workspace.relative(&out).display());
    if !matches.get_flag("no-open") && !browser::open(&out) {
        outln!("(found no browser here: open the page yourself)");
    }
    Ok(if look.is_full() {
        Exit::Passed
    } else {
        Exit::Failed
    })
}
