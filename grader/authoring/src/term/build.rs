//! Makes the copy of First Light in the folder of a term, with the teacher's files applied.

use super::COPY;
use super::apply::{Written, apply};
use super::settings::Changes;
use base::{GraderError, VERSION, Workspace, shell_word, term};
use files::file_tree::{self, Files};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

/// The folder in a copy with the files of First Light that the term changed, as they were.
const ORIGINALS: &str = ".original";

/// The file there that lists what the term added.
const ADDED: &str = "added";

/// First Light's own files of `workspace`: of a copy in a term, without the term's changes.
pub fn originals(workspace: &Workspace) -> Result<Files, GraderError> {
    let root = workspace.root();
    let originals = root.join(ORIGINALS);
    let added = std::fs::read_to_string(originals.join(ADDED)).unwrap_or_default();
    let added: BTreeSet<&Path> = added.lines().map(Path::new).collect();
    let mut files = Files::new();
    for path in file_tree::workspace_paths(root)? {
        if added.contains(path.as_path()) {
            continue;
        }
        let folder = match originals.join(&path).is_file() {
            true => &originals,
            false => root,
        };
        let contents = file_tree::read(folder, &path)?;
        files.insert(path, contents);
    }
    Ok(files)
}

/// First Light's `files` with the changes of a term, and what has to be known to take them back.
#[derive(Clone, Debug)]
pub struct Applied {
    /// All files of the copy.
    pub files: Files,
    /// The files of [`ORIGINALS`]: the changed files as they were, and [`ADDED`].
    originals: Files,
}

impl Applied {
    /// Applies `changes` to `files`.
    pub fn new(mut files: Files, changes: &Changes) -> Result<Applied, GraderError> {
        let mut originals = Files::new();
        let mut added = String::new();
        for Written { path, original } in apply(&mut files, changes)? {
            match original {
                Some(original) => {
                    originals.insert(path, original);
                }
                None => {
                    let _ = writeln!(added, "{}", path.display());
                }
            }
        }
        originals.insert(ADDED.into(), added.into_bytes());
        Ok(Applied { files, originals })
    }

    /// Writes the copy to the folder `copy`. Only files that differ are written.
    pub fn write(&self, copy: &Path) -> Result<(), GraderError> {
        file_tree::sync_folder(copy, &self.files)?;
        file_tree::sync_folder(&copy.join(ORIGINALS), &self.originals)
    }
}

/// Makes the copy in the folder `folder` of a term from `first_light`, which may be that copy.
pub fn build(first_light: &Workspace, folder: &Path) -> Result<(), GraderError> {
    first_light.ensure_full("a term needs the whole course")?;
    let changes = Changes::read(folder)?;
    let wanted = &changes.settings.first_light.version;
    if wanted != VERSION {
        return Err(GraderError::new(format!(
            "{} asks for First Light {wanted}, and this is {VERSION}. Get that version with ./get-first-light, or take this \
             one with `cargo grader course update {}`",
            folder.join("course.toml").display(),
            shell_word(folder)
        )));
    }
    Applied::new(originals(first_light)?, &changes)?.write(&folder.join(COPY))?;
    remember(folder)
}

/// Stores which of the teacher's files were applied.
pub(super) fn remember(folder: &Path) -> Result<(), GraderError> {
    let applied = folder.join(term::APPLIED);
    if applied.exists() {
        std::fs::remove_dir_all(&applied).map_err(|e| GraderError::file("remove", &applied, e))?;
    }
    for (path, contents) in term::inputs(folder)? {
        file_tree::write(&applied.join(path), &contents)?;
    }
    Ok(())
}
