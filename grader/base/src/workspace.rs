//! The workspace of the course: its root folder and the paths of its files.

use crate::GraderError;
use std::path::{Path, PathBuf};

/// A checkout or a handout of the course.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Workspace {
    root: PathBuf,
}

/// The file that marks the root folder of a workspace.
const COURSE: &str = "stages/course.toml";

impl Workspace {
    /// The nearest folder at or above `start` that contains `stages/course.toml`.
    pub fn above(start: &Path) -> Result<Workspace, GraderError> {
        let start = start
            .canonicalize()
            .map_err(|e| GraderError::file("open", start, e))?;
        let root = start
            .ancestors()
            .find(|folder| folder.join(COURSE).is_file());
        let root = root.ok_or_else(|| {
            GraderError::new(format!(
                "no course found: neither {} nor a folder above it contains {COURSE}. Run the grader inside the course's folder",
                start.display()
            ))
        })?;
        Ok(Workspace {
            root: root.to_path_buf(),
        })
    }

    /// The root folder.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Whether this is the course's full checkout, not a handout.
    pub fn is_full(&self) -> bool {
        // The test of the goldens tests the reference. So no handout contains its manifest.
        self.root.join("golden/Cargo.toml").is_file()
    }

    /// Returns an error with the reason `work` if this is a handout and not the course's full
    /// checkout.
    pub fn ensure_full(&self, work: &str) -> Result<(), GraderError> {
        if self.is_full() {
            return Ok(());
        }
        Err(GraderError::new(format!(
            "{} is a handout or a submission: {work}. Run this in the course's full checkout",
            self.root.display()
        )))
    }

    /// The path of the list of parts and tasks.
    pub fn course_toml(&self) -> PathBuf {
        self.root.join(COURSE)
    }

    /// The folder of what runs of the grader leave for students: results, tests, pictures.
    pub fn outputs(&self) -> PathBuf {
        self.root.join("target").join("first-light")
    }

    /// Creates the folder [`Workspace::outputs`] if it does not exist yet.
    pub fn create_outputs(&self) -> Result<(), GraderError> {
        let folder = self.outputs();
        std::fs::create_dir_all(&folder).map_err(|e| GraderError::file("create", &folder, e))
    }

    /// The path of the golden snapshot of a case.
    pub fn snapshot(&self, task: &str, case: &str) -> PathBuf {
        self.root
            .join("golden")
            .join(task)
            .join(format!("{case}.snap"))
    }

    /// The path of the golden picture of a case.
    pub fn golden_picture(&self, task: &str, case: &str) -> PathBuf {
        self.root
            .join("golden")
            .join(task)
            .join(format!("{case}.png"))
    }

    /// The path of the file `name` in `target/first-light`, the folder of what the grader writes
    /// for students. Creates the folder.
    pub fn for_students(&self, name: &str) -> Result<PathBuf, GraderError> {
        self.create_outputs()?;
        Ok(self.outputs().join(name))
    }

    /// `path` as seen from the current folder if it is below it, otherwise unchanged.
    pub fn relative<'a>(&self, path: &'a Path) -> &'a Path {
        match std::env::current_dir() {
            Ok(here) => path.strip_prefix(here).unwrap_or(path),
            Err(_) => path,
        }
    }

    /// The path of the list of what the oracle does not judge in the goldens of a task.
    pub fn not_judged(&self, task: &str) -> PathBuf {
        self.root.join("golden").join(task).join("not_judged.txt")
    }
}
