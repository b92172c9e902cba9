//! Updates the lock file of a workspace from which crates were removed.

use crate::file_tree::{self, Files};
use grader::compile;
use grader::error::GraderError;
use grader::interrupt;
use std::path::Path;
use std::process::Command;

/// Removes what `files` do not use from their `Cargo.lock`, so that they build with `--locked`. The
/// versions of the other packages stay the same.
pub fn remove_unused(files: &mut Files) -> Result<(), GraderError> {
    let scratch = interrupt::temp_folder()?;
    file_tree::sync_folder(scratch.path(), files)?;
    let output = Command::new(compile::cargo())
        .current_dir(scratch.path())
        .args(["update", "--workspace", "--offline", "--quiet"])
        .output();
    let output = output.map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
    if !output.status.success() {
        return Err(GraderError::new(format!(
            "cargo cannot read the workspace after some of its crates were removed:\n{}",
            String::from_utf8_lossy(&output.stderr).trim()
        )));
    }
    let lock = Path::new("Cargo.lock");
    files.insert(lock.into(), file_tree::read(scratch.path(), lock)?);
    Ok(())
}
