//! The folder of a term: the course as a teacher gives it, beside a copy of First Light.
//!
//! The folder has the teacher's files ([`inputs`]): what is different from First Light. `grader
//! course build` applies them to the copy in [`COPY`], which is a full checkout and all that the
//! other commands read.

use crate::GraderError;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The folder of First Light's files, with the changes of the term.
pub const COPY: &str = ".first-light";

/// The folder in [`COPY`] with the teacher's files that were applied last.
pub const APPLIED: &str = ".first-light/.term";

/// The names of the teacher's files, which need not all exist.
pub const FILES: [&str; 3] = ["course.toml", "kept.toml", "front.md"];

/// The folder of the teacher's scenes.
pub const SCENES: &str = "scenes";

/// The folder of the teacher's cases: in it a folder for each task.
pub const CASES: &str = "cases";

/// The folder of the teacher's mistakes: for each task a list, and what the grader learnt of it.
pub const MISTAKES: &str = "mistakes";

/// The most bytes of a case or of a list of mistakes: they are compiled in, and are in handouts.
const MAX_BYTES: u64 = 1_000_000;

/// The teacher's files in `folder`, by their paths in it. Hidden files and the copies that editors
/// keep are nobody's.
pub fn inputs(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>, GraderError> {
    let mut found = BTreeMap::new();
    let mut paths: Vec<PathBuf> = FILES.iter().map(PathBuf::from).collect();
    for files in [SCENES, MISTAKES] {
        paths.extend(inside(folder, Path::new(files))?);
    }
    for task in inside(folder, Path::new(CASES))? {
        match folder.join(&task).is_dir() {
            true => paths.extend(inside(folder, &task)?),
            // Who reads the cases says where such a file belongs.
            false => paths.push(task),
        }
    }
    for path in paths {
        let full = folder.join(&path);
        let failed = |e| GraderError::file("read", &full, e);
        if full.is_file() {
            ensure_short(&path, full.metadata().map_err(failed)?.len())?;
            found.insert(path, std::fs::read(&full).map_err(failed)?);
        } else if full.is_dir() {
            return Err(GraderError::new(format!(
                "{} is a folder, and a file is expected there",
                full.display()
            )));
        }
    }
    Ok(found)
}

/// Returns an error if the file `path`, which has this length, is too long to be compiled in.
fn ensure_short(path: &Path, length: u64) -> Result<(), GraderError> {
    let is_compiled_in = path.starts_with(CASES) || path.starts_with(MISTAKES);
    match is_compiled_in && length > MAX_BYTES {
        false => Ok(()),
        true => Err(GraderError::new(format!(
            "{} has {length} bytes: expected at most {MAX_BYTES}",
            path.display()
        ))),
    }
}

/// The paths in the folder `path` of `folder`; none if it is no folder.
fn inside(folder: &Path, path: &Path) -> Result<Vec<PathBuf>, GraderError> {
    let full = folder.join(path);
    if !full.is_dir() {
        return Ok(Vec::new());
    }
    let failed = |e| GraderError::file("read", &full, e);
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(&full).map_err(failed)? {
        let name = entry.map_err(failed)?.file_name();
        let shown = name.to_string_lossy();
        if !shown.starts_with('.') && !shown.ends_with('~') {
            paths.push(path.join(&name));
        }
    }
    Ok(paths)
}

/// Returns an error if the teacher's files in `folder` are not those that were applied last.
pub(crate) fn ensure_applied(folder: &Path) -> Result<(), GraderError> {
    let (now, applied) = (inputs(folder)?, inputs(&folder.join(APPLIED))?);
    let names = now.keys().chain(applied.keys());
    let changed = names
        .into_iter()
        .find(|name| now.get(*name) != applied.get(*name));
    match changed {
        None => Ok(()),
        Some(changed) => Err(GraderError::new(format!(
            "{} changed since the course was built. Run `cargo grader course build` in {}",
            changed.display(),
            folder.display()
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_do_not_belong_are_told_or_nobodys() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |path: &str, contents: &[u8]| {
            let path = folder.path().join(path);
            std::fs::create_dir_all(path.parent().expect("a folder")).expect("it is writable");
            std::fs::write(path, contents).expect("it is writable");
        };
        write("mistakes/part1.task3.txt", b"a");
        write("mistakes/.DS_Store", b"a");
        write("mistakes/.part1.task3.txt.swp", b"a");
        write("cases/part1.task3/door.toml~", b"a");
        write("scenes/.DS_Store", b"a");
        write("notes/lecture.md", b"a");
        // The reader of cases refuses this one with a sentence.
        write("cases/door.toml", b"a");
        let found = inputs(folder.path()).expect("readable");
        let found: Vec<_> = found.keys().map(|path| path.to_string_lossy()).collect();
        assert_eq!(found, ["cases/door.toml", "mistakes/part1.task3.txt"]);

        let long = vec![b'a'; 1_000_001];
        write("cases/part1.task3/long.toml", &long);
        let error = inputs(folder.path()).expect_err("too long").to_string();
        assert!(error.contains("long.toml has 1000001 bytes"), "{error}");
        write("cases/part1.task3/long.toml", &long[1..]);
        inputs(folder.path()).expect("it is short enough");

        write("mistakes/part1.task3/culled.txt", b"a");
        let error = inputs(folder.path()).expect_err("a folder").to_string();
        assert!(
            error.contains("is a folder, and a file is expected"),
            "{error}"
        );
    }
}
