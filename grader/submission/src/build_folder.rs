//! The folder in which one submission is built: a copy of the course with its stages, and a copy of
//! what was compiled before. Nothing that is built here reaches another submission.

use crate::clean_workspace::{CleanWorkspace, mark_used};
use base::GraderError;
use base::interrupt::{self, TempFolder};
use files::file_tree::{self, Files};
use formats::{Layout, shown};
use grader::build::BuildRoot;
use grader::workers::awake::Awake;
use grader::workers::launcher::Launcher;
use std::fs::{File, FileTimes};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A workspace for building one submission. It is removed when this is dropped.
#[derive(Debug)]
pub struct BuildFolder {
    /// The copy of the course.
    root: PathBuf,
    /// Cargo's target folder.
    target: PathBuf,
    launcher: Arc<dyn Launcher>,
    _used: File,
    _folder: TempFolder,
}

/// The folders in cargo's target folder that contain what was compiled.
const COMPILED: [&str; 3] = ["release/.fingerprint", "release/build", "release/deps"];

/// The crate that links the stages.
const WORKER: &str = "worker";

impl BuildFolder {
    /// Writes the workspace of `clean` with these stages in place of the reference's. What is built
    /// and run in it has to end at `end`.
    pub(crate) fn new(
        clean: &CleanWorkspace,
        stages: &[(&str, &Files)],
        end: Option<Awake>,
    ) -> Result<BuildFolder, GraderError> {
        let folder = interrupt::temp_folder_in(clean.top())?;
        let used = mark_used(folder.path())?;
        let inside = |name: &str| folder.path().join(name);
        let (root, target, home) = (inside("course"), inside("target"), inside("home"));
        let names: Vec<&str> = stages.iter().map(|(stage, _)| *stage).collect();
        let sources = |stage: &&str| Path::new("stages").join(stage).join("src");
        let replaced: Vec<PathBuf> = names.iter().map(sources).collect();
        copy_tree(clean.trusted(), &root, Path::new(""), &|path| {
            if replaced.iter().any(|src| path == src) {
                Part::Nothing
            } else if CleanWorkspace::is_read(path, &names) {
                Part::All
            } else {
                // What is compiled already. The reference of the other stages is among it.
                Part::Name
            }
        })?;
        for ((_, files), src) in stages.iter().zip(&replaced) {
            for (path, contents) in files.iter() {
                file_tree::write(&root.join(src).join(path), contents)?;
            }
        }
        for compiled in COMPILED {
            copy_tree(
                clean.target(),
                &target,
                Path::new(compiled),
                &|path| match is_artifact_of(path, &names) {
                    true => Part::Nothing,
                    false => Part::All,
                },
            )?;
        }
        let settings = Path::new("config.toml");
        create(&home)?;
        copy_file(&clean.home().join(settings), &home.join(settings))?;
        let temporary = inside("temporary");
        create(&temporary)?;
        open_to_all(folder.path())?;
        let jail = clean.jail(&root, &target, home, temporary, end);
        Ok(BuildFolder {
            root,
            target,
            launcher: Arc::new(jail),
            _used: used,
            _folder: folder,
        })
    }

    /// `text`, which the submission or its compiler printed, as it may be shown: without the path of
    /// this folder, which contains the name of the person who grades, and with visible control
    /// characters.
    pub(crate) fn for_report(&self, text: &str) -> String {
        let folder = self.root.parent().unwrap_or(&self.root);
        shown(&text.replace(&*folder.to_string_lossy(), ""), Layout::Lines)
    }

    /// How to build the worker here.
    pub fn build_root(&self) -> BuildRoot<'_> {
        BuildRoot {
            root: &self.root,
            target: Some(&self.target),
            sealed: true,
            quiet: true,
            launcher: Some(&self.launcher),
        }
    }
}

/// Whether the file or folder `path` was compiled of one of `stages`, or of the worker that links
/// them: the reference's solutions. Cargo's names are those of crates and 16 hexadecimal digits.
fn is_artifact_of(path: &Path, stages: &[&str]) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let name = name.split('.').next().unwrap_or_default();
    let Some((of, _)) = name.rsplit_once('-') else {
        return false;
    };
    let is = |of: &str| of == WORKER || stages.contains(&of);
    is(of) || of.strip_prefix("lib").is_some_and(is)
}

/// The part of a file or a folder that is copied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    All,
    /// An empty file with the name and the time of the original.
    Name,
    Nothing,
}

/// Copies what is below `from/below` to `to/below`, with the times of the files, by which cargo sees
/// what has changed, as far as `what` says, which gets paths relative to `from`.
fn copy_tree(
    from: &Path,
    to: &Path,
    below: &Path,
    what: &dyn Fn(&Path) -> Part,
) -> Result<(), GraderError> {
    let folder = from.join(below);
    let failed = |e| GraderError::file("read", &folder, e);
    create(&to.join(below))?;
    for entry in std::fs::read_dir(&folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let path = below.join(entry.file_name());
        let is_folder = entry.file_type().map_err(failed)?.is_dir();
        let (original, copy) = (from.join(&path), to.join(&path));
        match what(&path) {
            Part::Nothing => {}
            _ if is_folder => copy_tree(from, to, &path, what)?,
            Part::All => copy_file(&original, &copy)?,
            Part::Name => with_time_of(&original, &copy, File::create(&copy).map(drop))?,
        }
    }
    Ok(())
}

/// Copies a file with its time.
fn copy_file(from: &Path, to: &Path) -> Result<(), GraderError> {
    with_time_of(from, to, std::fs::copy(from, to).map(drop))
}

/// Gives the file `to`, if it was `written`, the time of `from`.
fn with_time_of(from: &Path, to: &Path, written: io::Result<()>) -> Result<(), GraderError> {
    let written = written.and_then(|()| {
        let modified = from.metadata()?.modified()?;
        let file = File::options().append(true).open(to)?;
        file.set_times(FileTimes::new().set_modified(modified))
    });
    written.map_err(|e| GraderError::file("write", to, e))
}

fn create(folder: &Path) -> Result<(), GraderError> {
    std::fs::create_dir_all(folder).map_err(|e| GraderError::file("create", folder, e))
}

/// Lets every user enter `folder`: another one may run the worker in it.
#[cfg(unix)]
fn open_to_all(folder: &Path) -> Result<(), GraderError> {
    use std::os::unix::fs::PermissionsExt;
    let opened = std::fs::set_permissions(folder, std::fs::Permissions::from_mode(0o755));
    opened.map_err(|e| GraderError::file("open", folder, e))
}

#[cfg(not(unix))]
fn open_to_all(_: &Path) -> Result<(), GraderError> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reference_and_what_links_it_are_left_out() {
        let is_left_out = |path: &str| is_artifact_of(Path::new(path), &["bvh"]);
        for path in [
            "release/deps/libbvh-0123456789abcdef.rlib",
            "release/deps/bvh-0123456789abcdef.d",
            "release/.fingerprint/bvh-0123456789abcdef",
            "release/deps/worker-0123456789abcdef",
            "release/deps/libworker-0123456789abcdef.rmeta",
        ] {
            assert!(is_left_out(path), "{path}");
        }
        for path in [
            "release/deps/libsimd_bvh-0123456789abcdef.rlib",
            "release/.fingerprint/bbox-0123456789abcdef",
            "release/deps",
        ] {
            assert!(!is_left_out(path), "{path}");
        }
    }

    #[test]
    fn copies_keep_their_times() {
        let folder = tempfile::tempdir().unwrap();
        let [from, to] = ["a", "b"].map(|name| folder.path().join(name));
        file_tree::write(&from.join("x/y"), b"1").unwrap();
        file_tree::write(&from.join("x/z"), b"2").unwrap();
        let long_ago = std::time::SystemTime::UNIX_EPOCH + std::time::Duration::new(77, 5);
        let times = FileTimes::new().set_modified(long_ago);
        let file = File::options().append(true).open(from.join("x/y")).unwrap();
        file.set_times(times).unwrap();
        for (what, contents) in [(Part::All, "1"), (Part::Name, "")] {
            copy_tree(
                &from,
                &to,
                Path::new("x"),
                &|path| match path.ends_with("z") {
                    true => Part::Nothing,
                    false => what,
                },
            )
            .unwrap();
            let copy = to.join("x/y");
            assert_eq!(copy.metadata().unwrap().modified().unwrap(), long_ago);
            assert_eq!(std::fs::read_to_string(copy).unwrap(), contents);
            assert!(!to.join("x/z").exists());
        }
    }
}
