//! Opens a submission as it was handed in: a folder, an archive, or a git clone, perhaps a folder
//! too deep. Nothing of it is run, and nothing is written outside a temporary folder.

mod archive;
mod git;
mod layout;
mod unpack;

pub use git::{CommitTimes, Revision};

use super::content::Unreadable;
use base::GraderError;
use base::interrupt::{self, TempFolder};
use std::path::{Path, PathBuf};
use unpack::Unpacker;

/// A submission whose files can be read.
#[derive(Debug)]
pub struct Opened {
    /// The folder that contains `stages`, or the folders of the stages.
    pub root: PathBuf,
    /// What was unusual about the form that it came in, as sentences.
    pub notes: Vec<String>,
    /// When its commit was made, if it is one of a clone.
    pub commit: Option<CommitTimes>,
    /// What was unpacked; removed when this is dropped.
    _unpacked: Vec<TempFolder>,
}

/// How many archives inside each other are opened: systems wrap what a student zipped.
const MAX_NESTED: usize = 3;

/// Opens the folder or file `path`. `stages` are the names of the course's stages. With a
/// `revision`, the files come from the history of a git clone.
pub fn open(
    path: &Path,
    stages: &[&str],
    revision: Option<&Revision>,
) -> Result<Opened, Unreadable> {
    let mut notes = Vec::new();
    let mut unpacked = Vec::new();
    let mut commit = None;
    let changed = uncommitted(path)?;
    let mut path = path.to_path_buf();
    if !changed.is_empty() {
        let are_graded = match revision {
            None => "are graded",
            Some(_) => "are not graded",
        };
        notes.push(format!(
            "changes that are in no commit {are_graded}: {changed}"
        ));
    }
    if let Some(revision) = revision {
        let mut unpacker = Unpacker::new(temp_folder()?);
        commit = Some(git::unpack(&path, revision, &mut unpacker)?);
        path = finish(unpacker, &mut notes, &mut unpacked);
    }
    for _ in 0..=MAX_NESTED {
        if !path.is_dir() {
            let mut unpacker = Unpacker::new(temp_folder()?);
            archive::unpack(&path, &mut unpacker)?;
            path = finish(unpacker, &mut notes, &mut unpacked);
        }
        match layout::find(&path, stages)? {
            layout::Found::Root(root) => {
                if let Ok(below) = root.strip_prefix(&path)
                    && !below.as_os_str().is_empty()
                {
                    notes.push(format!("its files are in the folder {}", below.display()));
                }
                return Ok(Opened {
                    root,
                    notes,
                    commit,
                    _unpacked: unpacked,
                });
            }
            layout::Found::Archive(inner) => {
                if let Some(name) = inner.file_name() {
                    notes.push(format!("its files are in the archive {}", name.display()));
                }
                path = inner;
            }
        }
    }
    Err(Unreadable::Damaged(format!(
        "contains archives inside archives, more than {MAX_NESTED} deep: expected the folder stages"
    )))
}

/// The source files of the clone in `folder` with changes that are in no commit, as a list of names.
fn uncommitted(folder: &Path) -> Result<String, GraderError> {
    if !folder.is_dir() {
        return Ok(String::new());
    }
    let changed = git::uncommitted(folder, Unpacker::new(temp_folder()?));
    Ok(unpack::named(&changed))
}

/// Keeps what was unpacked, and returns its folder.
fn finish(unpacker: Unpacker, notes: &mut Vec<String>, unpacked: &mut Vec<TempFolder>) -> PathBuf {
    let (folder, new) = unpacker.finish();
    notes.extend(new);
    let path = folder.path().to_path_buf();
    unpacked.push(folder);
    path
}

fn temp_folder() -> Result<TempFolder, GraderError> {
    interrupt::temp_folder()
}
