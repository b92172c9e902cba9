//! Makes the copy of First Light in the folder of a term, with the teacher's files applied.

use super::COPY;
use super::apply::apply;
use super::settings::Changes;
use base::{GraderError, VERSION, Workspace, term};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use submission::file_tree::{self, Files};

/// The folder in a copy with the files of First Light that the term changed, as they were.
const ORIGINALS: &str = ".original";

/// The file there that lists what the term added.
const ADDED: &str = ".original/added";

/// First Light's own files of `workspace`: of a copy in a term, without the term's changes.
pub fn originals(workspace: &Workspace) -> Result<Files, GraderError> {
    let root = workspace.root();
    let added = std::fs::read_to_string(root.join(ADDED)).unwrap_or_default();
    let added: BTreeSet<&Path> = added.lines().map(Path::new).collect();
    let mut files = Files::new();
    for path in file_tree::workspace_paths(root)? {
        if added.contains(path.as_path()) {
            continue;
        }
        let original = root.join(ORIGINALS).join(&path);
        let contents = match original.is_file() {
            true => file_tree::read(&root.join(ORIGINALS), &path)?,
            false => file_tree::read(root, &path)?,
        };
        files.insert(path, contents);
    }
    Ok(files)
}

/// First Light's `files` with the changes of a term, and what has to be known to take them back.
#[derive(Clone, Debug)]
pub struct Applied {
    /// All files of the copy.
    pub files: Files,
    /// The changed files as they were.
    originals: Files,
    /// The files that the term added.
    added: Vec<PathBuf>,
}

impl Applied {
    /// Applies `changes` to `files`.
    pub fn new(mut files: Files, changes: &Changes) -> Result<Applied, GraderError> {
        let before = files.clone();
        let mut applied = Applied {
            files: Files::new(),
            originals: Files::new(),
            added: Vec::new(),
        };
        for path in apply(&mut files, changes)? {
            match before.get(&path) {
                Some(original) => {
                    applied.originals.insert(path, original.clone());
                }
                None => applied.added.push(path),
            }
        }
        applied.files = files;
        Ok(applied)
    }

    /// Writes the copy to the folder `copy`. Only files that differ are written.
    pub fn write(&self, copy: &Path) -> Result<(), GraderError> {
        file_tree::sync_folder(copy, &self.files)?;
        let originals = copy.join(ORIGINALS);
        if originals.exists() {
            std::fs::remove_dir_all(&originals)
                .map_err(|e| GraderError::file("remove", &originals, e))?;
        }
        for (path, contents) in &self.originals {
            file_tree::write(&originals.join(path), contents)?;
        }
        let added: String = self
            .added
            .iter()
            .map(|path| format!("{}\n", path.display()))
            .collect();
        file_tree::write(&copy.join(ADDED), added.as_bytes())
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
            folder.display()
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
