//! The workspace of the course: its root folder and the paths of its files.

use crate::{GraderError, VERSION, term};
use std::path::{Path, PathBuf};

/// A checkout or a handout of the course.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Workspace {
    root: PathBuf,
}

/// The file that marks the root folder of a workspace.
const COURSE: &str = "stages/course.toml";

impl Workspace {
    /// The nearest folder at or above `start` that contains `stages/course.toml`, or the copy of
    /// the course in the folder of a [`term`]. Fails if the teacher's files changed since they were
    /// applied to the copy.
    pub fn above(start: &Path) -> Result<Workspace, GraderError> {
        let workspace = Workspace::above_as_it_is(start)?;
        if let Some(folder) = workspace.term_folder() {
            term::ensure_applied(folder)?;
        }
        Ok(workspace)
    }

    /// The same, whether or not the teacher's files were applied.
    pub fn above_as_it_is(start: &Path) -> Result<Workspace, GraderError> {
        let start = start
            .canonicalize()
            .map_err(|e| GraderError::file("open", start, e))?;
        let root = start.ancestors().find_map(|folder| {
            let copy = folder.join(term::COPY);
            let is_course = |folder: &PathBuf| folder.join(COURSE).is_file();
            [folder.to_path_buf(), copy].into_iter().find(is_course)
        });
        let root = root.ok_or_else(|| {
            GraderError::new(format!(
                "no course found: neither {} nor a folder above it contains {COURSE}. Run the grader inside the course's folder",
                start.display()
            ))
        })?;
        let workspace = Workspace { root };
        workspace.ensure_version(VERSION)?;
        Ok(workspace)
    }

    /// The folder of the [`term`] that this is the copy of First Light in, if it is one.
    pub fn term_folder(&self) -> Option<&Path> {
        let is_copy = self.root.file_name().is_some_and(|name| name == term::COPY);
        let folder = self.root.parent().filter(|_| is_copy)?;
        folder.join(term::FILES[0]).is_file().then_some(folder)
    }

    /// The workspace whose root folder is `root`, of any version of the course.
    pub fn of_any_version(root: &Path) -> Result<Workspace, GraderError> {
        let root = root
            .canonicalize()
            .map_err(|e| GraderError::file("open", root, e))?;
        match root.join(COURSE).is_file() {
            true => Ok(Workspace { root }),
            false => Err(GraderError::new(format!(
                "{} is no version of the course: it has no {COURSE}. Name the top folder of a checkout or of a handout",
                root.display()
            ))),
        }
    }

    /// The version of the course that its manifest names; `None` if it names none.
    pub fn version(&self) -> Option<String> {
        let manifest = std::fs::read_to_string(self.root.join("Cargo.toml")).ok()?;
        let (_, package) = manifest.split_once("[workspace.package]\n")?;
        let line = package
            .lines()
            .take_while(|line| !line.starts_with('['))
            .find_map(|line| line.strip_prefix("version = "))?;
        Some(line.trim().trim_matches('"').to_string())
    }

    /// Fails if this is another version of the course than that of the program, `ours`: cases,
    /// points and answers may differ.
    fn ensure_version(&self, ours: &str) -> Result<(), GraderError> {
        match self.version() {
            Some(theirs) if theirs != ours => Err(GraderError::new(format!(
                "{} is version {theirs} of the course, this grader is version {ours}. Use the grader of that folder: run `cargo grader` there",
                self.root.display()
            ))),
            _ => Ok(()),
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_term_is_refused_until_its_files_are_applied() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let root = folder.path().canonicalize().expect("it exists");
        let copy = root.join(term::COPY);
        std::fs::create_dir_all(copy.join("stages")).expect("a folder");
        std::fs::create_dir_all(root.join("submissions/ada")).expect("a folder");
        std::fs::write(copy.join(COURSE), "").expect("a file");
        std::fs::write(root.join("course.toml"), "name = 1").expect("a file");
        let below = root.join("submissions/ada");
        let found = Workspace::above_as_it_is(&below).expect("a course");
        assert_eq!(found.root(), copy);
        assert_eq!(found.term_folder(), Some(root.as_path()));
        let error = Workspace::above(&below)
            .expect_err("nothing is applied")
            .to_string();
        assert!(error.contains("course.toml changed since"), "{error}");
        std::fs::create_dir_all(root.join(term::APPLIED)).expect("a folder");
        std::fs::write(root.join(term::APPLIED).join("course.toml"), "name = 1").expect("a file");
        assert_eq!(
            Workspace::above(&below).expect("it is applied").root(),
            copy
        );
        std::fs::write(root.join("front.md"), "Welcome").expect("a file");
        assert!(Workspace::above(&below).is_err());
    }

    #[test]
    fn a_course_of_another_version_is_refused() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let root = folder.path();
        std::fs::create_dir_all(root.join("stages")).expect("a folder");
        std::fs::write(root.join(COURSE), "").expect("a file");
        let of_version = |version: &str| {
            let manifest = format!(
                "[workspace]\nmembers = []\n\n[workspace.package]\nedition = \"2024\"\nversion = \"{version}\"\n"
            );
            std::fs::write(root.join("Cargo.toml"), manifest).expect("a file");
            Workspace::above(&root.join("stages"))
        };
        let same = of_version(VERSION).expect("the same version");
        assert_eq!(same.version().as_deref(), Some(VERSION));
        let error = of_version("99.1.0")
            .expect_err("another version")
            .to_string();
        let expected = format!("is version 99.1.0 of the course, this grader is version {VERSION}");
        assert!(error.contains(&expected), "{error}");
        let other = Workspace::of_any_version(root).expect("any version");
        assert_eq!(other.version().as_deref(), Some("99.1.0"));
        // Only a root folder, not a folder below one.
        let error = Workspace::of_any_version(&root.join("stages")).expect_err("no root");
        assert!(
            error.to_string().contains("no version of the course"),
            "{error}"
        );
    }
}
