//! Helpers of several tests.

use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the course's own scenes.
pub(crate) fn own_scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/dae")
}

/// The scene files in `folders`, sorted. There has to be at least one.
pub(crate) fn scene_files(folders: &[PathBuf]) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = folders
        .iter()
        .flat_map(|folder| fs::read_dir(folder).expect("a folder of scenes"))
        .map(|file| file.expect("a file").path())
        .filter(|file| file.extension().is_some_and(|end| end == "dae"))
        .collect();
    files.sort();
    assert!(!files.is_empty(), "no scenes in {folders:?}");
    files
}
