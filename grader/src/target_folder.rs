//! Which folder cargo builds a workspace's stages in.
//!
//! Cargo names what it builds by the package's place *inside* its workspace, and takes it for fresh by the time of
//! its last change. So two handouts that share a target folder (with `CARGO_TARGET_DIR`, say) look the same to cargo,
//! and the stages of one would be graded as the other's. A workspace whose target folder is somewhere else therefore
//! builds its stages in a folder of its own below it.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

/// The folder to build the stages of the workspace `root` in, if it must not be cargo's default one.
pub(crate) fn of(root: &Path) -> Option<PathBuf> {
    // The grader itself was built in the shared folder: target/release/grader.
    let program = std::env::current_exe().ok()?;
    let shared = program.parent()?.parent()?;
    apart(shared, root)
}

/// A folder below `shared` for the workspace `root` alone; `None` if `shared` belongs to that workspace anyway.
fn apart(shared: &Path, root: &Path) -> Option<PathBuf> {
    if shared.starts_with(root) {
        return None;
    }
    let mut hasher = DefaultHasher::new();
    root.hash(&mut hasher);
    Some(shared.join(format!("workspace-{:016x}", hasher.finish())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn workspaces_that_share_a_folder_build_apart() {
        let of = |shared: &str, root: &str| apart(Path::new(shared), Path::new(root));
        assert_eq!(of("/home/me/course/target", "/home/me/course"), None);
        let [a, b] = ["/home/me/a", "/home/me/b"].map(|root| of("/tmp/target", root));
        assert!(a.is_some() && a != b);
        assert_eq!(a, of("/tmp/target", "/home/me/a"));
    }
}
