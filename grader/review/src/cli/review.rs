//! `grader review`: the page that a reviewer looks at.

use clap::Args;
use grader::cli::Verdict;
use grader::course::{Course, Task};
use grader::error::GraderError;
use grader::grade::{self, BuildRoot};
use grader::interrupt;
use grader::report::write_whole;
use grader::workspace::Workspace;
use judge::cases;
use review::{self, Author, page};
use std::path::{Path, PathBuf};
use submission::job::Job;
use submission::read::Submission;

/// What to review.
#[derive(Args)]
pub(crate) struct Review {
    /// Whose goldens: `all`, parts such as `part1`, tasks such as `part1.task3`.
    #[arg(value_name = "KEY", default_value = "all")]
    what: Vec<String>,
    /// Where the page goes; if not said, target/review.html of the course.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Review the stages in DIR, each among the reference's other stages.
    #[arg(long, value_name = "DIR")]
    submission: Option<PathBuf>,
}

impl Review {
    pub(crate) fn run(&self) -> Result<Verdict, GraderError> {
        let workspace = Workspace::above(Path::new("."))?;
        let course = Course::read(&workspace)?;
        let tasks = self.tasks(&course)?;
        let specs = cases::all(0);
        review::check_goldens(&workspace, &tasks, &specs)?;
        let out = self.out(&workspace)?;
        let (review, author) = match &self.submission {
            None => {
                let workers = grade::workers(&BuildRoot::of(&workspace), &tasks, &specs, false)?;
                let mut review = review::Review::default();
                let author = Author::Reference;
                review.add(&workspace, &course, &tasks, &specs, &workers, &author)?;
                (review, author)
            }
            Some(folder) => {
                let submission = Submission::read(folder, &course, workspace.root())?;
                let job = Job::open(&workspace)?;
                let author = Author::Student(folder.display().to_string());
                let of = review::Review::of_submission;
                let review = of(
                    &workspace,
                    &course,
                    &tasks,
                    &specs,
                    &submission,
                    &job,
                    &author,
                )?;
                (review, author)
            }
        };
        write_whole(&out, page::write(&review, &author)?.as_bytes())?;
        println!("{}: {}", out.display(), page::verdict(&review));
        Ok(if review.is_same() {
            Verdict::Full
        } else {
            Verdict::Short
        })
    }

    /// Where the page goes. That nothing can be written there is found out before the work, not after.
    fn out(&self, workspace: &Workspace) -> Result<PathBuf, GraderError> {
        let Some(out) = &self.out else {
            let folder = workspace.root().join("target");
            std::fs::create_dir_all(&folder).map_err(|e| GraderError::file("make", &folder, e))?;
            return Ok(folder.join("review.html"));
        };
        if out.is_dir() {
            return Err(GraderError::new(format!(
                "cannot write the page to {}: it is a folder. Name a file in it",
                out.display()
            )));
        }
        let folder = out.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        if !folder.is_dir() {
            return Err(GraderError::new(format!(
                "cannot write the page to {}: there is no folder {}. Make it first",
                out.display(),
                folder.display()
            )));
        }
        interrupt::scratch_in(folder)?;
        Ok(out.clone())
    }

    /// The tasks that the keys name, in the course's order.
    fn tasks<'a>(&self, course: &'a Course) -> Result<Vec<&'a Task>, GraderError> {
        let mut keys = Vec::new();
        for what in &self.what {
            keys.extend(course.select(what)?.iter().map(|task| &task.key));
        }
        Ok(course
            .tasks()
            .filter(|task| keys.contains(&&task.key))
            .collect())
    }
}
