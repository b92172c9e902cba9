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

/// The teacher's files in `folder`, by their paths in it.
pub fn inputs(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>, GraderError> {
    let mut found = BTreeMap::new();
    let mut paths: Vec<PathBuf> = FILES.iter().map(PathBuf::from).collect();
    for files in [SCENES, MISTAKES] {
        paths.extend(inside(folder, Path::new(files))?);
    }
    for task in inside(folder, Path::new(CASES))? {
        paths.extend(inside(folder, &task)?);
    }
    for path in paths {
        let full = folder.join(&path);
        if full.is_file() {
            let contents = std::fs::read(&full).map_err(|e| GraderError::file("read", &full, e))?;
            found.insert(path, contents);
        }
    }
    Ok(found)
}

/// The paths in the folder `path` of `folder`; none if it is no folder.
fn inside(folder: &Path, path: &Path) -> Result<Vec<PathBuf>, GraderError> {
    let full = folder.join(path);
    if !full.is_dir() {
        return Ok(Vec::new());
    }
    let failed = |e| GraderError::file("read", &full, e);
    let entries = std::fs::read_dir(&full).map_err(failed)?;
    entries
        .map(|entry| Ok(path.join(entry.map_err(failed)?.file_name())))
        .collect()
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
