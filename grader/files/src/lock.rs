//! Updates the lock file of a workspace from which crates were removed.

use crate::file_tree::{self, Files};
use crate::manifest;
use base::{GraderError, interrupt};
use std::path::Path;

/// Removes what `files` do not use from their `Cargo.lock`, so that they build with `--locked`, and
/// from the profiles in their `Cargo.toml`. The versions of the other packages stay the same.
pub fn remove_unused(files: &mut Files) -> Result<(), GraderError> {
    let scratch = interrupt::temp_folder()?;
    for (path, contents) in &*files {
        // Cargo reads manifests, and looks whether source files are there.
        let contents: &[u8] = match path.extension().and_then(|end| end.to_str()) {
            Some("toml" | "lock") => contents,
            Some("rs") => &[],
            _ => continue,
        };
        file_tree::write(&scratch.path().join(path), contents)?;
    }
    crate::cargo(
        scratch.path(),
        &["update", "--workspace", "--offline", "--quiet"],
        "cargo cannot read the workspace after some of its crates were removed",
    )?;
    let path = Path::new("Cargo.lock");
    let lock = file_tree::read(scratch.path(), path)?;
    if let Some(manifest) = files.get_mut(Path::new("Cargo.toml")) {
        let [text, lock] = [&*manifest, &lock].map(|file| String::from_utf8_lossy(file));
        *manifest = manifest::without_unused_profiles(&text, &lock).into_bytes();
    }
    files.insert(path.into(), lock);
    Ok(())
}
