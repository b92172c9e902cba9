//! The lock file of a workspace that has lost some of its crates.

use crate::file_tree::{self, Files};
use grader::compile;
use grader::error::GraderError;
use grader::interrupt;
use std::path::Path;
use std::process::Command;

/// Has cargo take what `files` do not use out of their `Cargo.lock`, so that they build `--locked`. Versions stay.
pub fn mend(files: &mut Files) -> Result<(), GraderError> {
    let scratch = interrupt::temp_folder()?;
    file_tree::make_equal(scratch.path(), files)?;
    let output = Command::new(compile::cargo())
        .current_dir(scratch.path())
        .args(["update", "--workspace", "--offline", "--quiet"])
        .output();
    let output = output.map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
    if !output.status.success() {
        return Err(GraderError::new(format!(
            "cargo does not understand the workspace without the crates that are left out:\n{}",
            String::from_utf8_lossy(&output.stderr).trim()
        )));
    }
    let lock = Path::new("Cargo.lock");
    files.insert(lock.into(), file_tree::read(scratch.path(), lock)?);
    Ok(())
}
