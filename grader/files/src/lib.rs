//! Copies the course, or some crates of it, to another folder: [`file_tree`] (lists, reads and
//! writes files), [`members`] (the list of crates), [`manifest`] (manifests without the other
//! crates), [`lock`] (the lock file without their dependencies).

pub mod file_tree;
pub mod lock;
pub mod manifest;
pub mod members;

use base::{GraderError, child_processes};
use std::path::Path;
use std::process::Command;

/// What cargo prints when it is called with these arguments in `folder`. `failed` says what it
/// cannot do, if it fails.
///
/// # Errors
///
/// Cargo cannot be run, or fails: then its messages follow `failed`.
pub fn cargo(folder: &Path, arguments: &[&str], failed: &str) -> Result<Vec<u8>, GraderError> {
    let mut command = Command::new(child_processes::cargo());
    let output = child_processes::output(command.current_dir(folder).args(arguments))
        .map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
    match output.status.success() {
        true => Ok(output.stdout),
        false => Err(GraderError::new(format!(
            "{failed}:\n{}",
            String::from_utf8_lossy(&output.stderr).trim()
        ))),
    }
}
