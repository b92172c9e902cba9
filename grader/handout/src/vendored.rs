//! A handout with the sources of its libraries: it builds without a network.

use base::{GraderError, child_processes};
use std::path::Path;
use std::process::{Command, Stdio};

/// What cargo's settings say, so that it takes libraries from this folder alone.
pub(super) const SETTINGS: &str = "
# Every library is in vendor/: cargo downloads nothing.
[source.crates-io]
replace-with = \"vendored-sources\"

[source.vendored-sources]
directory = \"vendor\"
";

/// The folder of the sources.
const FOLDER: &str = "vendor";

/// Copies the sources of all libraries of the lock file into the project `root`.
pub(super) fn add(root: &Path) -> Result<(), GraderError> {
    let output = Command::new(child_processes::cargo())
        .current_dir(root)
        .args(["vendor", "--locked", "--versioned-dirs", FOLDER])
        .stdin(Stdio::null())
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .output();
    let output = output.map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
    match output.status.success() {
        true => Ok(()),
        false => Err(GraderError::new(format!(
            "`cargo vendor` failed: {}",
            String::from_utf8_lossy(&output.stderr).trim()
        ))),
    }
}

/// The size of the sources in the project `root`, in MB.
pub fn megabytes(root: &Path) -> u64 {
    base::bytes_below(&root.join(FOLDER)).div_ceil(1 << 20)
}
