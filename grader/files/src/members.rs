//! The crates of the workspace and their dependencies on each other, as `cargo metadata` lists
//! them.

use base::GraderError;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A crate of the workspace.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// Its name.
    pub name: String,
    /// Its folder, relative to the workspace.
    pub folder: PathBuf,
    /// The crates of the workspace that it depends on.
    pub imports: Vec<String>,
    /// The crates of the workspace that its tests depend on, too.
    pub test_imports: Vec<String>,
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
    kind: Option<Kind>,
}

/// The kind of a dependency that is not a normal one.
#[derive(Deserialize, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Build,
    Dev,
}

/// The folders of a crate with tests and other code that runs the crate.
pub const TEST_FOLDERS: [&str; 4] = ["tests", "benches", "examples", "fuzz"];

/// What `cargo metadata` says of the workspace at `root` without its dependencies, as JSON.
///
/// # Errors
///
/// Cargo cannot be run, or cannot read the workspace.
pub fn metadata(root: &Path) -> Result<Vec<u8>, GraderError> {
    let arguments = [
        "metadata",
        "--no-deps",
        "--offline",
        "--format-version",
        "1",
    ];
    crate::cargo(root, &arguments, "cargo cannot read the workspace")
}

/// Lists all crates of the workspace at `root`.
pub fn read(root: &Path) -> Result<Vec<Member>, GraderError> {
    let metadata: Metadata = serde_json::from_slice(&metadata(root)?)
        .map_err(|e| GraderError::new(format!("cannot read the output of cargo metadata: {e}")))?;
    let members = metadata.packages.into_iter().map(|package| {
        let folder = package.manifest_path.parent().unwrap_or(Path::new(""));
        let local = package
            .dependencies
            .into_iter()
            .filter(|d| d.path.is_some());
        let (of_tests, imports): (Vec<_>, Vec<_>) = local.partition(|d| d.kind == Some(Kind::Dev));
        let names = |list: Vec<Dependency>| list.into_iter().map(|d| d.name).collect();
        Member {
            name: package.name,
            folder: folder.strip_prefix(root).unwrap_or(folder).to_path_buf(),
            imports: names(imports),
            test_imports: names(of_tests),
        }
    });
    Ok(members.collect())
}

/// The names of the crates `from` and of all crates that they or their tests depend on, directly or
/// indirectly.
pub fn with_dependencies<'a>(members: &'a [Member], from: &[&str]) -> BTreeSet<&'a str> {
    with_tests_of(members, from, |_| true)
}

/// As [`with_dependencies`], where only the crates for which `has_tests` is true have their tests.
pub fn with_tests_of<'a>(
    members: &'a [Member],
    from: &[&str],
    has_tests: impl Fn(&Member) -> bool,
) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut next: Vec<&str> = from.to_vec();
    while let Some(name) = next.pop() {
        let Some(member) = members.iter().find(|member| member.name == name) else {
            continue;
        };
        if reached.insert(member.name.as_str()) {
            next.extend(member.imports.iter().map(String::as_str));
            if has_tests(member) {
                next.extend(member.test_imports.iter().map(String::as_str));
            }
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
            test_imports: Vec::new(),
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
    fn what_only_tests_need_is_left_out_with_them() {
        let mut members = [
            member("a", "a", &["b"]),
            member("b", "b", &[]),
            member("c", "c", &[]),
            member("d", "d", &[]),
        ];
        members[0].test_imports = vec!["c".into()];
        members[1].test_imports = vec!["d".into()];
        let of_b = with_tests_of(&members, &["a"], |member| member.name == "b");
        assert_eq!(of_b, BTreeSet::from(["a", "b", "d"]));
        let all = with_dependencies(&members, &["a"]);
        assert_eq!(all, BTreeSet::from(["a", "b", "c", "d"]));
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
