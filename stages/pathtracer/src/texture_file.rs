//! Finds the file of a texture. Scene files are often moved without their textures' paths being
//! changed, or come from systems that do not tell apart small and capital letters.

use std::io;
use std::path::{Component, Path, PathBuf};

/// Reads the file that a scene in `folder` calls `path`, or one that was moved with the scene.
/// Returns which file it is.
pub fn read_texture(folder: &Path, path: &str) -> (PathBuf, io::Result<Vec<u8>>) {
    if let Some(found) = find(folder, path) {
        let bytes = std::fs::read(&found);
        return (found, bytes);
    }
    // What is not a file, such as a device, may have no end: it is not opened.
    let given = folder.join(path);
    let why = std::fs::metadata(&given).err();
    let why = why.unwrap_or_else(|| io::Error::other("it is not a file"));
    (given, Err(why))
}

/// The file that a scene in `folder` calls `path`. If there is none, the one in `folder` whose path
/// agrees with the end of `path`, as far as possible, apart from small and capital letters.
fn find(folder: &Path, path: &str) -> Option<PathBuf> {
    let given = folder.join(path);
    if given.is_file() {
        return Some(given);
    }
    let mut names: Vec<String> = Vec::new();
    for component in Path::new(path).components() {
        match component {
            Component::Normal(name) => names.push(name.to_str()?.to_lowercase()),
            Component::CurDir => {}
            // What is before it says nothing about a place below `folder`.
            _ => names.clear(),
        }
    }
    (0..names.len()).find_map(|start| below(folder, &names[start..]))
}

/// The file below `folder` with these names of folders and of itself, in lower case.
fn below(folder: &Path, names: &[String]) -> Option<PathBuf> {
    let (name, rest) = names.split_first()?;
    let entries = std::fs::read_dir(if folder == Path::new("") {
        Path::new(".")
    } else {
        folder
    });
    let mut found: Vec<_> = entries
        .ok()?
        .filter_map(|entry| Some(entry.ok()?.file_name()))
        .filter(|other| {
            other
                .to_str()
                .is_some_and(|other| other.to_lowercase() == *name)
        })
        .collect();
    // Not in the order of the disk.
    found.sort();
    found
        .into_iter()
        .map(|name| folder.join(name))
        .find_map(|path| {
            if rest.is_empty() {
                path.is_file().then_some(path)
            } else {
                below(&path, rest)
            }
        })
}

#[cfg(test)]
mod tests {
    use super::{find, read_texture};
    use std::fs;
    use std::path::PathBuf;

    #[test]
    fn a_texture_that_was_moved_with_its_scene_is_found() {
        let folder = tempfile::tempdir().expect("a folder");
        let folder = folder.path();
        fs::create_dir(folder.join("my textures")).expect("a folder");
        let wall = folder.join("my textures/Wall.png");
        fs::write(&wall, "").expect("a file");
        let other = folder.join("wall.png");
        for path in [
            "my textures/Wall.png",
            "My Textures/wall.PNG",
            "C:/Users/me/my textures/Wall.png",
            "/home/me/my textures/Wall.png",
            "../export/my textures/Wall.png",
        ] {
            assert_eq!(find(folder, path), Some(wall.clone()), "{path}");
        }
        // The one whose folder has the right name, too, and only if there is none, the other.
        fs::write(&other, "").expect("a file");
        assert_eq!(find(folder, "C:/my textures/Wall.png"), Some(wall));
        assert_eq!(find(folder, "C:/textures/Wall.png"), Some(other));
        for path in [
            "",
            "..",
            "floor.png",
            "my textures",
            "my textures/floor.png",
        ] {
            assert_eq!(find(folder, path), None::<PathBuf>, "{path}");
        }
    }

    #[test]
    fn what_is_not_a_file_is_not_opened() {
        let folder = tempfile::tempdir().expect("a folder");
        let devices: &[&str] = if cfg!(unix) { &["/dev/zero"] } else { &[] };
        for path in ["", "."].iter().chain(devices) {
            let (_, bytes) = read_texture(folder.path(), path);
            let why = bytes.expect_err("not a file").to_string();
            assert_eq!(why, "it is not a file", "{path}");
        }
    }
}
