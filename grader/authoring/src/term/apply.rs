//! Applies the settings of a term to the files of First Light.

mod book;
mod list;

use super::settings::Changes;
use base::GraderError;
use grader::course::Course;
use std::path::{Path, PathBuf};
use submission::file_tree::Files;

/// The list of parts, tasks and points.
const COURSE: &str = "stages/course.toml";

/// The folder of the scene files.
const SCENES: &str = "scenes/dae";

/// Applies `changes` to `files`, those of First Light. Returns the paths of the files that it
/// changed or added.
pub fn apply(files: &mut Files, changes: &Changes) -> Result<Vec<PathBuf>, GraderError> {
    let original = text(files, Path::new(COURSE))?;
    let before = Course::parse(&original)?;
    let changed = list::with_changes(&original, &before, changes)?;
    let after = Course::parse(&changed).map_err(|e| {
        GraderError::new(format!("course.toml cannot be applied to First Light: {e}"))
    })?;
    let mut written = Vec::new();
    let mut write = |files: &mut Files, path: PathBuf, contents: Vec<u8>| {
        if files.get(&path) != Some(&contents) {
            files.insert(path.clone(), contents);
            written.push(path);
        }
    };
    write(files, COURSE.into(), changed.into_bytes());
    for (path, contents) in book::with_changes(files, &before, &after, &changes.front)? {
        write(files, path, contents.into_bytes());
    }
    for (name, contents) in &changes.scenes {
        let path = Path::new(SCENES).join(name);
        if files.contains_key(&path) {
            return Err(GraderError::new(format!(
                "scenes/{name} has the name of a scene of First Light. Give it another name"
            )));
        }
        write(files, path, contents.clone());
    }
    Ok(written)
}

/// The text of a file.
fn text(files: &Files, path: &Path) -> Result<String, GraderError> {
    let contents = files
        .get(path)
        .ok_or_else(|| GraderError::new(format!("First Light has no {}", path.display())))?;
    String::from_utf8(contents.clone())
        .map_err(|_| GraderError::new(format!("{} is not UTF-8 text", path.display())))
}
