//! Files that are written whole or not at all.

use crate::{GraderError, without_path};
use std::io::{BufWriter, Write};
use std::path::Path;

/// The folder that the new file or folder `path` is written to. Fails if it does not exist.
pub fn folder_of(path: &Path) -> Result<&Path, GraderError> {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    if folder.is_dir() {
        return Ok(folder);
    }
    let cause = match folder.exists() {
        true => format!("{} is not a folder. Name another place", folder.display()),
        false => format!(
            "there is no folder {}. Create it first, or name another place",
            folder.display()
        ),
    };
    Err(GraderError::file("write", path, cause))
}

/// Writes `text` to the file `path` atomically: on an error the old file stays as it was.
pub fn write_whole(path: &Path, text: &[u8]) -> Result<(), GraderError> {
    write_whole_by(path, |file| file.write_all(text))
}

/// The same for what `write` writes piece by piece.
pub fn write_whole_by(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> std::io::Result<()>,
) -> Result<(), GraderError> {
    let folder = folder_of(path)?;
    let failed = |e: &std::io::Error| GraderError::file("write", path, without_path(e));
    let mut file = tempfile::Builder::new();
    // Temporary files are readable by their owner only; reports get the usual permissions.
    #[cfg(unix)]
    file.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = file.tempfile_in(folder).map_err(|e| failed(&e))?;
    let mut buffered = BufWriter::new(file.as_file_mut());
    let written = write(&mut buffered).and_then(|()| buffered.flush());
    drop(buffered);
    written.map_err(|e| failed(&e))?;
    file.persist(path).map_err(|e| failed(&e.error))?;
    Ok(())
}

/// The size of all files below a folder.
pub fn bytes_below(folder: &Path) -> u64 {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let sizes = entries.map(|entry| match entry.metadata() {
        Ok(metadata) if metadata.is_dir() => bytes_below(&entry.path()),
        Ok(metadata) => metadata.len(),
        Err(_) => 0,
    });
    sizes.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_is_written_only_to_a_folder_that_exists() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let missing = folder.path().join("missing");
        let error = write_whole(&missing.join("a.html"), b"").expect_err("no folder");
        let expected = format!("there is no folder {}. Create it first", missing.display());
        assert!(error.to_string().contains(&expected), "{error}");
        write_whole(&missing, b"").expect("a file");
        let error = write_whole(&missing.join("a.html"), b"").expect_err("a file");
        assert!(error.to_string().contains("is not a folder"), "{error}");
    }

    #[test]
    fn the_size_of_a_folder_is_that_of_all_its_files() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("src")).unwrap();
        std::fs::write(folder.path().join("a"), [0; 5]).unwrap();
        std::fs::write(folder.path().join("src/b"), [0; 7]).unwrap();
        assert_eq!(bytes_below(folder.path()), 12);
    }
}
