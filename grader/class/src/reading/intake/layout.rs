//! Finds the project in a folder: it may be a folder too deep, or in an archive in the folder.

use super::archive::{self, ASK_FOR, Form};
use super::git;
use crate::reading::Unreadable;
use base::{GraderError, is_of_the_machine};
use std::path::{Path, PathBuf};

/// How deep a project may lie in a submission.
const MAX_DEPTH: usize = 5;

/// The most folders that are looked into.
const MAX_FOLDERS: usize = 5_000;

/// Folders that contain no project.
const SKIPPED: [&str; 4] = ["target", ".git", "__MACOSX", "node_modules"];

/// What a folder contains.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// A project: the folder that contains `stages`, or the folders of the stages.
    Root(PathBuf),
    /// No project, but one archive.
    Archive(PathBuf),
}

/// Finds the project in `folder`: the one that is the least deep.
pub(super) fn find(folder: &Path, stages: &[&str]) -> Result<Found, Unreadable> {
    let mut level = vec![folder.to_path_buf()];
    let (mut archives, mut others) = (Vec::new(), Vec::new());
    let mut seen = Vec::new();
    let mut folders = 0;
    for _ in 0..=MAX_DEPTH {
        let mut roots = Vec::new();
        for path in &level {
            if is_root(path, stages)? {
                roots.push(path);
            }
        }
        match roots.as_slice() {
            [] => {}
            [root] => return Ok(Found::Root((*root).clone())),
            [first, second, ..] => {
                let name = |path: &Path| {
                    path.strip_prefix(folder)
                        .unwrap_or(path)
                        .display()
                        .to_string()
                };
                return Err(Unreadable::Damaged(format!(
                    "contains two projects, {} and {}: remove the one that does not count",
                    name(first),
                    name(second)
                )));
            }
        }
        let mut next = Vec::new();
        for path in &level {
            let failed = |e| GraderError::file("read", path, e);
            for entry in std::fs::read_dir(path).map_err(failed)? {
                let entry = entry.map_err(failed)?;
                let name = entry.file_name();
                let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
                if path == folder && name != ".git" && seen.len() < NAMED {
                    seen.push(name.display().to_string());
                }
                if is_folder && SKIPPED.iter().all(|skipped| name != *skipped) {
                    next.push(entry.path());
                } else if !is_folder {
                    let path = entry.path();
                    let form = archive::form(&path);
                    match form.map_err(|e| GraderError::file("read", &path, e))? {
                        None | Some(Form::Pdf) => {}
                        Some(Form::OtherArchive(form)) => others.push((name, form)),
                        Some(Form::Zip | Form::Tar | Form::TarGz) => archives.push(path),
                    }
                }
            }
        }
        next.sort();
        folders += next.len();
        if folders > MAX_FOLDERS {
            return Err(Unreadable::TooLarge(format!(
                "contains more than {MAX_FOLDERS} folders: expected the folder stages"
            )));
        }
        level = next;
    }
    if let [archive] = archives.as_slice() {
        return Ok(Found::Archive(archive.clone()));
    }
    if let [(name, form)] = others.as_slice() {
        return Err(Unreadable::Damaged(format!(
            "contains no stage, but {}, a file of the form {form}, {ASK_FOR}",
            name.display()
        )));
    }
    seen.sort();
    let found = match seen.as_slice() {
        names if git::is_without_files(folder, names.is_empty()) => {
            "it is the history of a git clone without its files, which `--before` and `--commit` read".to_string()
        }
        [] => "it is empty".to_string(),
        names => format!("found {}", names.join(", ")),
    };
    Err(Unreadable::Damaged(format!(
        "contains no stage: expected stages/<stage>/src, where <stage> is {}; {found}",
        stages.join(" or ")
    )))
}

/// How many entries of a folder without a project are named.
const NAMED: usize = 5;

/// Whether `folder` contains a stage, directly or in its folder `stages`.
fn is_root(folder: &Path, stages: &[&str]) -> Result<bool, GraderError> {
    for above in [folder.join("stages"), folder.to_path_buf()] {
        for stage in stages {
            if is_folder(&above)? && is_folder(&above.join(stage).join("src"))? {
                return Ok(true);
            }
        }
    }
    Ok(false)
}

/// Whether `path` is a folder, and no link to one.
fn is_folder(path: &Path) -> Result<bool, GraderError> {
    match path.symlink_metadata() {
        Ok(kind) => Ok(kind.is_dir()),
        Err(e) if is_of_the_machine(&e) => Err(GraderError::file("read", path, e)),
        Err(_) => Ok(false),
    }
}
