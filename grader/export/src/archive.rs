//! Packs files as a zip: the same files give the same bytes.

use crate::systems::ExportedFile;
use base::GraderError;
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

/// The bytes of a zip with these files at its root.
pub fn zip(files: &[ExportedFile]) -> Result<Vec<u8>, GraderError> {
    let failed = |e: &dyn std::fmt::Display| GraderError::new(format!("cannot make the zip: {e}"));
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for file in files {
        let mode = if file.is_executable { 0o755 } else { 0o644 };
        // Without a time of its own each entry is of 1980.
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(zip::DateTime::default())
            .unix_permissions(mode);
        let name = grader::course::sources::with_slashes(&file.path);
        writer.start_file(name, options).map_err(|e| failed(&e))?;
        writer.write_all(&file.contents).map_err(|e| failed(&e))?;
    }
    let bytes = writer.finish().map_err(|e| failed(&e))?;
    Ok(bytes.into_inner())
}
