//! The folder in which cargo builds a workspace's stages.
//!
//! Cargo names what it builds by the path of the package *inside* its workspace, and rebuilds it
//! only if a file is newer than the last build. So two handouts that share a target folder (for
//! example by `CARGO_TARGET_DIR`) look the same to cargo, and the stages of one would be graded as
//! those of the other. Therefore a workspace whose target folder is outside the workspace builds
//! its stages in its own subfolder of the target folder.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

/// The folder in which to build the stages of the workspace `root`; `None` for cargo's default.
pub(crate) fn of(root: &Path) -> Option<PathBuf> {
    // The grader itself was built in the shared folder: target/release/grader.
    let program = std::env::current_exe().ok()?;
    let shared = program.parent()?.parent()?;
    apart(shared, root)
}

/// A folder below `shared` for the workspace `root` alone; `None` if `shared` is inside that
/// workspace.
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
