//! Prints reports: as a [`table`] for people, as JSON for programs.

mod speedups;
pub mod table;

use crate::error::{GraderError, without_path};
use serde::Serialize;
use std::io::Write;
use std::path::Path;

/// Formats a report as one JSON object.
pub fn json(report: &impl Serialize) -> Result<String, GraderError> {
    serde_json::to_string_pretty(report)
        .map_err(|e| GraderError::new(format!("cannot write the report as JSON: {e}")))
}

/// Writes `text` to the file `path` atomically: on an error the old file stays as it was.
pub fn write_whole(path: &Path, text: &[u8]) -> Result<(), GraderError> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let failed = |e: &std::io::Error| GraderError::file("write", path, without_path(e));
    let mut file = tempfile::Builder::new();
    // Temporary files are readable by their owner only; reports get the usual permissions.
    #[cfg(unix)]
    file.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = file.tempfile_in(folder).map_err(|e| failed(&e))?;
    file.write_all(text).map_err(|e| failed(&e))?;
    file.persist(path).map_err(|e| failed(&e.error))?;
    Ok(())
}
