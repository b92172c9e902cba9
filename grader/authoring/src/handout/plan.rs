//! Which files of the workspace a handout takes, and which solutions it loses.

use super::carve::Knife;
use grader::course::Course;
use grader::error::GraderError;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use submission::packages::members::{self, Member};

/// The programs that a handout is for; what they import comes along, other crates do not.
const PROGRAMS: [&str; 6] = [
    "grader",
    "worker",
    "pathtracer",
    "cost",
    "review",
    "submission",
];

/// Files at the top that a student's project has too.
const AT_THE_TOP: [&str; 4] = ["Cargo.lock", ".gitignore", "clippy.toml", "rustfmt.toml"];

/// Which crates a handout needs.
#[derive(Clone, Debug)]
pub(super) struct Plan<'a> {
    members: &'a [Member],
    needed: BTreeSet<&'a str>,
}

impl<'a> Plan<'a> {
    pub(super) fn new(members: &'a [Member]) -> Plan<'a> {
        let needed = members::with_dependencies(members, &PROGRAMS);
        Plan { members, needed }
    }

    /// Whether a handout has the file `path`, or would have if nothing were carved.
    pub(super) fn takes(&self, path: &Path) -> bool {
        let top = path
            .iter()
            .next()
            .map(|top| top.to_string_lossy())
            .unwrap_or_default();
        let is_rust = path.extension().is_some_and(|extension| extension == "rs");
        let is_manifest = path.file_name().is_some_and(|name| name == "Cargo.toml");
        // Goldens are data to a student: the test that keeps them true is about the reference, as are mutants.
        if top == "golden" {
            return !is_rust && !is_manifest && !path.starts_with("golden/mutants");
        }
        let Some(owner) = members::containing_member(self.members, path) else {
            let at_the_top = path.components().count() == 1;
            let is_known = is_manifest || top.starts_with("LICENSE") || AT_THE_TOP.contains(&&*top);
            return path == Path::new("stages/course.toml")
                || top == ".cargo"
                || at_the_top && is_known;
        };
        let inside = path.strip_prefix(&owner.folder).unwrap_or(path);
        self.needed.contains(owner.name.as_str())
            && (!is_of_the_grader(owner) || is_manifest || inside.starts_with("src"))
    }

    /// The crate that the file `path` belongs to.
    pub(super) fn owner(&self, path: &Path) -> Option<&'a Member> {
        members::containing_member(self.members, path)
    }

    /// Whether the file `path` is a test of its crate, or something else that runs the crate's code.
    pub(super) fn is_test(&self, path: &Path) -> bool {
        let inside = self
            .owner(path)
            .and_then(|owner| path.strip_prefix(&owner.folder).ok());
        let folder = inside.and_then(|inside| inside.iter().next());
        folder.is_some_and(|folder| members::TEST_FOLDERS.iter().any(|test| folder == *test))
    }

    /// Whether the crate's tests are about something `carved`: it, or something that it links, is. The grader's are
    /// about the reference in any case.
    pub(super) fn tests(&self, member: &Member, carved: &BTreeSet<&str>) -> bool {
        is_of_the_grader(member)
            || !members::with_dependencies(self.members, &[&member.name]).is_disjoint(carved)
    }

    /// The folders of crates that a handout goes without.
    pub(super) fn left_out(&self) -> Vec<PathBuf> {
        self.members
            .iter()
            .filter(|member| !self.needed.contains(member.name.as_str()))
            .map(|member| member.folder.clone())
            .collect()
    }
}

/// Whether the crate is one of those that grade.
pub(super) fn is_of_the_grader(member: &Member) -> bool {
    member.folder.starts_with("grader")
}

/// What to carve for the handout of `part`.
pub(super) fn knife(course: &Course, part: u32) -> Result<Knife, GraderError> {
    if !course.parts.iter().any(|p| p.number == part) {
        let parts: Vec<String> = course.parts.iter().map(|p| p.number.to_string()).collect();
        return Err(GraderError::new(format!(
            "the course has no part {part}. It has: {}",
            parts.join(", ")
        )));
    }
    let keys = |chosen: &dyn Fn(u32) -> bool| {
        let chosen = course.holes().filter(|(number, _)| chosen(*number));
        chosen.map(|(_, key)| key.to_string()).collect()
    };
    Ok(Knife {
        known: keys(&|_| true),
        carved: keys(&|number| number >= part),
    })
}
