//! The crates of the workspace and their dependencies on each other, as `cargo metadata` lists
//! them.

use base::GraderError;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A crate of the workspace.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// Its name.
    pub name: String,
    /// Its folder, relative to the workspace.
    pub folder: PathBuf,
    /// The crates of the workspace that it or its tests depend on.
    pub imports: Vec<String>,
}

/// The fields of the output of `cargo metadata` that are read here.
#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    manifest_path: PathBuf,
    dependencies: Vec<Dependency>,
}

#[derive(Deserialize)]
struct Dependency {
    name: String,
    path: Option<PathBuf>,
}

/// The folders of a crate with tests and other code that runs the crate.
pub const TEST_FOLDERS: [&str; 4] = ["tests", "benches", "examples", "fuzz"];

/// Lists all crates of the workspace at `root`.
pub fn read(root: &Path) -> Result<Vec<Member>, GraderError> {
    let output = Command::new(base::child_processes::cargo())
        .current_dir(root)
        .args([
            "metadata",
            "--no-deps",
            "--offline",
            "--format-version",
            "1",
        ])
        .output();
    let output = output.map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
    if !output.status.success() {
        return Err(GraderError::new(format!(
            "cargo cannot read the workspace:\n{}",
            String::from_utf8_lossy(&output.stderr).trim()
        )));
    }
    let metadata: Metadata = serde_json::from_slice(&output.stdout)
        .map_err(|e| GraderError::new(format!("cannot read the output of cargo metadata: {e}")))?;
    let members = metadata.packages.into_iter().map(|package| {
        let folder = package.manifest_path.parent().unwrap_or(Path::new(""));
        let local = package
            .dependencies
            .into_iter()
            .filter(|d| d.path.is_some());
        Member {
            name: package.name,
            folder: folder.strip_prefix(root).unwrap_or(folder).to_path_buf(),
            imports: local.map(|dependency| dependency.name).collect(),
        }
    });
    Ok(members.collect())
}

/// The names of the crates `from` and of all crates that they depend on, directly or indirectly.
pub fn with_dependencies<'a>(members: &'a [Member], from: &[&str]) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut next: Vec<&str> = from.to_vec();
    while let Some(name) = next.pop() {
        let Some(member) = members.iter().find(|member| member.name == name) else {
            continue;
        };
        if reached.insert(member.name.as_str()) {
            next.extend(member.imports.iter().map(String::as_str));
        }
    }
    reached
}

/// The crate that contains the file `path`: the one in the innermost folder.
pub fn containing_member<'a>(members: &'a [Member], path: &Path) -> Option<&'a Member> {
    members
        .iter()
        .filter(|member| path.starts_with(&member.folder))
        .max_by_key(|member| member.folder.components().count())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn member(name: &str, folder: &str, imports: &[&str]) -> Member {
        Member {
            name: name.into(),
            folder: folder.into(),
            imports: imports.iter().map(ToString::to_string).collect(),
        }
    }

    #[test]
    fn dependencies_are_followed_and_cycles_end() {
        let members = [
            member("a", "a", &["b"]),
            member("b", "a/b", &["a", "c"]),
            member("c", "c", &[]),
            member("d", "d", &["a"]),
        ];
        assert_eq!(
            with_dependencies(&members, &["a"]),
            BTreeSet::from(["a", "b", "c"])
        );
        assert_eq!(
            with_dependencies(&members, &["c", "unknown"]),
            BTreeSet::from(["c"])
        );
    }

    #[test]
    fn a_file_belongs_to_the_innermost_crate() {
        let members = [member("a", "a", &[]), member("b", "a/b", &[])];
        let name = |path| containing_member(&members, Path::new(path)).map(|m| m.name.as_str());
        assert_eq!(name("a/src/lib.rs"), Some("a"));
        assert_eq!(name("a/b/src/lib.rs"), Some("b"));
        assert_eq!(name("README.md"), None);
    }
}
