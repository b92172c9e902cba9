//! Git as a student runs it, whatever is set on this machine.

use std::path::Path;
use std::process::Command;

/// What names a repository: a hook of this one, or `git rebase --exec`, sets them for tests that it
/// runs.
const OF_A_REPOSITORY: [&str; 5] = [
    "GIT_DIR",
    "GIT_WORK_TREE",
    "GIT_INDEX_FILE",
    "GIT_OBJECT_DIRECTORY",
    "GIT_COMMON_DIR",
];

/// Git in `folder`. Its arguments are to be added.
pub(crate) fn command(folder: &Path) -> Command {
    let mut git = Command::new("git");
    for variable in OF_A_REPOSITORY {
        git.env_remove(variable);
    }
    git.env("GIT_CONFIG_GLOBAL", "/dev/null")
        .env("GIT_CONFIG_NOSYSTEM", "1")
        .args(["-c", "user.name=s", "-c", "user.email=s@example"])
        .args(["-c", "init.defaultBranch=main"])
        .current_dir(folder);
    git
}
