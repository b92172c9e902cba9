//! Handouts: the course as a student gets it.
//!
//! The handout of part N has the reference of the parts before N, holes from N on, and everything that it takes
//! to write and grade them. Read [`carve`] (one file), then `plan` (which files) and
//! [`Handout::carve`]; [`readme`] is what the student reads first.

pub mod carve;
pub mod place;
mod plan;
pub mod readme;

use carve::Knife;
use grader::course::Course;
use grader::error::GraderError;
use grader::workspace::Workspace;
use plan::Plan;
use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use submission::file_tree::{self, Files};
use submission::packages::members;
use submission::packages::{lock, manifest};

/// A carved course.
#[derive(Clone, Debug)]
pub struct Handout {
    /// Every file of it.
    pub files: Files,
    /// The solutions that were taken out.
    pub taken: Vec<Taken>,
    /// The files that hold a solution of a part before, which the student is given.
    pub solved: BTreeSet<PathBuf>,
}

/// A solution that was taken out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Taken {
    /// The file it stood in.
    pub path: PathBuf,
    /// The task that it solves.
    pub key: String,
    /// Its text.
    pub text: String,
}

impl Handout {
    /// Carves the parts from `part` on out of `workspace`.
    pub fn carve(workspace: &Workspace, part: u32) -> Result<Handout, GraderError> {
        let root = workspace.root();
        let course = Course::read(workspace)?;
        let knife = plan::knife(&course, part)?;
        let members = members::read(root)?;
        let plan = Plan::new(&members);
        let mut handout = Handout {
            files: Files::new(),
            taken: Vec::new(),
            solved: BTreeSet::new(),
        };
        for path in file_tree::workspace_paths(root)? {
            if plan.takes(&path) {
                let contents = file_tree::read(root, &path)?;
                handout.add(&plan, &knife, path, contents, root)?;
            }
        }
        if let Some(key) = knife.carved.iter().find(|key| !handout.has_taken(key)) {
            return Err(GraderError::new(format!(
                "there is no solution of {key} to carve out of {}. Is this a handout itself? Handouts are carved \
                 from the course's full checkout, and only from files that git knows",
                root.display()
            )));
        }
        handout.leave_out_tests(&plan)?;
        let readme = readme::write(&course, part, &handout.files)?;
        handout
            .files
            .insert("README.md".into(), readme.into_bytes());
        lock::remove_unused(&mut handout.files)?;
        Ok(handout)
    }

    /// Writes the handout to the new folder `out`, whole or not at all.
    pub fn write(&self, out: &Path) -> Result<(), GraderError> {
        let parent = match out.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let scratch = grader::interrupt::temp_folder_in(parent)?;
        let whole = scratch.path().join("handout");
        for (path, contents) in &self.files {
            file_tree::write(&whole.join(path), contents)?;
        }
        // Renaming onto an empty folder works on some systems only.
        let _ = std::fs::remove_dir(out);
        std::fs::rename(&whole, out).map_err(|e| GraderError::file("write", out, e))
    }

    fn has_taken(&self, key: &str) -> bool {
        self.taken.iter().any(|taken| taken.key == key)
    }

    /// Adds a file of the workspace, carved.
    fn add(
        &mut self,
        plan: &Plan,
        knife: &Knife,
        path: PathBuf,
        contents: Vec<u8>,
        root: &Path,
    ) -> Result<(), GraderError> {
        let is_rust = path.extension().is_some_and(|extension| extension == "rs");
        // The grader's own sources speak of markers, and solve nothing.
        if !is_rust || plan.owner(&path).is_none_or(plan::is_of_the_grader) {
            self.files.insert(path, contents);
            return Ok(());
        }
        let text = text(&path, contents)?;
        let is_marked = text.contains("// BEGIN SOLUTION(");
        let carved = knife.carve(&path.to_string_lossy(), &text)?;
        let text = if carved.taken.is_empty() || carved.text.is_empty() {
            carved.text
        } else {
            formatted(root, &path, &carved.text)?
        };
        if is_marked && carved.taken.is_empty() {
            self.solved.insert(path.clone());
        }
        let taken = carved.taken.into_iter().map(|(key, text)| Taken {
            path: path.clone(),
            key,
            text,
        });
        self.taken.extend(taken);
        if !text.is_empty() {
            self.files.insert(path, text.into_bytes());
        }
        Ok(())
    }

    /// Takes out the tests and benches of every crate that runs something carved: they would fail. Manifests follow.
    fn leave_out_tests(&mut self, plan: &Plan) -> Result<(), GraderError> {
        let owners = self
            .taken
            .iter()
            .filter_map(|taken| plan.owner(&taken.path));
        let carved: BTreeSet<&str> = owners.map(|owner| owner.name.as_str()).collect();
        let tests_holes = |path: &Path| {
            plan.owner(path)
                .is_some_and(|owner| plan.tests(owner, &carved))
        };
        self.files
            .retain(|path, _| !(plan.is_test(path) && tests_holes(path)));
        for (path, contents) in &mut self.files {
            if path.file_name().is_none_or(|name| name != "Cargo.toml") {
                continue;
            }
            let old = text(path, contents.clone())?;
            *contents = match plan.owner(path) {
                None => manifest::without_members(&old, &plan.left_out()),
                Some(_) if tests_holes(path) => manifest::without_tests(&old),
                Some(_) => old,
            }
            .into_bytes();
        }
        Ok(())
    }
}

fn text(path: &Path, contents: Vec<u8>) -> Result<String, GraderError> {
    String::from_utf8(contents)
        .map_err(|_| GraderError::new(format!("{} is not UTF-8", path.display())))
}

/// A carved file as rustfmt writes it: a stub may want other line breaks than its solution.
fn formatted(root: &Path, path: &Path, text: &str) -> Result<String, GraderError> {
    let failed = |e: &dyn std::fmt::Display| {
        GraderError::new(format!(
            "cannot format what carving left of {}: {e}. (rustfmt comes with `rustup component add rustfmt`.)",
            path.display()
        ))
    };
    let mut child = Command::new("rustfmt")
        .current_dir(root)
        .args(["--edition", "2024", "--emit", "stdout"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|e| failed(&e))?;
    if let Some(mut stdin) = child.stdin.take() {
        stdin.write_all(text.as_bytes()).map_err(|e| failed(&e))?;
    }
    let output = child.wait_with_output().map_err(|e| failed(&e))?;
    if !output.status.success() {
        return Err(failed(&String::from_utf8_lossy(&output.stderr).trim()));
    }
    String::from_utf8(output.stdout).map_err(|e| failed(&e))
}
