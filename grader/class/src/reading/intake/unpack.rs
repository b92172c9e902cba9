//! Writes the files of an archive to a temporary folder, within limits.

use crate::reading::Unreadable;
use base::GraderError;
use base::interrupt::TempFolder;
use std::io::{self, Read, Write};
use std::path::{Component, Path, PathBuf};

/// The most bytes that are written for one submission. A project has less than a tenth of it.
const MAX_BYTES: u64 = 64 << 20;

/// Larger files are left out, unless they are Rust: pictures, videos, build output.
const MAX_OTHER_FILE: u64 = 4 << 20;

/// The most entries of an archive. A forgotten build folder has some ten thousand.
const MAX_ENTRIES: usize = 200_000;

/// The longest path of an entry, in bytes: longer than any project's, shorter than a system's.
const MAX_PATH: usize = 512;

/// Folders that no submission is graded by. They are not unpacked.
const LEFT_OUT: [&str; 3] = ["target", ".git", "__MACOSX"];

/// How many links are named.
const NAMED_LINKS: usize = 3;

/// Writes files below a temporary folder. It never makes a link, so no path leads out of it.
#[derive(Debug)]
pub(super) struct Unpacker {
    folder: TempFolder,
    entries: usize,
    bytes: u64,
    links: Vec<String>,
    large: Vec<String>,
}

impl Unpacker {
    pub(super) fn new(folder: TempFolder) -> Unpacker {
        Unpacker {
            folder,
            entries: 0,
            bytes: 0,
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
        let failed = |e: io::Error| match e.kind() {
            io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
                GraderError::file("write", &full, e).into()
            }
            _ => Unreadable::Damaged(format!(
                "contains {}, which cannot be written: {e}",
                path.display()
            )),
        };
        if let Some(parent) = full.parent() {
            std::fs::create_dir_all(parent).map_err(failed)?;
        }
        let mut file = std::fs::File::create(&full).map_err(failed)?;
        let mut contents = contents.take(MAX_BYTES - self.bytes + 1);
        let mut chunk = [0; 1 << 16];
        loop {
            let read = contents.read(&mut chunk).map_err(|e| {
                Unreadable::Damaged(format!("is damaged at {}: {e}", path.display()))
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

    /// The folder, and sentences about what was left out.
    pub(super) fn finish(self) -> (TempFolder, Vec<String>) {
        let mut notes = Vec::new();
        let named = |paths: &[String]| {
            let named: Vec<&str> = paths.iter().take(NAMED_LINKS).map(String::as_str).collect();
            let more = paths.len().saturating_sub(NAMED_LINKS);
            let more = if more > 0 {
                format!(" and {more} more")
            } else {
                String::new()
            };
            named.join(", ") + &more
        };
        if !self.links.is_empty() {
            notes.push(format!("links were left out: {}", named(&self.links)));
        }
        if !self.large.is_empty() {
            notes.push(format!("large files were left out: {}", named(&self.large)));
        }
        (self.folder, notes)
    }
}
