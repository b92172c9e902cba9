//! Files that were restored: cargo compiles a crate again if a file is newer than the last build,
//! so it does not see a copy that comes back with its old time (`mv`, `cp -p`, `tar`, `rsync`).

use base::fnv;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// The folders of the workspace that contain crates.
const FOLDERS: [&str; 2] = ["stages", "grader"];

/// The file beside what was compiled that has, line by line, a crate and the stamp of its files.
const STAMPS: &str = "first-light-stamps.txt";

/// The stamps of all crates before a build.
pub(super) struct Stamps {
    file: PathBuf,
    of_crates: BTreeMap<String, String>,
}

impl Stamps {
    /// Computes the stamps of the workspace `root`. Makes cargo compile each crate whose stamp
    /// is not the stored one: removes what cargo knows of it in `compiled`, the folder of a profile
    /// in the target folder. A crate that was compiled after the stamps were stored stays: cargo
    /// saw the times of its files then.
    pub(super) fn before_build(root: &Path, compiled: &Path) -> Stamps {
        let stamps = Stamps {
            file: compiled.join(STAMPS),
            of_crates: stamps_of(root),
        };
        let Some(stored_at) = time_of(&stamps.file) else {
            return stamps;
        };
        let stored = fs::read_to_string(&stamps.file).unwrap_or_default();
        let others: BTreeSet<&str> = stored
            .lines()
            .filter_map(|line| line.split_once(' '))
            .filter(|(name, stamp)| stamps.of_crates.get(*name).is_none_or(|now| now != stamp))
            .map(|(name, _)| name)
            .collect();
        for known in inside(&compiled.join(".fingerprint")) {
            // Cargo's names are those of crates and 16 hexadecimal digits.
            let name = known.file_name().unwrap_or_default().to_string_lossy();
            let of_crate = name.rsplit_once('-').map(|(of_crate, _)| of_crate);
            let is_other = of_crate.is_some_and(|of_crate| others.contains(of_crate));
            if is_other && compiled_at(&known).any(|time| time <= stored_at) {
                let _ = fs::remove_dir_all(&known);
            }
        }
        stamps
    }

    /// Stores them: the build succeeded. Without the file the next one trusts the times, as cargo
    /// does.
    pub(super) fn store(&self) {
        let lines = self
            .of_crates
            .iter()
            .map(|(name, stamp)| format!("{name} {stamp}\n"));
        let _ = fs::write(&self.file, lines.collect::<String>());
    }
}

fn time_of(path: &Path) -> Option<SystemTime> {
    path.metadata().and_then(|about| about.modified()).ok()
}

/// When the parts of a crate were compiled: cargo has a file `dep-…` for each.
fn compiled_at(known: &Path) -> impl Iterator<Item = SystemTime> + use<> {
    let is_of_part = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default();
        name.to_string_lossy().starts_with("dep-")
    };
    inside(known)
        .filter(is_of_part)
        .filter_map(|path| time_of(&path))
}

/// What is in a folder; nothing if it cannot be read.
fn inside(folder: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.path())
}

/// The stamps of all crates, by their names.
fn stamps_of(root: &Path) -> BTreeMap<String, String> {
    let folders = FOLDERS.iter().flat_map(|folder| inside(&root.join(folder)));
    let crates = folders.filter(|path| path.join("Cargo.toml").is_file());
    let stamp = |path: PathBuf| {
        let mut files = Vec::new();
        add(path.join("Cargo.toml"), root, &mut files);
        add(path.join("src"), root, &mut files);
        files.sort();
        let stamp = files.concat().bytes().fold(fnv::START, fnv::add);
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        (name.into_owned(), format!("{stamp:016x}"))
    };
    crates.map(stamp).collect()
}

/// Adds a file below `root`, or those of a folder: path, length and time, as text.
fn add(path: PathBuf, root: &Path, files: &mut Vec<String>) {
    let Ok(about) = path.metadata() else { return };
    if about.is_dir() {
        inside(&path).for_each(|file| add(file, root, files));
    } else {
        let below = path.strip_prefix(root);
        files.push(format!(
            "{below:?} {} {:?}",
            about.len(),
            about.modified().ok()
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_crate_whose_file_came_back_with_its_old_time_is_compiled_again() {
        let folder = tempfile::tempdir().unwrap();
        let [root, compiled] = ["course", "release"].map(|name| folder.path().join(name));
        // The system's clock may stand still for milliseconds: times are set.
        let write = |path: &str, text: &str, time: u64| {
            let path = folder.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, text).unwrap();
            let file = fs::File::options().append(true).open(&path).unwrap();
            let time = SystemTime::UNIX_EPOCH + Duration::from_secs(time);
            file.set_modified(time).unwrap();
        };
        let compile = |name: &str, time: u64| {
            let known = format!("release/.fingerprint/{name}-0123456789abcdef");
            write(&format!("{known}/dep-lib-{name}"), "", time);
        };
        let stamps = format!("release/{STAMPS}");
        let store = |time: u64| {
            Stamps::before_build(&root, &compiled).store();
            let text = fs::read_to_string(folder.path().join(&stamps)).unwrap();
            write(&stamps, &text, time);
        };
        for name in ["bvh", "kit"] {
            write(&format!("course/stages/{name}/Cargo.toml"), "", 1);
            write(&format!("course/stages/{name}/src/lib.rs"), "fn f() {}", 1);
            compile(name, 2);
        }
        store(3);
        let known = |name: &str| {
            let of_crate = format!(".fingerprint/{name}-0123456789abcdef");
            compiled.join(of_crate).exists()
        };
        let source = root.join("stages/bvh/src/lib.rs");
        let kept = folder.path().join("lib.rs.bak");
        fs::rename(&source, &kept).unwrap();
        write("course/stages/bvh/src/lib.rs", "fn f() { panic!() }", 4);
        // By another command: cargo saw what it compiled.
        compile("bvh", 5);
        store(6);
        assert!(known("bvh") && known("kit"));
        fs::rename(&kept, &source).unwrap();
        Stamps::before_build(&root, &compiled);
        assert!(!known("bvh") && known("kit"));
    }
}
