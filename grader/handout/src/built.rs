//! What cargo built of the grader in the checkout, for a handout beside it: copied, it is not
//! compiled a second time.
//!
//! Cargo names what it builds by the path of a package inside its workspace, and builds it again if
//! a file of it is newer than the last build. So the copy is current in a handout whose given files
//! have the times of the checkout's. Where they differ from the checkout's, they compute the same:
//! without unit tests, and with a stub or a table (`judge::packed_truth`) for each formula that is
//! a solution. Nothing that is copied names the checkout, which may be moved or deleted.

use crate::Handout;
use base::GraderError;
use files::members;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// The folders, in that of a profile, with what cargo builds: their entries have the hashes of
/// units in their names.
const FOLDERS: [&str; 3] = [".fingerprint", "build", "deps"];

/// Digits of the hash of a unit, which is a crate with its features and settings.
const HASH_DIGITS: usize = 16;

/// Gives the given files of `handout` in `out` the times that they have in `checkout`.
pub fn keep_times(checkout: &Path, handout: &Handout, out: &Path) -> Result<(), GraderError> {
    for path in handout.given() {
        let to = out.join(path);
        // Some are made for the handout.
        if let Ok(original) = fs::metadata(checkout.join(path)) {
            same_time(&original, &to).map_err(|e| GraderError::file("write", &to, e))?;
        }
    }
    Ok(())
}

/// Copies what cargo built of the grader in `checkout` to the target folder of the handout `out`.
pub fn copy(checkout: &Path, out: &Path) -> Result<(), GraderError> {
    let from = target_folder(checkout)?.join("release");
    let to = target_folder(out)?.join("release");
    // With `CARGO_TARGET_DIR` both have one.
    if from == to {
        return Ok(());
    }
    let hashes = hashes_of_the_grader(checkout)?;
    for folder in FOLDERS.map(Path::new) {
        let (from, to) = (from.join(folder), to.join(folder));
        let failed = |e| GraderError::file("copy", &from, e);
        fs::create_dir_all(&to).map_err(failed)?;
        for entry in fs::read_dir(&from).map_err(failed)? {
            let name = entry.map_err(failed)?.file_name();
            let is_of_grader =
                hash_in(&name.to_string_lossy()).is_some_and(|hash| hashes.contains(hash));
            if is_of_grader {
                copy_with_times(&from.join(&name), &to.join(&name)).map_err(failed)?;
            }
        }
    }
    Ok(())
}

/// The folder that cargo builds the project `root` in.
fn target_folder(root: &Path) -> Result<PathBuf, GraderError> {
    let metadata: Value = serde_json::from_slice(&members::metadata(root)?)
        .map_err(|e| GraderError::new(format!("cannot read the output of cargo metadata: {e}")))?;
    let folder = metadata["target_directory"].as_str().map(PathBuf::from);
    folder.ok_or_else(|| GraderError::new("cargo metadata names no target folder"))
}

/// The hashes of the units that the grader consists of. Builds what is not current.
fn hashes_of_the_grader(checkout: &Path) -> Result<BTreeSet<String>, GraderError> {
    let build = [
        "build",
        "--release",
        "--package",
        "grader",
        "--message-format",
        "json",
    ];
    let printed = files::cargo(checkout, &build, "cargo cannot build the grader")?;
    let printed = String::from_utf8_lossy(&printed);
    let messages = printed
        .lines()
        .filter_map(|line| serde_json::from_str::<Value>(line).ok());
    let mut hashes = BTreeSet::new();
    for message in messages {
        let files = message["filenames"].as_array().into_iter().flatten();
        // That of what a build script wrote.
        for path in files
            .chain(message.get("out_dir"))
            .filter_map(Value::as_str)
        {
            let path = Path::new(path);
            let names = path.iter().map(|name| name.to_string_lossy());
            let of_path = names.filter_map(|name| hash_in(&name).map(str::to_string));
            let before = hashes.len();
            hashes.extend(of_path);
            if hashes.len() == before {
                hashes.extend(hash_of_copy(path));
            }
        }
    }
    Ok(hashes)
}

/// The hash in the name of the file in `deps` that cargo copied or linked to `path`, under a name
/// without a hash, because the grader itself was to be built.
fn hash_of_copy(path: &Path) -> Option<String> {
    let start = format!("{}-", path.file_stem()?.to_str()?);
    let contents = fs::read(path).ok()?;
    let entries = fs::read_dir(path.parent()?.join("deps")).ok()?;
    let is_same = |other: &Path| {
        fs::metadata(other).is_ok_and(|it| it.len() == contents.len() as u64)
            && fs::read(other).is_ok_and(|other| other == contents)
    };
    entries.flatten().find_map(|entry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        let hash = hash_in(&name)?;
        (name.starts_with(&start) && is_same(&entry.path())).then(|| hash.to_string())
    })
}

/// The hash at the end of a name, extension apart: `0123456789abcdef` in
/// `libkit-0123456789abcdef.rlib`.
fn hash_in(name: &str) -> Option<&str> {
    let stem = name.split('.').find(|part| !part.is_empty())?;
    let (_, hash) = stem.rsplit_once('-')?;
    let is_hash = hash.len() == HASH_DIGITS && hash.bytes().all(|digit| digit.is_ascii_hexdigit());
    is_hash.then_some(hash)
}

/// Copies a file, or a folder with all that is in it.
fn copy_with_times(from: &Path, to: &Path) -> io::Result<()> {
    let original = fs::metadata(from)?;
    if original.is_dir() {
        fs::create_dir_all(to)?;
        for entry in fs::read_dir(from)? {
            let name = entry?.file_name();
            copy_with_times(&from.join(&name), &to.join(&name))?;
        }
        return Ok(());
    }
    fs::copy(from, to)?;
    same_time(&original, to)
}

/// Gives the file `to` the time at which the `original` was modified.
fn same_time(original: &fs::Metadata, to: &Path) -> io::Result<()> {
    let file = File::options().write(true).open(to)?;
    file.set_modified(original.modified()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_named_by_their_hash() {
        for (name, hash) in [
            ("libkit-761f65012133be89.rlib", Some("761f65012133be89")),
            ("grader-4400b283d2c212f4", Some("4400b283d2c212f4")),
            ("build-script-build", None),
            ("libgrader.rlib", None),
            (".cargo-lock", None),
            ("kit-761f65012133beXX", None),
        ] {
            assert_eq!(hash_in(name), hash, "{name}");
        }
    }

    #[test]
    fn a_copy_has_the_times_of_its_original() {
        let folder = tempfile::tempdir().unwrap();
        let at = |path: &str| folder.path().join(path);
        fs::create_dir_all(at("a/b")).unwrap();
        fs::write(at("a/b/c"), "text").unwrap();
        let old = std::time::SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_000_000_000);
        File::options()
            .write(true)
            .open(at("a/b/c"))
            .unwrap()
            .set_modified(old)
            .unwrap();
        copy_with_times(&at("a"), &at("d")).unwrap();
        assert_eq!(fs::read_to_string(at("d/b/c")).unwrap(), "text");
        assert_eq!(fs::metadata(at("d/b/c")).unwrap().modified().unwrap(), old);
    }

    #[test]
    fn the_hash_of_an_uplifted_file_is_that_of_the_same_contents() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("deps")).unwrap();
        for (name, text) in [
            ("grader", "new"),
            ("deps/grader-0000000000000001", "old"),
            ("deps/grader-0000000000000002", "new"),
            ("deps/other-0000000000000003", "new"),
        ] {
            fs::write(folder.path().join(name), text).unwrap();
        }
        let hash = hash_of_copy(&folder.path().join("grader"));
        assert_eq!(hash.as_deref(), Some("0000000000000002"));
    }
}
