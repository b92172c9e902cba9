//! Files that appear under their name when they are complete.

use std::ffi::OsStr;
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
    /// Creates the temporary file for `path`. Removes those for `path` that programs have left
    /// which were killed.
    pub fn create(path: &Path) -> io::Result<PartFile> {
        remove_left(path);
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let temporary = path.with_file_name(format!(".{name}.{}.part", std::process::id()));
        let file = File::create(&temporary)?;
        // It ends with the program, however that ends. A disk without locks keeps what is left.
        let _ = file.try_lock();
        Ok(PartFile {
            path: path.to_owned(),
            file,
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

/// Removes the temporary files for `path` that no program writes any more.
fn remove_left(path: &Path) {
    let folder = path.parent().filter(|folder| *folder != Path::new(""));
    let start = format!(".{}.", path.file_name().unwrap_or_default().display());
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let is_for_path = |name: &OsStr| {
        let name = name.to_string_lossy();
        let number = name.strip_prefix(&start);
        number
            .and_then(|rest| rest.strip_suffix(".part"))
            .is_some_and(is_number)
    };
    let entries = fs::read_dir(folder.unwrap_or(Path::new(".")));
    for entry in entries.into_iter().flatten().flatten() {
        let is_regular = entry.file_type().is_ok_and(|kind| kind.is_file());
        if is_regular
            && is_for_path(&entry.file_name())
            && File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok())
        {
            let _ = fs::remove_file(entry.path());
        }
    }
}

impl Drop for PartFile {
    /// Removes the temporary file, which no longer exists after [`PartFile::finish`].
    fn drop(&mut self) {
        // It may be gone already, and an error cannot be returned from here.
        let _ = fs::remove_file(&self.temporary);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_killed_program_has_left_is_removed() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a.png");
        let names = || {
            let entries = fs::read_dir(folder.path()).expect("a folder");
            let names = entries.map(|entry| entry.expect("an entry").file_name());
            let mut names: Vec<String> = names
                .map(|name| name.to_string_lossy().into_owned())
                .collect();
            names.sort();
            names
        };
        let kept = [".a.png.x.part", ".b.png.7.part", "a.png.7.part"];
        for name in kept.iter().chain(&[".a.png.7.part", ".a.png.8.part"]) {
            fs::write(folder.path().join(name), b"").expect("a file");
        }
        let running = File::open(folder.path().join(".a.png.8.part")).expect("a file");
        running.lock().expect("a lock");
        let part = PartFile::create(&path).expect("a file");
        let own = format!(".a.png.{}.part", std::process::id());
        let mut expected = [&kept[..], &[".a.png.8.part", &own]].concat();
        expected.sort_unstable();
        assert_eq!(names(), expected);
        part.finish().expect("it is written");
        assert!(names().contains(&"a.png".to_owned()));
    }
}
