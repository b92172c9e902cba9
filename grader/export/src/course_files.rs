//! The files of the course that grading needs: the programs, the reference solutions, the goldens.
//!
//! They contain solutions. They are for containers that students cannot look into.

use base::{GraderError, Workspace};
use files::file_tree::{self, Files};
use files::members::{self, Member};
use files::{lock, manifest};
use std::collections::BTreeSet;
use std::path::Path;

/// The programs that a container runs. The package contains what they depend on.
const PROGRAMS: [&str; 3] = ["submission", "worker", "sandbox"];

/// The files, by their paths in the workspace.
pub fn of(workspace: &Workspace) -> Result<Files, GraderError> {
    workspace.ensure_full("it lacks solutions, which grading needs")?;
    let root = workspace.root();
    let members = members::read(root)?;
    let needed = members::with_dependencies(&members, &PROGRAMS);
    let is_needed = |member: &Member| needed.contains(member.name.as_str());
    let mut files = Files::new();
    for path in file_tree::workspace_paths(root)? {
        let owner = members::containing_member(&members, &path);
        let is_included = match owner {
            _ if path.starts_with("golden") => is_golden(&path),
            Some(owner) => is_needed(owner) && is_built(owner, &path),
            None => is_of_workspace(&path),
        };
        if is_included {
            let contents = file_tree::read(root, &path)?;
            let contents = match path.file_name().is_some_and(|name| name == "Cargo.toml") {
                true => without_what_is_left_out(&contents, owner, &members, &needed),
                false => contents,
            };
            files.insert(path, contents);
        }
    }
    lock::remove_unused(&mut files)?;
    Ok(files)
}

/// The names of those of `PROGRAMS` that the course `files` has and that must be built before
/// grading. The worker is built while grading.
pub fn programs(files: &Files) -> Vec<&'static str> {
    let exists = |name: &&str| {
        *name != "worker" && files.contains_key(&Path::new("grader").join(name).join("Cargo.toml"))
    };
    PROGRAMS.into_iter().filter(exists).collect()
}

/// Whether a file of the goldens is data that grading reads.
fn is_golden(path: &Path) -> bool {
    let is_code = path.extension().is_some_and(|extension| extension == "rs");
    let is_manifest = path.file_name().is_some_and(|name| name == "Cargo.toml");
    !is_code && !is_manifest && !path.starts_with("golden/mutants")
}

/// Whether a file of a crate is part of its library or program.
fn is_built(owner: &Member, path: &Path) -> bool {
    let inside = path.strip_prefix(&owner.folder).unwrap_or(path);
    inside.starts_with("src") || inside == Path::new("Cargo.toml")
}

/// Whether a file of no crate belongs to the workspace itself.
fn is_of_workspace(path: &Path) -> bool {
    let known = ["Cargo.lock", "Cargo.toml", "stages/course.toml"];
    path.starts_with(".cargo") || known.iter().any(|name| path == Path::new(name))
}

/// A manifest without the crates that are left out, and without what only tests need.
fn without_what_is_left_out(
    contents: &[u8],
    owner: Option<&Member>,
    members: &[Member],
    needed: &BTreeSet<&str>,
) -> Vec<u8> {
    let text = String::from_utf8_lossy(contents);
    let text = match owner {
        None => manifest::with_members(&text, members, needed),
        Some(_) => {
            let text = manifest::without_tests(&text);
            manifest::without_unused_dev_dependencies(&text, |_| false)
        }
    };
    text.into_bytes()
}
