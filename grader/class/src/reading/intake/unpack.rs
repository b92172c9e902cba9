//! Writes the files of an archive to a temporary folder, within limits.

use super::archive::damage;
use crate::reading::Unreadable;
use crate::reading::content::unreadable;
use base::interrupt::TempFolder;
use std::collections::HashSet;
use std::io::{self, Read, Write};
use std::path::{Component, Path, PathBuf};

/// The most bytes that are written for one submission. A project has less than a tenth of it.
const MAX_BYTES: u64 = 64 << 20;

/// Larger files are left out, unless they are Rust: pictures, videos, build output.
const MAX_OTHER_FILE: u64 = 4 << 20;

/// The most entries of an archive. A forgotten build folder has some ten thousand.
const MAX_ENTRIES: usize = 200_000;

/// The most files and folders that are written. A handout with all its libraries has 30,000. They
/// are removed again, which takes longer than writing them.
const MAX_WRITTEN: usize = 50_000;

/// The most of them that are folders: paths of 200 folders each would be millions.
const MAX_FOLDERS: usize = 10_000;

/// The longest path of an entry, in bytes: longer than any project's, shorter than a system's.
const MAX_PATH: usize = 512;

/// Folders that no submission is graded by. They are not unpacked.
const LEFT_OUT: [&str; 4] = ["target", ".git", "__MACOSX", "node_modules"];

/// How many files of a kind are named.
const NAMED: usize = 3;

/// The first of these names, and how many more there are.
pub(super) fn named(paths: &[String]) -> String {
    let named = paths.get(..NAMED).unwrap_or(paths).join(", ");
    match paths.len().saturating_sub(NAMED) {
        0 => named,
        more => format!("{named} and {more} more"),
    }
}

/// Writes files below a temporary folder. It never makes a link, so no path leads out of it.
#[derive(Debug)]
pub(super) struct Unpacker {
    folder: TempFolder,
    entries: usize,
    bytes: u64,
    files: usize,
    /// The folders that were made.
    folders: HashSet<PathBuf>,
    links: Vec<String>,
    large: Vec<String>,
}

impl Unpacker {
    pub(super) fn new(folder: TempFolder) -> Unpacker {
        Unpacker {
            folder,
            entries: 0,
            bytes: 0,
            files: 0,
            folders: HashSet::new(),
            links: Vec::new(),
            large: Vec::new(),
        }
    }

    /// Checks the path of the next entry. Returns where to write it; `None` if it is left out.
    pub(super) fn path(&mut self, name: &str) -> Result<Option<PathBuf>, Unreadable> {
        self.entries += 1;
        if self.entries > MAX_ENTRIES {
            return Err(Unreadable::TooLarge(format!(
                "contains more than {MAX_ENTRIES} files: expected the folder stages"
            )));
        }
        let refused = |why: &str| {
            let shown: String = name.chars().take(80).flat_map(char::escape_debug).collect();
            Err(Unreadable::Damaged(format!(
                "contains the path {shown}, {why}: refused. Ask for an archive that was made anew"
            )))
        };
        if name.len() > MAX_PATH {
            return refused(&format!("which is longer than {MAX_PATH} bytes"));
        }
        if name.contains('\0') {
            return refused("which contains a zero byte");
        }
        // Some programs on Windows write `\`, and a path may begin with a drive there.
        let name = name.replace('\\', "/");
        let is_drive = |part: &str| part.len() == 2 && part.ends_with(':');
        if name.starts_with('/') || name.split('/').next().is_some_and(is_drive) {
            return refused("which is absolute");
        }
        let mut path = PathBuf::new();
        for part in Path::new(&name).components() {
            match part {
                Component::Normal(part) if LEFT_OUT.iter().any(|left_out| part == *left_out) => {
                    return Ok(None);
                }
                Component::Normal(part) => path.push(part),
                Component::CurDir => {}
                _ => return refused("which leads out of the archive"),
            }
        }
        Ok((!path.as_os_str().is_empty()).then_some(path))
    }

    /// Counts a link, which is not unpacked.
    pub(super) fn link(&mut self, path: &Path) {
        self.links.push(path.display().to_string());
    }

    /// Whether a file of this size is unpacked. Remembers it if not.
    pub(super) fn wants(&mut self, path: &Path, size: u64) -> bool {
        let is_source = path.extension().is_some_and(|extension| extension == "rs");
        let wanted = is_source || size <= MAX_OTHER_FILE;
        if !wanted {
            self.large.push(path.display().to_string());
        }
        wanted
    }

    /// Writes a file. Counts the bytes that arrive, whatever the archive says about its size.
    pub(super) fn write(&mut self, path: &Path, contents: impl Read) -> Result<(), Unreadable> {
        let full = self.folder.path().join(path);
        let failed = |e: io::Error| {
            let clash = "another entry is in its place. Ask for an archive that was made anew";
            unreadable("write", &full, &e, || {
                format!(
                    "contains {}, which cannot be written: {clash}",
                    path.display()
                )
            })
        };
        self.files += 1;
        self.create_folders(path, &failed)?;
        let mut file = std::fs::File::create(&full).map_err(failed)?;
        let mut contents = contents.take(MAX_BYTES - self.bytes + 1);
        let mut chunk = [0; 1 << 16];
        loop {
            let read = contents.read(&mut chunk).map_err(|e| {
                unreadable("read", path, &e, || {
                    format!("is damaged at {}: {}", path.display(), damage(&e))
                })
            })?;
            if read == 0 {
                return Ok(());
            }
            self.bytes += read as u64;
            if self.bytes > MAX_BYTES {
                return Err(Unreadable::TooLarge(format!(
                    "unpacks to more than {} MB: expected the folder stages, without build output",
                    MAX_BYTES >> 20
                )));
            }
            file.write_all(&chunk[..read]).map_err(failed)?;
        }
    }

    /// Creates the folders above `path` that are missing.
    fn create_folders(
        &mut self,
        path: &Path,
        failed: &dyn Fn(io::Error) -> Unreadable,
    ) -> Result<(), Unreadable> {
        let above = path.ancestors().skip(1);
        let mut missing: Vec<&Path> = above
            .take_while(|folder| !folder.as_os_str().is_empty() && !self.folders.contains(*folder))
            .collect();
        while let Some(folder) = missing.pop() {
            self.folders.insert(folder.to_path_buf());
            self.check_counts()?;
            match std::fs::create_dir(self.folder.path().join(folder)) {
                // The disk may take `A` for `a`. If it is a file, writing below it says so.
                Err(e) if e.kind() == io::ErrorKind::AlreadyExists => {}
                created => created.map_err(failed)?,
            }
        }
        self.check_counts()
    }

    /// Returns an error if there are too many files or folders.
    fn check_counts(&self) -> Result<(), Unreadable> {
        let folders = self.folders.len();
        let (most, what) = match (folders > MAX_FOLDERS, self.files + folders > MAX_WRITTEN) {
            (true, _) => (MAX_FOLDERS, "folders"),
            (_, true) => (MAX_WRITTEN, "files and folders"),
            _ => return Ok(()),
        };
        Err(Unreadable::TooLarge(format!(
            "contains more than {most} {what}: expected the folder stages"
        )))
    }

    /// The folder, and sentences about what was left out.
    pub(super) fn finish(self) -> (TempFolder, Vec<String>) {
        let mut notes = Vec::new();
        if !self.links.is_empty() {
            notes.push(format!("links were left out: {}", named(&self.links)));
        }
        if !self.large.is_empty() {
            notes.push(format!("large files were left out: {}", named(&self.large)));
        }
        (self.folder, notes)
    }
}
