//! Handouts: the course as a student gets it.
//!
//! The handout of part N has the reference of the parts before N, holes from N on, and everything that it takes
//! to write and grade them. Read [`carve`] (one file), [`members`] and [`manifest`] (which crates come along),
//! then [`Handout::carve`]; [`readme`] is what the student reads first.

pub mod carve;
pub mod manifest;
pub mod members;
pub mod readme;

use crate::compile;
use crate::course::Course;
use crate::error::GraderError;
use crate::tree::{self, Files};
use crate::workspace::Workspace;
use carve::Knife;
use members::Member;
use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Component, Path, PathBuf};
use std::process::{Command, Stdio};

/// A carved course.
#[derive(Clone, Debug)]
pub struct Handout {
    /// Every file of it.
    pub files: Files,
    /// The solutions that were taken out.
    pub taken: Vec<Taken>,
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

/// The programs that a handout is for; what they import comes along, other crates do not.
const PROGRAMS: [&str; 3] = ["grader", "worker", "pathtracer"];

/// Files at the top that a student's project has too.
const AT_THE_TOP: [&str; 4] = ["Cargo.lock", ".gitignore", "clippy.toml", "rustfmt.toml"];

/// Folders of a crate that run its code. They go when something that the crate links is carved: they would fail.
const TESTS: [&str; 4] = ["tests", "benches", "examples", "fuzz"];

impl Handout {
    /// Carves the parts from `part` on out of `workspace`.
    pub fn carve(workspace: &Workspace, part: u32) -> Result<Handout, GraderError> {
        let course = Course::read(workspace)?;
        let knife = knife(&course, part)?;
        let members = members::read(workspace.root())?;
        let plan = Plan::new(&course, &knife, &members);
        let mut handout = Handout {
            files: Files::new(),
            taken: Vec::new(),
        };
        for path in tree::paths(workspace.root())? {
            if plan.takes(&path) {
                let contents = tree::read(workspace.root(), &path)?;
                handout.add(&plan, path, contents, workspace.root())?;
            }
        }
        let untouched = knife
            .carved
            .iter()
            .find(|key| !handout.taken.iter().any(|taken| taken.key == **key));
        if let Some(key) = untouched {
            return Err(GraderError::new(format!(
                "there is no solution of {key} to carve out of {}. Is this a handout itself? Handouts are carved \
                 from the course's full checkout, and only from files that git knows",
                workspace.root().display()
            )));
        }
        let readme = readme::write(&course, part, &handout.files)?;
        handout
            .files
            .insert("README.md".into(), readme.into_bytes());
        handout.mend_lock()?;
        Ok(handout)
    }

    /// Writes the handout to the new folder `out`, whole or not at all.
    pub fn write(&self, out: &Path) -> Result<(), GraderError> {
        let parent = match out.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let scratch = crate::interrupt::scratch_in(parent)?;
        let whole = scratch.path().join("handout");
        for (path, contents) in &self.files {
            tree::write(&whole.join(path), contents)?;
        }
        // Renaming onto an empty folder works on some systems only.
        let _ = std::fs::remove_dir(out);
        std::fs::rename(&whole, out).map_err(|e| GraderError::file("write", out, e))
    }

    fn add(
        &mut self,
        plan: &Plan,
        path: PathBuf,
        contents: Vec<u8>,
        root: &Path,
    ) -> Result<(), GraderError> {
        let owner = members::owner(plan.members, &path);
        let is_manifest = path.file_name().is_some_and(|name| name == "Cargo.toml");
        let may_hold_solutions = owner.is_some_and(|owner| owner.name != "grader")
            && path.extension().is_some_and(|extension| extension == "rs");
        if !is_manifest && !may_hold_solutions {
            self.files.insert(path, contents);
            return Ok(());
        }
        let text = String::from_utf8(contents)
            .map_err(|_| GraderError::new(format!("{} is not UTF-8", path.display())))?;
        if is_manifest {
            let text = match owner {
                None => manifest::of_workspace(&text, &plan.left_out()),
                Some(owner) if plan.runs_holes(owner) => manifest::without_tests(&text),
                Some(_) => text,
            };
            self.files.insert(path, text.into_bytes());
            return Ok(());
        }
        let carved = plan.knife.carve(&path.to_string_lossy(), &text)?;
        let text = if carved.taken.is_empty() {
            carved.text
        } else {
            formatted(root, &path, &carved.text)?
        };
        for (key, text) in carved.taken {
            let path = path.clone();
            self.taken.push(Taken { path, key, text });
        }
        if !text.is_empty() {
            self.files.insert(path, text.into_bytes());
        }
        Ok(())
    }

    /// Has cargo take the crates that were left out of the lock file, so that a handout builds `--locked`.
    fn mend_lock(&mut self) -> Result<(), GraderError> {
        let scratch = crate::interrupt::scratch()?;
        tree::make_equal(scratch.path(), &self.files)?;
        let output = Command::new(compile::cargo())
            .current_dir(scratch.path())
            .args(["update", "--workspace", "--offline", "--quiet"])
            .output();
        let output = output.map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
        if !output.status.success() {
            return Err(GraderError::new(format!(
                "cargo does not understand the carved workspace:\n{}",
                String::from_utf8_lossy(&output.stderr).trim()
            )));
        }
        let lock = Path::new("Cargo.lock");
        self.files
            .insert(lock.into(), tree::read(scratch.path(), lock)?);
        Ok(())
    }
}

/// Which files of the workspace a handout takes.
struct Plan<'a> {
    knife: &'a Knife,
    members: &'a [Member],
    needed: BTreeSet<&'a str>,
    /// Stages with something carved.
    carved_stages: BTreeSet<&'a str>,
}

impl<'a> Plan<'a> {
    fn new(course: &'a Course, knife: &'a Knife, members: &'a [Member]) -> Plan<'a> {
        let carved = course
            .tasks()
            .filter(|task| knife.carved.contains(&task.key));
        let carved_stages = carved.map(|task| task.stage.as_str()).collect();
        Plan {
            knife,
            members,
            needed: members::closure(members, &PROGRAMS),
            carved_stages,
        }
    }

    fn takes(&self, path: &Path) -> bool {
        let top = path
            .iter()
            .next()
            .map(|top| top.to_string_lossy())
            .unwrap_or_default();
        let is_rust = path.extension().is_some_and(|extension| extension == "rs");
        let is_manifest = path.file_name().is_some_and(|name| name == "Cargo.toml");
        // Goldens are data to a student: the test that keeps them true is about the reference.
        if top == "golden" {
            return !is_rust && !is_manifest;
        }
        let Some(owner) = members::owner(self.members, path) else {
            let at_the_top = path.components().count() == 1;
            return path == Path::new("stages/course.toml")
                || top == ".cargo"
                || at_the_top
                    && (is_manifest || top.starts_with("LICENSE") || AT_THE_TOP.contains(&&*top));
        };
        if !self.needed.contains(owner.name.as_str()) {
            return false;
        }
        let inside = path.strip_prefix(&owner.folder).unwrap_or(path);
        let folder = inside
            .iter()
            .next()
            .map(|name| name.to_string_lossy())
            .unwrap_or_default();
        if owner.name == "grader" {
            // Its tests and mutants are about the reference, too.
            return is_manifest || folder == "src";
        }
        !(self.runs_holes(owner) && TESTS.contains(&&*folder))
    }

    /// Whether something that the crate links, or the crate itself, is carved.
    fn runs_holes(&self, member: &Member) -> bool {
        !members::closure(self.members, &[&member.name]).is_disjoint(&self.carved_stages)
    }

    fn left_out(&self) -> Vec<PathBuf> {
        self.members
            .iter()
            .filter(|member| !self.needed.contains(member.name.as_str()))
            .map(|member| member.folder.clone())
            .collect()
    }
}

/// What to carve for the handout of `part`.
fn knife(course: &Course, part: u32) -> Result<Knife, GraderError> {
    if !course.parts.iter().any(|p| p.number == part) {
        let parts: Vec<String> = course.parts.iter().map(|p| p.number.to_string()).collect();
        return Err(GraderError::new(format!(
            "the course has no part {part}. It has: {}",
            parts.join(", ")
        )));
    }
    let all = course
        .parts
        .iter()
        .flat_map(|p| p.tasks.iter().map(|task| (p.number, task.key.clone())));
    Ok(Knife {
        known: all.clone().map(|(_, key)| key).collect(),
        carved: all
            .filter(|(number, _)| *number >= part)
            .map(|(_, key)| key)
            .collect(),
    })
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

/// Refuses a place for a handout where it would overwrite something or hide in the course's own tree.
pub fn check_place(workspace: &Workspace, out: &Path) -> Result<(), GraderError> {
    let refused = |why: &str| {
        GraderError::new(format!(
            "cannot put a handout into {}: {why}",
            out.display()
        ))
    };
    if out.exists() && !out.is_dir() {
        return Err(refused(
            "it is a file. Name a folder that does not exist yet",
        ));
    }
    if out.is_dir() {
        let mut entries = std::fs::read_dir(out).map_err(|e| GraderError::file("read", out, e))?;
        if entries.next().is_some() {
            return Err(refused(
                "it is not empty. Name a folder that does not exist yet",
            ));
        }
    }
    if out
        .components()
        .next_back()
        .is_none_or(|last| !matches!(last, Component::Normal(_)))
    {
        return Err(refused("name the folder itself, not one above it"));
    }
    let parent = out.parent().filter(|parent| !parent.as_os_str().is_empty());
    let parent = parent.unwrap_or(Path::new("."));
    let parent = parent
        .canonicalize()
        .map_err(|_| refused("the folder that it would stand in does not exist. Make it first"))?;
    let inside = parent.join(out.file_name().unwrap_or_default());
    if inside.starts_with(workspace.root()) && !inside.starts_with(workspace.root().join("target"))
    {
        return Err(refused(
            "that is inside the course itself, where it could be handed out with it. Name a folder outside",
        ));
    }
    Ok(())
}
