//! The command `grader review`: writes the page for the reviewer.

use base::program::{Exit, path_argument};
use base::{GraderError, Workspace, folder_of, interrupt, outln, write_whole};
use clap::{Arg, ArgMatches, Command};
use grader::build::BuildRoot;
use grader::course::{Course, Task};
use grader::grade;
use review::{self, Author, page};
use std::path::{Path, PathBuf};
use submission::clean_workspace::CleanWorkspace;
use submission::containment::Containment;
use submission::read::Submission;

pub(crate) fn command() -> Command {
    Command::new("review")
        .about("For reviewers: writes an HTML page with every difference between the goldens and the code's results")
        .arg(
            Arg::new("what")
                .value_name("KEY")
                .num_args(1..)
                .default_value("all")
                .help("The goldens to review: `all`, parts such as `part1`, tasks such as `part1.task3`"),
        )
        .arg(
            path_argument("out", "FILE")
                .help("The file to write [default: target/review.html of the course]"),
        )
        .arg(
            path_argument("submission", "DIR")
                .help("Review the stages in DIR, each together with the reference's other stages"),
        )
}

pub(crate) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let tasks = tasks(matches, &course)?;
    let specs = grade::specs(&tasks, 0)?;
    review::check_goldens(&workspace, &tasks, &specs)?;
    let out = page_file(matches, &workspace)?;
    let (review, author) = match matches.get_one::<PathBuf>("submission") {
        None => {
            let workers = grade::workers(&BuildRoot::of(&workspace), &tasks, &specs, false)?;
            let mut review = review::Review::default();
            let author = Author::Reference;
            review.add(&workspace, &course, &tasks, &specs, &workers, &author)?;
            (review, author)
        }
        Some(folder) => {
            let submission = Submission::read(folder, &course, workspace.root())?;
            let containment = Containment::choose(&workspace, false)?;
            let clean = CleanWorkspace::open(&workspace, containment)?;
            let author = Author::Student(folder.display().to_string());
            let of = review::Review::of_submission;
            let review = of(
                &workspace,
                &course,
                &tasks,
                &specs,
                &submission,
                &clean,
                &author,
            )?;
            (review, author)
        }
    };
    write_whole(&out, page::write(&review, &author).as_bytes())?;
    outln!("{}: {}", out.display(), page::summary(&review));
    Ok(if review.is_same() {
        Exit::Passed
    } else {
        Exit::Failed
    })
}

/// The file to write. Checks before the review that it can be written.
fn page_file(matches: &ArgMatches, workspace: &Workspace) -> Result<PathBuf, GraderError> {
    let Some(out) = matches.get_one::<PathBuf>("out") else {
        let folder = workspace.root().join("target");
        std::fs::create_dir_all(&folder).map_err(|e| GraderError::file("create", &folder, e))?;
        return Ok(folder.join("review.html"));
    };
    if out.is_dir() {
        return Err(GraderError::new(format!(
            "cannot write the page to {}: it is a folder. Name a file in it",
            out.display()
        )));
    }
    interrupt::temp_folder_in(folder_of(out)?)?;
    Ok(out.clone())
}

/// The tasks that the keys select, in the order of the course.
fn tasks<'a>(matches: &ArgMatches, course: &'a Course) -> Result<Vec<&'a Task>, GraderError> {
    let mut keys = Vec::new();
    for what in matches.get_many::<String>("what").unwrap_or_default() {
        keys.extend(course.select(what)?.iter().map(|task| &task.key));
    }
    Ok(course
        .tasks()
        .filter(|task| keys.contains(&&task.key))
        .collect())
}
