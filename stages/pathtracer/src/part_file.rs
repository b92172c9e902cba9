//! Files that appear when they are whole.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// A file to be. It is written beside its place and moved there when it is whole, so that whoever reads it never sees half
/// of it, and an old one stays until then. Dropped before, it leaves nothing.
#[derive(Debug)]
pub struct PartFile {
    path: PathBuf,
    temporary: PathBuf,
    file: File,
}

impl PartFile {
    /// Makes sure that a file can be written beside `path`.
    pub fn create(path: &Path) -> io::Result<PartFile> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let temporary = path.with_file_name(format!(".{name}.{}.part", std::process::id()));
        Ok(PartFile {
            path: path.to_owned(),
            file: File::create(&temporary)?,
            temporary,
        })
    }

    /// Where it is to be.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is in it so far.
    pub fn file(&self) -> &File {
        &self.file
    }

    /// Puts it in its place, once all of it is on the disk.
    pub fn finish(&self) -> io::Result<()> {
        self.file.sync_all()?;
        fs::rename(&self.temporary, &self.path)
    }
}

impl Drop for PartFile {
    /// Takes the unfinished file away; after [`PartFile::finish`] there is none.
    fn drop(&mut self) {
        // It may be gone already, and there is nobody to tell.
        let _ = fs::remove_file(&self.temporary);
    }
}
