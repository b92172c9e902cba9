//! Files that appear under their name when they are complete.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// A file in progress. It is written under a temporary name in the same folder and renamed when it
/// is complete: readers never see a part of it, and an old file stays until then. Dropping it
/// before removes the temporary file.
#[derive(Debug)]
pub struct PartFile {
    path: PathBuf,
    temporary: PathBuf,
    file: File,
}

impl PartFile {
    /// Creates the temporary file for `path`.
    pub fn create(path: &Path) -> io::Result<PartFile> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let temporary = path.with_file_name(format!(".{name}.{}.part", std::process::id()));
        Ok(PartFile {
            path: path.to_owned(),
            file: File::create(&temporary)?,
            temporary,
        })
    }

    /// The final path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The file to write to.
    pub fn file(&self) -> &File {
        &self.file
    }

    /// Writes everything to disk and renames the file to its final path.
    pub fn finish(&self) -> io::Result<()> {
        self.file.sync_all()?;
        fs::rename(&self.temporary, &self.path)
    }
}

impl Drop for PartFile {
    /// Removes the temporary file, which no longer exists after [`PartFile::finish`].
    fn drop(&mut self) {
        // It may be gone already, and an error cannot be returned from here.
        let _ = fs::remove_file(&self.temporary);
    }
}
