//! Applies the settings of a term to the files of First Light.

mod book;
mod list;

use super::own_case;
use super::settings::Changes;
use base::GraderError;
use files::file_tree::Files;
use grader::course::Course;
use judge::own_cases;
use std::path::{Path, PathBuf};

/// The list of parts, tasks and points.
const COURSE: &str = "stages/course.toml";

/// The folder of the scene files.
const SCENES: &str = "scenes/dae";

/// A file that a term changed or added.
#[derive(Clone, Debug)]
pub struct Written {
    /// Its path.
    pub path: PathBuf,
    /// Its contents in First Light; `None` if the term added it.
    pub original: Option<Vec<u8>>,
}

/// Applies `changes` to `files`, those of First Light. Returns the files that it changed or added.
pub fn apply(files: &mut Files, changes: &Changes) -> Result<Vec<Written>, GraderError> {
    let list = List::with_changes(files, changes)?;
    let mut written = Vec::new();
    let mut write = |files: &mut Files, path: PathBuf, contents: Vec<u8>| {
        if files.get(&path) != Some(&contents) {
            let original = files.insert(path.clone(), contents);
            written.push(Written { path, original });
        }
    };
    write(files, COURSE.into(), list.text.into_bytes());
    for (path, contents) in book::with_changes(files, &list.before, &list.after, &changes.front)? {
        write(files, path, contents.into_bytes());
    }
    let cases = changes.cases.iter().filter_map(|(name, case)| {
        let (task, name) = name.split_once('/')?;
        Some(own_case::judged(task, name, case))
    });
    let cases = own_cases::text(&Vec::from_iter(cases));
    write(files, own_cases::FILE.into(), cases.into_bytes());
    for (task, mistakes) in &changes.mistakes {
        for (path, contents) in mistakes.applied(task, files)? {
            write(files, path, contents);
        }
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

/// The course of First Light's `files` with `changes`, without applying them.
pub fn course(files: &Files, changes: &Changes) -> Result<Course, GraderError> {
    Ok(List::with_changes(files, changes)?.after)
}

/// The list of parts, tasks and points with the changes of a term.
struct List {
    text: String,
    /// The course of First Light.
    before: Course,
    /// The course of `text`.
    after: Course,
}

impl List {
    fn with_changes(files: &Files, changes: &Changes) -> Result<List, GraderError> {
        let original = text(files, Path::new(COURSE))?;
        let before = Course::parse(&original)?;
        let text = list::with_changes(&original, &before, changes)?;
        let after = Course::parse(&text).map_err(|e| {
            GraderError::new(format!("course.toml cannot be applied to First Light: {e}"))
        })?;
        Ok(List {
            text,
            before,
            after,
        })
    }
}

/// The text of a file.
fn text(files: &Files, path: &Path) -> Result<String, GraderError> {
    let contents = files
        .get(path)
        .ok_or_else(|| GraderError::new(format!("First Light has no {}", path.display())))?;
    String::from_utf8(contents.clone())
        .map_err(|_| GraderError::new(format!("{} is not UTF-8 text", path.display())))
}
