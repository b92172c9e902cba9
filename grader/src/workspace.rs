//! Where the course is: the workspace above the current folder.

use crate::error::GraderError;
use std::path::{Path, PathBuf};

/// A checkout or a handout of the course.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Workspace {
    root: PathBuf,
}

/// What marks the root of a workspace.
const COURSE: &str = "stages/course.toml";

impl Workspace {
    /// The nearest folder at or above `start` that holds `stages/course.toml`.
    pub fn above(start: &Path) -> Result<Workspace, GraderError> {
        let start = start
            .canonicalize()
            .map_err(|e| GraderError::file("open", start, e))?;
        let root = start
            .ancestors()
            .find(|folder| folder.join(COURSE).is_file());
        let root = root.ok_or_else(|| {
            GraderError::new(format!(
                "no course here: neither {} nor a folder above it holds {COURSE}. Run the grader from inside the course's folder",
                start.display()
            ))
        })?;
        Ok(Workspace {
            root: root.to_path_buf(),
        })
    }

    /// Its top folder.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Refuses a handout, for `work` that needs what only the course's full checkout has.
    pub fn ensure_full(&self, work: &str) -> Result<(), GraderError> {
        // The test of the goldens, and with it this manifest, is about the reference: no handout takes it.
        if self.root.join("golden/Cargo.toml").is_file() {
            return Ok(());
        }
        Err(GraderError::new(format!(
            "{} is a handout or a submission: {work}. Run this in the course's full checkout",
            self.root.display()
        )))
    }

    /// The course's list of parts and tasks.
    pub fn course_toml(&self) -> PathBuf {
        self.root.join(COURSE)
    }

    /// The snapshot of a case.
    pub fn snapshot(&self, task: &str, case: &str) -> PathBuf {
        self.root
            .join("golden")
            .join(task)
            .join(format!("{case}.snap"))
    }

    /// The golden picture of a case.
    pub fn golden_picture(&self, task: &str, case: &str) -> PathBuf {
        self.root
            .join("golden")
            .join(task)
            .join(format!("{case}.png"))
    }
}
