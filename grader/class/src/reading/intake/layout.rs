//! Finds the project in a folder: it may be a folder too deep, or in an archive in the folder.

use super::archive;
use crate::reading::Unreadable;
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
    let mut archives = Vec::new();
    let mut seen = Vec::new();
    let mut folders = 0;
    for _ in 0..=MAX_DEPTH {
        let roots: Vec<&PathBuf> = level.iter().filter(|path| is_root(path, stages)).collect();
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
            // What cannot be listed contains nothing that can be graded.
            let Ok(entries) = std::fs::read_dir(path) else {
                continue;
            };
            for entry in entries.flatten() {
                let name = entry.file_name();
                let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
                if path == folder && seen.len() < NAMED {
                    seen.push(name.display().to_string());
                }
                if is_folder && SKIPPED.iter().all(|skipped| name != *skipped) {
                    next.push(entry.path());
                } else if !is_folder && matches!(archive::form(&entry.path()), Ok(Some(_))) {
                    archives.push(entry.path());
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
    seen.sort();
    let found = match seen.as_slice() {
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
fn is_root(folder: &Path, stages: &[&str]) -> bool {
    let above = [folder.join("stages"), folder.to_path_buf()];
    above.iter().any(|above| {
        let is_folder = |path: &Path| path.symlink_metadata().is_ok_and(|kind| kind.is_dir());
        let mut stages = stages.iter().map(|stage| above.join(stage));
        is_folder(above) && stages.any(|stage| is_folder(&stage.join("src")))
    })
}
