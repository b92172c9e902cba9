//! Writes a class as JPlag reads it: a folder for each student, and the text that all were given.
//! JPlag (Karlsruhe Institute of Technology) compares syntax trees and has its own viewer.

use base::{GraderError, shell_word, write_whole};
use files::file_tree::Files;
use std::path::Path;

/// Writes `files` of a stage, those of one student or those that all were given, below `folder`.
pub fn write(folder: &Path, stage: &str, files: &Files) -> Result<(), GraderError> {
    for (path, text) in files {
        let path = folder.join(stage).join(path);
        let parent = path.parent().unwrap_or(folder);
        std::fs::create_dir_all(parent).map_err(|e| GraderError::file("create", parent, e))?;
        write_whole(&path, text)?;
    }
    Ok(())
}

/// The command that compares them.
pub fn command(folder: &Path) -> String {
    let [given, submissions] = ["given", "submissions"].map(|name| shell_word(folder.join(name)));
    format!("java -jar jplag.jar -l rust --base-code {given} {submissions}")
}
