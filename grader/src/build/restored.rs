//! Files that were restored: cargo compiles a crate again if a file is newer than the last build,
//! so it does not see a copy that comes back with its old time (`mv`, `cp -p`, `tar`, `rsync`).

use crate::course::sources;
use base::fnv;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, Metadata};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// The folders of the workspace that contain crates.
const FOLDERS: [&str; 2] = ["stages", "grader"];

/// The file beside what was compiled that has, line by line, a crate and the stamp of its files.
const STAMPS: &str = "first-light-stamps.txt";

/// The stamps of all crates before a build.
pub(super) struct Stamps {
    file: PathBuf,
    of_crates: BTreeMap<String, Stamp>,
}

/// The files of a crate.
struct Stamp {
    /// A hash of their paths, lengths and times.
    of_files: String,
    /// When each was changed, and each folder of them: by its own time, and by the system's, which
    /// a copy cannot have from elsewhere. Not every system has the second.
    changes: Vec<(SystemTime, Option<SystemTime>)>,
}

impl Stamps {
    /// Computes the stamps of the workspace `root`. Makes cargo compile each crate that it would
    /// take for current though a file came back with its old time: removes what cargo knows of it
    /// in `compiled`, the folder of a profile in the target folder.
    ///
    /// Such a crate was compiled before the system says that the file came there. Not every system
    /// says so: a crate is compiled, too, if its stamp is not the stored one and nothing compiled
    /// it since that was stored. Cargo has seen the times of what was compiled since.
    pub(super) fn before_build(root: &Path, compiled: &Path) -> Stamps {
        let stamps = Stamps {
            file: compiled.join(STAMPS),
            of_crates: stamps_of(root),
        };
        let about = stamps.file.metadata();
        let stored_at = about.and_then(|about| about.modified()).ok();
        let text = fs::read_to_string(&stamps.file).unwrap_or_default();
        let stored: BTreeMap<&str, &str> = text
            .lines()
            .filter_map(|line| line.split_once(' '))
            .collect();
        for known in inside(&compiled.join(".fingerprint")) {
            // Cargo's names are those of crates and 16 hexadecimal digits.
            let name = known.file_name().unwrap_or_default().to_string_lossy();
            let of_crate = name.rsplit_once('-').map_or("", |(of_crate, _)| of_crate);
            let Some(stamp) = stamps.of_crates.get(of_crate) else {
                continue;
            };
            let is_other = stored.get(of_crate).is_some_and(|s| *s != stamp.of_files);
            let is_stale = |part: Metadata| {
                let is_older = |at: SystemTime| part.modified().is_ok_and(|time| time <= at);
                is_other && stored_at.is_some_and(is_older) || stamp.came_back_after(&part)
            };
            if compiled_parts(&known).any(is_stale) {
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
            .map(|(name, stamp)| format!("{name} {}\n", stamp.of_files));
        let _ = fs::write(&self.file, lines.collect::<String>());
    }
}

impl Stamp {
    /// The stamp of the crate in a folder of the workspace `root`.
    fn of(folder: &Path, root: &Path) -> Stamp {
        let mut files = sources::all_below(&folder.join("src")).unwrap_or_default();
        files.push(folder.join("Cargo.toml"));
        let mut stamp = fnv::START;
        for file in &files {
            let Ok(about) = file.metadata() else { continue };
            let (below, time) = (file.strip_prefix(root), about.modified().ok());
            let text = format!("{below:?} {} {time:?}", about.len());
            stamp = text.bytes().fold(stamp, fnv::add);
        }
        // A folder that is renamed brings its files along, and a link another file.
        let within = |file| Path::ancestors(file).take_while(|path| *path != root);
        let paths: BTreeSet<&Path> = files.iter().flat_map(|file| within(file)).collect();
        let change = |path: &Path| {
            let (about, link) = (path.metadata().ok()?, path.symlink_metadata().ok()?);
            Some((about.modified().ok()?, came_at(&about).max(came_at(&link))))
        };
        Stamp {
            of_files: format!("{stamp:016x}"),
            changes: paths.into_iter().filter_map(change).collect(),
        }
    }

    /// Whether a file came there after the part `compiled`, with a time before it.
    fn came_back_after(&self, compiled: &Metadata) -> bool {
        let (Ok(compiled_at), Some(done_at)) = (compiled.modified(), came_at(compiled)) else {
            return false;
        };
        let mut changes = self.changes.iter();
        changes.any(|(time, came)| *time <= compiled_at && came.is_some_and(|at| at > done_at))
    }
}

/// When the system last changed what it knows of a file, if it says so.
#[cfg(unix)]
fn came_at(about: &Metadata) -> Option<SystemTime> {
    use std::os::unix::fs::MetadataExt;
    use std::time::Duration;
    let (seconds, nanoseconds) = (about.ctime().try_into().ok()?, about.ctime_nsec() as u32);
    SystemTime::UNIX_EPOCH.checked_add(Duration::new(seconds, nanoseconds))
}

#[cfg(not(unix))]
fn came_at(_: &Metadata) -> Option<SystemTime> {
    None
}

/// The files `dep-…` that cargo has for each compiled part of a crate: their time is that at
/// which it began to compile.
fn compiled_parts(known: &Path) -> impl Iterator<Item = Metadata> + use<> {
    let is_of_part = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default();
        name.to_string_lossy().starts_with("dep-")
    };
    inside(known)
        .filter(is_of_part)
        .filter_map(|path| path.metadata().ok())
}

/// What is in a folder; nothing if it cannot be read.
fn inside(folder: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.path())
}

/// The stamps of all crates, by their names.
fn stamps_of(root: &Path) -> BTreeMap<String, Stamp> {
    let folders = FOLDERS.iter().flat_map(|folder| inside(&root.join(folder)));
    let crates = folders.filter(|path| path.join("Cargo.toml").is_file());
    let stamp = |path: PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        (name.into_owned(), Stamp::of(&path, root))
    };
    crates.map(stamp).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_crate_whose_file_came_back_with_its_old_time_is_compiled_again() {
        let folder = tempfile::tempdir().unwrap();
        let [root, compiled] = ["course", "release"].map(|name| folder.path().join(name));
        // The system's clock may stand still for milliseconds: times are set, to later than when
        // the files come there.
        let later = SystemTime::now() + Duration::from_secs(3600);
        let write = |path: &str, text: &str, time: u64| {
            let path = folder.path().join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(&path, text).unwrap();
            let file = fs::File::options().append(true).open(&path).unwrap();
            file.set_modified(later + Duration::from_secs(time))
                .unwrap();
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

    /// Nobody stored a stamp of what was compiled last: another command compiled it, or the build
    /// ended in an error.
    #[cfg(unix)]
    #[test]
    fn a_file_that_came_after_its_crate_was_compiled_is_seen_without_stamps() {
        let folder = tempfile::tempdir().unwrap();
        let src = folder.path().join("stages/bvh/src");
        let known = folder
            .path()
            .join("release/.fingerprint/bvh-0123456789abcdef");
        for new in [&src, &known] {
            fs::create_dir_all(new).unwrap();
        }
        let ago = |hours: u64| SystemTime::now() - Duration::from_secs(3600 * hours);
        let write = |path: PathBuf, time: SystemTime| {
            fs::write(&path, "").unwrap();
            let file = fs::File::options().append(true).open(&path).unwrap();
            file.set_modified(time).unwrap();
        };
        write(folder.path().join("stages/bvh/Cargo.toml"), ago(0));
        let is_kept = || {
            Stamps::before_build(folder.path(), &folder.path().join("release"));
            known.exists()
        };
        // Came before the crate was compiled; then what an editor keeps beside it.
        write(src.join("lib.rs"), ago(3));
        write(known.join("dep-lib-bvh"), ago(0) + Duration::from_secs(60));
        write(src.join(".lib.rs.swp"), ago(3));
        assert!(is_kept());
        // Newer than what was compiled: cargo sees it.
        write(src.join("lib.rs"), ago(0));
        write(known.join("dep-lib-bvh"), ago(1));
        assert!(is_kept());
        // The system's clock advances by steps.
        std::thread::sleep(Duration::from_millis(30));
        write(src.join("lib.rs"), ago(2));
        assert!(!is_kept());
        // A folder that was renamed, and a link to another file: the files themselves stay.
        let other = folder.path().join("other");
        fs::create_dir(&other).unwrap();
        write(other.join("lib.rs"), ago(3));
        write(folder.path().join("stages/bvh/Cargo.toml"), ago(3));
        let set_time = |path: &Path, time| {
            let folder = fs::File::open(path).unwrap();
            folder.set_modified(time).unwrap();
        };
        let compile = || {
            std::thread::sleep(Duration::from_millis(30));
            fs::create_dir_all(&known).unwrap();
            write(known.join("dep-lib-bvh"), ago(2));
            std::thread::sleep(Duration::from_millis(30));
        };
        for path in [&other, &folder.path().join("stages")] {
            set_time(path, ago(3));
        }
        compile();
        assert!(is_kept());
        fs::rename(&src, folder.path().join("kept")).unwrap();
        fs::rename(&other, &src).unwrap();
        assert!(!is_kept());
        fs::remove_file(src.join("lib.rs")).unwrap();
        for (name, at) in [("a.rs", 3), ("b.rs", 4)] {
            write(folder.path().join(name), ago(at));
        }
        let link = |to: &str| {
            let _ = fs::remove_file(src.join("lib.rs"));
            std::os::unix::fs::symlink(folder.path().join(to), src.join("lib.rs")).unwrap();
        };
        link("a.rs");
        compile();
        assert!(is_kept());
        link("b.rs");
        assert!(!is_kept());
    }
}
