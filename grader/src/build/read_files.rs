//! Which files the compiler read for the code of a submission: those of a crate's own folder only.
//!
//! The compiler writes the names of all files that it reads for a crate (`include_str!`, `#[path]`)
//! and of all variables of the environment to a file beside the crate, even if the crate has
//! errors. No code of a submission runs meanwhile, so nobody but the compiler writes there. It
//! closes a way that the scan of the code may have missed, and on machines that cannot close files
//! to the compiler it is the only thing that does.

use base::GraderError;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What the compiler says about the crates of a workspace.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct ReadFiles {
    /// A sentence for each crate that read something that is not its own.
    pub(super) foreign: BTreeMap<String, String>,
    /// The crates for which the compiler ended before it said anything.
    pub(super) unknown: Vec<String>,
}

impl ReadFiles {
    /// Of the `crates` below the folder `root`, each with its folder there, which were compiled in
    /// the target folder `target`.
    pub(super) fn of(
        root: &Path,
        target: &Path,
        crates: &[(&str, PathBuf)],
    ) -> Result<ReadFiles, GraderError> {
        let compiled = target.join("release/deps");
        let failed = |e| GraderError::file("read", &compiled, e);
        let mut lists: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
        for entry in std::fs::read_dir(&compiled).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if path.extension().is_some_and(|extension| extension == "d")
                && let Some(stem) = path.file_stem()
                && let Some((of, _)) = stem.to_string_lossy().rsplit_once('-')
            {
                lists.entry(of.to_string()).or_default().push(path);
            }
        }
        let mut read = ReadFiles::default();
        for (name, folder) in crates {
            let Some(lists) = lists.get(*name) else {
                read.unknown.push((*name).to_string());
                continue;
            };
            for list in lists {
                let bytes = std::fs::read(list).map_err(|e| GraderError::file("read", list, e))?;
                if let Some(what) = foreign(&String::from_utf8_lossy(&bytes), root, folder) {
                    let folder = folder.display();
                    let sentence = format!(
                        "error: `{name}` is refused: the compiler read {what} for it. A stage may read only the files of its folder {folder}/src\n"
                    );
                    read.foreign.insert((*name).to_string(), sentence);
                }
            }
        }
        Ok(read)
    }
}

/// The first thing in a `list` of the compiler's that is not a file of the crate in `root/folder`.
fn foreign(list: &str, root: &Path, folder: &Path) -> Option<String> {
    let own = root.join(folder).join("src");
    // After the files that were made, there is a line for each file that was read.
    list.lines().find_map(|line| {
        if let Some(variable) = line.strip_prefix("# env-dep:") {
            let name = variable.split('=').next().unwrap_or_default();
            return Some(format!("the variable {name} of the environment"));
        }
        let name = line.strip_suffix(':')?.replace("\\ ", " ");
        let (path, own) = (root.join(&name).canonicalize(), own.canonicalize());
        let is_own = matches!((path, own), (Ok(path), Ok(own)) if path.starts_with(&own));
        (!is_own).then(|| format!("the file {name}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of the crate `bvh` whose list has these lines.
    fn of(lines: &str) -> ReadFiles {
        let folder = tempfile::tempdir().unwrap();
        let (root, target) = (folder.path().join("course"), folder.path().join("target"));
        for file in ["bvh/src/lib.rs", "bvh/src/a b.rs", "bbox/src/lib.rs"] {
            let path = root.join("stages").join(file);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, "").unwrap();
        }
        let deps = target.join("release/deps");
        std::fs::create_dir_all(&deps).unwrap();
        let made = deps.join("bvh-0123.d");
        std::fs::write(&made, format!("{}: stages\n\n{lines}", made.display())).unwrap();
        ReadFiles::of(&root, &target, &[("bvh", PathBuf::from("stages/bvh"))]).unwrap()
    }

    #[test]
    fn a_crate_may_read_its_own_files_only() {
        let own =
            "stages/bvh/src/lib.rs:\nstages/bvh/src/a\\ b.rs:\nstages/bvh/src/../src/lib.rs:\n";
        assert_eq!(of(own), ReadFiles::default());
        for (line, what) in [
            ("/etc/hostname:", "the file /etc/hostname for"),
            (
                "stages/bvh/src/../../bbox/src/lib.rs:",
                "the file stages/bvh/src/../../bbox",
            ),
            (
                "stages/bvh/src/not_there.rs:",
                "the file stages/bvh/src/not_there.rs for",
            ),
            (
                "# env-dep:HOME=/home/ada",
                "the variable HOME of the environment for",
            ),
        ] {
            let read = of(&format!("{own}{line}\n"));
            let said = read.foreign.get("bvh").map_or("", String::as_str);
            assert!(said.contains(what), "{line}: {said}");
        }
    }

    #[test]
    fn a_crate_without_a_list_is_unknown() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir_all(folder.path().join("release/deps")).unwrap();
        let crates = [("bvh", PathBuf::from("stages/bvh"))];
        let read = ReadFiles::of(folder.path(), folder.path(), &crates).unwrap();
        assert_eq!(read.unknown, ["bvh"]);
        assert!(read.foreign.is_empty());
    }
}
