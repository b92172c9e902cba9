//! Lists and reads the files of a workspace, and writes a set of files to a folder.

use base::GraderError;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The contents of files, by their paths relative to some folder.
pub type Files = BTreeMap<PathBuf, Vec<u8>>;

/// The paths of the files of the workspace at `root`, relative to it, sorted.
///
/// In a git checkout these are the tracked files that exist, so that an untracked solution is not
/// handed out. Elsewhere they are all files except build output and hidden folders.
pub fn workspace_paths(root: &Path) -> Result<Vec<PathBuf>, GraderError> {
    let mut paths = if root.join(".git").exists() {
        tracked(root)?
    } else {
        let mut found = Vec::new();
        walk(root, Path::new(""), &mut found)?;
        found
    };
    paths.retain(|path| root.join(path).is_file());
    paths.sort();
    Ok(paths)
}

fn tracked(root: &Path) -> Result<Vec<PathBuf>, GraderError> {
    let listed = Command::new("git")
        .current_dir(root)
        .args(["ls-files", "-z", "--cached"])
        .output();
    let listed = listed.map_err(|e| {
        GraderError::new(format!(
            "cannot run git to list the files of {}: {e}",
            root.display()
        ))
    })?;
    if !listed.status.success() {
        return Err(GraderError::new(format!(
            "git cannot list the files of {}: {}",
            root.display(),
            String::from_utf8_lossy(&listed.stderr).trim()
        )));
    }
    let text = String::from_utf8(listed.stdout);
    let text =
        text.map_err(|_| GraderError::new("the name of a tracked file is not UTF-8: rename it"))?;
    Ok(text.split_terminator('\0').map(PathBuf::from).collect())
}

/// Hidden files and folders that belong to a workspace.
const INCLUDED_HIDDEN: [&str; 3] = [".cargo", ".ci", ".gitignore"];

fn walk(root: &Path, below: &Path, found: &mut Vec<PathBuf>) -> Result<(), GraderError> {
    let folder = root.join(below);
    let failed = |e: std::io::Error| GraderError::file("read", &folder, e);
    for entry in std::fs::read_dir(&folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_folder = entry.file_type().map_err(failed)?.is_dir();
        if name.starts_with('.') && !INCLUDED_HIDDEN.contains(&&*name)
            || is_folder && name == "target"
        {
            continue;
        }
        let path = below.join(&*name);
        if is_folder {
            walk(root, &path, found)?;
        } else {
            found.push(path);
        }
    }
    Ok(())
}

/// Reads the file `root/path`.
pub fn read(root: &Path, path: &Path) -> Result<Vec<u8>, GraderError> {
    let path = root.join(path);
    std::fs::read(&path).map_err(|e| GraderError::file("read", &path, e))
}

/// Makes `folder` contain exactly `files`. Files that are up to date are not written again, so that
/// cargo rebuilds only what changed. Folders named `target` are ignored.
pub fn sync_folder(folder: &Path, files: &Files) -> Result<(), GraderError> {
    let mut old = Vec::new();
    if folder.exists() {
        walk(folder, Path::new(""), &mut old)?;
    }
    for path in old.iter().filter(|path| !files.contains_key(*path)) {
        let path = folder.join(path);
        std::fs::remove_file(&path).map_err(|e| GraderError::file("remove", &path, e))?;
    }
    for (path, contents) in files {
        let path = folder.join(path);
        if std::fs::read(&path).is_ok_and(|old| old == *contents) {
            continue;
        }
        write(&path, contents)?;
    }
    Ok(())
}

/// Writes a file, and creates its parent folders.
pub fn write(path: &Path, contents: &[u8]) -> Result<(), GraderError> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|e| GraderError::file("create", folder, e))?;
    }
    std::fs::write(path, contents).map_err(|e| GraderError::file("write", path, e))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn files(names: &[(&str, &str)]) -> Files {
        let file = |(name, text): &(&str, &str)| (PathBuf::from(name), text.as_bytes().to_vec());
        names.iter().map(file).collect()
    }

    #[test]
    fn sync_folder_does_not_rewrite_unchanged_files() {
        let folder = tempfile::tempdir().unwrap();
        sync_folder(
            folder.path(),
            &files(&[("a", "1"), ("b/c", "2"), ("b/d", "3")]),
        )
        .unwrap();
        let modified = |name| {
            std::fs::metadata(folder.path().join(name))
                .unwrap()
                .modified()
                .unwrap()
        };
        let before = modified("a");
        sync_folder(folder.path(), &files(&[("a", "1"), ("b/c", "4")])).unwrap();
        assert_eq!(modified("a"), before);
        assert_eq!(
            workspace_paths(folder.path()).unwrap(),
            [PathBuf::from("a"), PathBuf::from("b/c")]
        );
        assert_eq!(read(folder.path(), Path::new("b/c")).unwrap(), b"4");
    }

    #[test]
    fn build_output_and_hidden_folders_are_not_workspace_files() {
        let folder = tempfile::tempdir().unwrap();
        let all = files(&[
            ("a", ""),
            ("target/x", ""),
            (".secret/x", ""),
            (".cargo/config.toml", ""),
        ]);
        for (path, contents) in &all {
            write(&folder.path().join(path), contents).unwrap();
        }
        assert_eq!(
            workspace_paths(folder.path()).unwrap(),
            [PathBuf::from(".cargo/config.toml"), PathBuf::from("a")]
        );
    }
}
