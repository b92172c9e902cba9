//! A teacher's course: `grader course new`, `build`, `update`.
//!
//! The folder of a term has a few files that say what is different from First Light ([`settings`]),
//! and in [`COPY`] First Light with these differences applied: a full checkout, which all other
//! commands work on. Read [`apply`] (what the settings change in the files of First Light) first,
//! then [`build`] (how the copy is made and made again), [`new`], [`own_case`], [`own_mistakes`]
//! and [`update`].

pub mod apply;
pub mod build;
pub mod new;
pub mod own_case;
pub mod own_mistakes;
pub mod settings;
pub mod update;

use base::GraderError;
pub use base::term::COPY;
use std::path::{Path, PathBuf};

/// The nearest folder of a term at or above `start`: one with a `course.toml` that names the
/// version of First Light.
pub fn above(start: &Path) -> Result<Option<PathBuf>, GraderError> {
    let start = start
        .canonicalize()
        .map_err(|e| GraderError::file("open", start, e))?;
    let found = start.ancestors().find(|folder| {
        let text = std::fs::read_to_string(folder.join("course.toml"));
        text.is_ok_and(|text| text.contains("[first_light]"))
    });
    Ok(found.map(Path::to_path_buf))
}
