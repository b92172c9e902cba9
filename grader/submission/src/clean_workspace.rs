//! The course as submissions are built with it: trusted files only, and what was compiled of them
//! before any submission.

use crate::build_folder::BuildFolder;
use crate::containment::Containment;
use crate::jail::Jail;
use crate::toolchain::Toolchain;
use base::{GraderError, Workspace, interrupt};
use base::{child_processes, errln};
use files::file_tree::{self, Files};
use files::members::{self, Member};
use files::{lock, manifest};
use grader::workers::awake::Awake;
use grader::workers::launcher::Launcher;
use std::ffi::OsStr;
use std::fs::File;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

/// What all submissions share. It is made once for each version of the course and the compiler, and
/// then never written again: each submission is built in a folder of its own. Threads may share it.
#[derive(Debug)]
pub struct CleanWorkspace {
    /// The folder of everything here.
    top: PathBuf,
    /// The files of the worker and its dependencies, with the reference's stages. No tests, no
    /// goldens.
    trusted: PathBuf,
    /// The sources of the libraries from the registry.
    libraries: PathBuf,
    /// What cargo built of both.
    target: PathBuf,
    /// Cargo's settings.
    home: PathBuf,
    toolchain: Toolchain,
    containment: Containment,
    /// Locked as long as it is used: the clock may say that it is old.
    used: Option<File>,
}

/// The folder of the worker's crate: all that is compiled for a submission besides its stages.
const WORKER: &str = "grader/worker";

/// The file that says that everything was made.
const COMPLETE: &str = "complete";

#[cfg(test)]
impl CleanWorkspace {
    /// The folder `top` without a sandbox, in which this program builds in the place of cargo.
    pub(crate) fn with_cargo(top: &Path, cargo: &Path) -> CleanWorkspace {
        CleanWorkspace {
            trusted: top.join("course"),
            libraries: top.join("libraries"),
            target: top.join("target"),
            home: top.join("home"),
            toolchain: Toolchain {
                cargo: cargo.to_path_buf(),
                rustc: PathBuf::new(),
                version: String::new(),
                folders: Vec::new(),
                path: std::env::var_os("PATH").unwrap_or_default(),
            },
            containment: Containment::None,
            used: None,
            top: top.to_path_buf(),
        }
    }
}

impl CleanWorkspace {
    /// Opens what submissions to the course `workspace` share, in its folder `target/submissions`.
    /// Makes it first if it does not exist for this version of course and compiler.
    pub fn open(
        workspace: &Workspace,
        containment: Containment,
    ) -> Result<CleanWorkspace, GraderError> {
        let root = workspace.root();
        let toolchain = Toolchain::of(root)?;
        if containment.is_sandbox()
            && let Some(why) = toolchain.exposes(root)
        {
            return Err(GraderError::new(why));
        }
        let files = trusted_files(workspace)?;
        let all = root.join("target/submissions");
        std::fs::create_dir_all(&all).map_err(|e| GraderError::file("create", &all, e))?;
        let top = all.join(version(&files, &toolchain));
        let mut clean = CleanWorkspace {
            trusted: top.join("course"),
            libraries: top.join("libraries"),
            target: top.join("target"),
            home: top.join("home"),
            toolchain,
            containment,
            used: None,
            top,
        };
        // Another grader may be making it.
        let _lock = file_lock(&all.join("lock"))?;
        if !clean.top.join(COMPLETE).is_file() {
            clean.make(files)?;
        }
        clean.used = Some(mark_used(&clean.top)?);
        remove_unused(&all, &clean.top);
        remove_unused(&clean.top, &clean.target);
        Ok(clean)
    }

    /// The same with another program in place of the compiler, which may use its folder. For tests.
    pub(crate) fn with_compiler(mut self, program: &Path) -> CleanWorkspace {
        self.toolchain.rustc = program.to_path_buf();
        let folder = program.parent().map(Path::to_path_buf);
        self.toolchain.folders.extend(folder);
        self
    }

    /// How the code of submissions is contained.
    pub fn containment(&self) -> &Containment {
        &self.containment
    }

    /// Writes the workspace with these stages in place of the reference's, to a folder that is
    /// removed with the returned value. What is built and run in it has to end at `end`.
    pub fn with_stages(
        &self,
        stages: &[(&str, &Files)],
        end: Option<Awake>,
    ) -> Result<BuildFolder, GraderError> {
        BuildFolder::new(self, stages, end)
    }

    /// Makes everything from the workspace's `files`. What an interrupted run has left is removed.
    fn make(&self, mut files: Files) -> Result<(), GraderError> {
        errln!("Building the course for submissions. This is done once and takes a minute.");
        if self.top.exists() {
            let removed = std::fs::remove_dir_all(&self.top);
            removed.map_err(|e| GraderError::file("remove", &self.top, e))?;
        }
        lock::remove_unused(&mut files)?;
        file_tree::sync_folder(&self.trusted, &files)?;
        self.fetch_libraries()?;
        for folder in [&self.home, &self.target] {
            let created = std::fs::create_dir_all(folder);
            created.map_err(|e| GraderError::file("create", folder, e))?;
        }
        file_tree::write(&self.home.join("config.toml"), self.settings().as_bytes())?;
        self.build()?;
        file_tree::write(&self.top.join(COMPLETE), b"")
    }

    /// Copies the sources of the libraries, with the settings of the person who grades.
    fn fetch_libraries(&self) -> Result<(), GraderError> {
        let vendor = |more: &[&str]| {
            Command::new(child_processes::cargo())
                .current_dir(&self.trusted)
                .args(["vendor", "--locked", "--quiet", "--versioned-dirs"])
                .args(more)
                .arg(&self.libraries)
                .stdin(Stdio::null())
                .output()
                .map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))
        };
        let mut output = vendor(&["--offline"])?;
        if !output.status.success() {
            // Libraries for other systems are in the lock file, but not on every disk.
            output = vendor(&[])?;
        }
        match output.status.success() {
            true => Ok(()),
            false => Err(GraderError::new(format!(
                "cargo cannot copy the libraries for submissions. Run `cargo fetch --locked` with a network once. {}",
                String::from_utf8_lossy(&output.stderr).trim()
            ))),
        }
    }

    /// The settings of the cargo that builds submissions.
    fn settings(&self) -> String {
        format!(
            "[source.crates-io]\nreplace-with = \"copied\"\n\n[source.copied]\ndirectory = {}\n\n[net]\noffline = true\n",
            toml_string(&self.libraries)
        )
    }

    /// Builds the worker with the reference's stages, under the same limits as a submission.
    fn build(&self) -> Result<(), GraderError> {
        let temporary = interrupt::temp_folder()?;
        let jail = Jail {
            containment: self.containment.clone(),
            toolchain: self.toolchain.clone(),
            root: self.trusted.clone(),
            libraries: self.libraries.clone(),
            home: self.home.clone(),
            target: self.target.clone(),
            temporary: temporary.path().to_path_buf(),
            end: None,
        };
        let output = jail
            .cargo()
            .args(["build", "--release", "--package", "worker", "--quiet"])
            .args(["--features", "sandbox", "--offline", "--locked"])
            .arg("--manifest-path")
            .arg(self.trusted.join("Cargo.toml"))
            .arg("--target-dir")
            .arg(&self.target)
            .stdin(Stdio::null())
            .output()
            .map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
        match output.status.success() {
            true => Ok(()),
            false => Err(GraderError::new(format!(
                "cargo cannot build the course for submissions: {}",
                String::from_utf8_lossy(&output.stderr).trim()
            ))),
        }
    }

    /// The folder in which submissions get their folders.
    pub(crate) fn top(&self) -> &Path {
        &self.top
    }

    /// The course with the reference's stages.
    pub(crate) fn trusted(&self) -> &Path {
        &self.trusted
    }

    /// What cargo built of it.
    pub(crate) fn target(&self) -> &Path {
        &self.target
    }

    /// Cargo's folder, with its settings.
    pub(crate) fn home(&self) -> &Path {
        &self.home
    }

    /// What starts the programs of a submission that is built in `root`.
    pub(crate) fn jail(
        &self,
        root: &Path,
        target: &Path,
        home: PathBuf,
        temporary: PathBuf,
        end: Option<Awake>,
    ) -> Jail {
        Jail {
            containment: self.containment.clone(),
            toolchain: self.toolchain.clone(),
            root: root.to_path_buf(),
            libraries: self.libraries.clone(),
            home,
            target: target.to_path_buf(),
            temporary,
            end,
        }
    }

    /// Whether cargo compiles or reads the file `path` of the course when it builds a submission with
    /// these stages. Of the others it needs the names and the times.
    pub(crate) fn is_read(path: &Path, stages: &[&str]) -> bool {
        let is_manifest = path.file_name().is_some_and(is_manifest);
        let is_of_stage = |stage: &&str| path.starts_with(Path::new("stages").join(stage));
        is_manifest || path.starts_with(WORKER) || stages.iter().any(is_of_stage)
    }
}

/// Whether cargo reads the files of this name in every crate.
fn is_manifest(name: &OsStr) -> bool {
    name == "Cargo.toml" || name == "Cargo.lock"
}

/// How long something may stay unused.
const UNUSED: Duration = Duration::from_secs(24 * 60 * 60);

/// The file in a folder that is locked by those who use the folder.
const USED: &str = "used";

/// Marks `folder` as used, until the returned file is closed or the program ends in any way.
pub(crate) fn mark_used(folder: &Path) -> Result<File, GraderError> {
    let path = folder.join(USED);
    let failed = |e| GraderError::file("lock", &path, e);
    let file = File::create(&path).map_err(failed)?;
    file.lock_shared().map_err(failed)?;
    Ok(file)
}

/// Removes what is in `folder` for another version of the course, or for a submission whose grader
/// was killed: folders with the names of such that nobody uses and nothing was written to for a
/// day, but not `kept`. What cannot be removed stays.
fn remove_unused(folder: &Path, kept: &Path) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_ours = name.starts_with("course-") || name.starts_with(".grader-");
        let modified = entry.metadata().and_then(|metadata| metadata.modified());
        let age = modified.ok().and_then(|time| time.elapsed().ok());
        let used = File::open(entry.path().join(USED));
        let is_used = used.is_ok_and(|file| file.try_lock().is_err());
        if is_ours && !is_used && entry.path() != kept && age.is_some_and(|age| age > UNUSED) {
            let _ = std::fs::remove_dir_all(entry.path());
        }
    }
}

/// `path` as a string of TOML.
fn toml_string(path: &Path) -> String {
    let text = path.to_string_lossy();
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// Locks the file `path`, until the returned value is dropped or the program ends in any way.
fn file_lock(path: &Path) -> Result<File, GraderError> {
    let failed = |e| GraderError::file("lock", path, e);
    let file = File::create(path).map_err(failed)?;
    file.lock().map_err(failed)?;
    Ok(file)
}

/// The name of the folder for these files and this compiler.
fn version(files: &Files, toolchain: &Toolchain) -> String {
    let mut hasher = DefaultHasher::new();
    files.hash(&mut hasher);
    toolchain.version.hash(&mut hasher);
    format!("course-{:016x}", hasher.finish())
}

/// The files of the worker and of all crates that it depends on, and the workspace's own lock file:
/// each unit of a class asks for them, and cargo takes seconds to shorten that.
fn trusted_files(workspace: &Workspace) -> Result<Files, GraderError> {
    let root = workspace.root();
    let members = members::read(root)?;
    let needed = members::with_dependencies(&members, &["worker"]);
    let mut files = Files::new();
    for path in file_tree::workspace_paths(root)? {
        let owner = members::containing_member(&members, &path);
        let is_manifest = path.file_name().is_some_and(|name| name == "Cargo.toml");
        let wanted = match owner {
            None => path == Path::new("Cargo.lock") || path == Path::new("Cargo.toml"),
            Some(owner) => needed.contains(owner.name.as_str()) && !is_test(owner, &path),
        };
        if !wanted {
            continue;
        }
        let mut contents = file_tree::read(root, &path)?;
        if is_manifest {
            let text = String::from_utf8_lossy(&contents);
            contents = match owner {
                None => {
                    let text = manifest::with_members(&text, &members, &needed);
                    without_line_tables(&without_unsafe(&text)?)?
                }
                Some(owner) => {
                    let text = manifest::without_tests(&text);
                    let text = manifest::without_unused_dev_dependencies(&text, |_| false);
                    match owner.folder.starts_with("stages") {
                        true => manifest::only_library(&text),
                        false => text,
                    }
                }
            }
            .into_bytes();
        }
        files.insert(path, contents);
    }
    Ok(files)
}

fn is_test(owner: &Member, path: &Path) -> bool {
    let inside = path.strip_prefix(&owner.folder).unwrap_or(path);
    let first = inside.iter().next();
    first.is_some_and(|name| members::TEST_FOLDERS.iter().any(|test| name == *test))
}

/// The workspace's manifest with the lint against `unsafe` code such that no source file can allow
/// it again.
fn without_unsafe(manifest: &str) -> Result<String, GraderError> {
    with_other_line(
        manifest,
        r#"unsafe_code = "deny""#,
        r#"unsafe_code = "forbid""#,
    )
}

/// The workspace's manifest without debug information in a release. Nobody reads a backtrace of a
/// submission, and the information takes a sixth of the processor time of compiling a submission.
fn without_line_tables(manifest: &str) -> Result<String, GraderError> {
    with_other_line(manifest, r#"debug = "line-tables-only""#, "debug = false")
}

/// The workspace's manifest with `new` in place of the line `old`, which it must contain.
fn with_other_line(manifest: &str, old: &str, new: &str) -> Result<String, GraderError> {
    match manifest.contains(old) {
        true => Ok(manifest.replace(old, new)),
        false => Err(GraderError::new(format!(
            "Cargo.toml does not contain the line {old}, which is made {new} for submissions"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn submissions_are_compiled_without_debug_information() {
        let manifest = "[profile.release]\nopt-level = 3\ndebug = \"line-tables-only\"\n";
        let without = without_line_tables(manifest).unwrap();
        assert_eq!(without, "[profile.release]\nopt-level = 3\ndebug = false\n");
        assert!(without_line_tables(&without).is_err());
    }

    #[test]
    fn the_lint_against_unsafe_code_cannot_be_allowed_again() {
        let manifest = "[workspace.lints.rust]\nunsafe_code = \"deny\"\n";
        let strong = without_unsafe(manifest).unwrap();
        assert_eq!(strong, "[workspace.lints.rust]\nunsafe_code = \"forbid\"\n");
        assert!(without_unsafe("[workspace.lints.rust]\n").is_err());
    }

    #[test]
    fn only_folders_that_nobody_uses_are_removed() {
        let folder = tempfile::tempdir().unwrap();
        let long_ago = std::time::SystemTime::now() - 2 * UNUSED;
        let make = |name: &str, is_old: bool| {
            let path = folder.path().join(name);
            file_tree::write(&path.join("file"), b"").unwrap();
            if is_old {
                let times = std::fs::FileTimes::new().set_modified(long_ago);
                File::open(&path).unwrap().set_times(times).unwrap();
            }
            path
        };
        let kept = make("course-1", true);
        let all = [
            make("course-2", true),
            make("course-3", false),
            make(".grader-x", true),
            make("other", true),
            // Of a grader that runs, by a clock that jumped.
            make(".grader-y", false),
        ];
        let _used = mark_used(&all[4]).unwrap();
        let times = std::fs::FileTimes::new().set_modified(long_ago);
        File::open(&all[4]).unwrap().set_times(times).unwrap();
        remove_unused(folder.path(), &kept);
        assert!(kept.exists());
        let left = all.map(|path| path.exists());
        assert_eq!(left, [false, true, false, true, true]);
    }

    #[test]
    fn paths_are_quoted() {
        assert_eq!(toml_string(Path::new("/a\\b\"c")), r#""/a\\b\"c""#);
    }
}
