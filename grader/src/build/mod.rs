//! Builds the worker with the student's stages, and other programs of the workspace.

mod cargo_run;
mod changed_signature;
pub mod compile_errors;
pub mod compile_warnings;
mod read_files;
mod restored;
mod target_folder;

pub use changed_signature::{StageFunction, stage_functions};

use self::restored::Stamps;
use crate::build::cargo_run::{MOST_TIME, run_cargo};
use crate::build::read_files::ReadFiles;
use crate::course::sources;
use crate::workers::awake::Awake;
use crate::workers::launcher::Launcher;
use crate::workers::runner::Worker;
use base::{GraderError, Workspace, child_processes, err, errln};
use std::collections::{BTreeMap, BTreeSet};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::{Duration, SystemTime};

/// The result of building a worker.
#[derive(Clone, Debug)]
pub enum BuildOutcome {
    /// The program, and how it is started.
    Worker(Worker),
    /// At least one crate does not compile.
    DoesNotCompile(CompileErrors),
}

/// The errors of a build that failed because code does not compile.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CompileErrors {
    /// The crates that have errors. Crates that depend on them were not built.
    pub failed_crates: BTreeSet<String>,
    /// Those of them with an error at a place of their code.
    pub(crate) wrong_crates: BTreeSet<String>,
    /// What the compiler said about no place of the code, such as a linker that is missing or a
    /// disk that is full: the last such sentence of each crate.
    pub(crate) without_place: BTreeMap<String, String>,
    /// The compiler's messages, but instead of those about the worker what they mean for the stage,
    /// if the worker links one stage. They were also printed to stderr unless the build is quiet or
    /// sealed.
    pub messages: String,
    /// The compiler's messages about the worker itself: a stage's functions do not fit its calls.
    pub(crate) worker_messages: String,
    /// The limit that the compiler exceeded, if this is why a crate does not compile.
    pub limit: Option<BuildLimit>,
}

/// Where the code under test is built. Everything else (the course, the goldens) is the trusted
/// workspace's.
#[derive(Clone, Copy, Debug)]
pub struct BuildRoot<'a> {
    /// The top folder of a workspace with a worker in it.
    pub root: &'a Path,
    /// Cargo's target folder, if it is not in `root`.
    pub target: Option<&'a Path>,
    /// Builds code that is not the caller's own: without network access, with the library versions
    /// of the lock file, and without printing anything.
    pub sealed: bool,
    /// Prints nothing while building, neither cargo's progress nor the compiler's messages.
    pub quiet: bool,
    /// Starts cargo, and the workers that it builds, with few rights; `None` for the rights of this
    /// program.
    pub launcher: Option<&'a Arc<dyn Launcher>>,
}

impl CompileErrors {
    /// Returns an error if a crate failed without an error at a place of its code: then the machine
    /// failed, and not the code.
    pub(super) fn ensure_of_the_code(&self) -> Result<(), GraderError> {
        let mut failed = self.without_place.iter();
        match failed.find(|(name, _)| !self.wrong_crates.contains(*name)) {
            None => Ok(()),
            Some((name, says)) => Err(GraderError::new(format!(
                "this machine cannot build `{name}`: {says}. This is no error in the code, so nothing is graded. Run `cargo grader doctor`: it says what is missing"
            ))),
        }
    }
}

/// A limit that building the code exceeded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuildLimit {
    /// Processor time or elapsed time.
    Time,
    /// Memory, or the size of a file that the compiler wrote.
    Memory,
}

/// In place of the compiler's messages, where it could read any file and ended before it said which
/// ones it read.
const NOT_SHOWN: &str = "error: a stage does not compile. This machine cannot keep files from the compiler, which ended too early to say which files it had read, so its messages are not shown: run `cargo build` with the code\n";

/// The package and the crate of the worker.
pub(crate) const WORKER: &str = "worker";

/// The worker's cargo feature for tracing rays through whole scenes.
pub(crate) const SCENES_FEATURE: &str = "meshes";

/// The stages that this feature links.
pub(crate) const INTERSECTION_STAGES: [&str; 3] = ["intersect", "bbox", "bvh"];

/// Whether whole scenes that are traced with the stage `own` are traced with `stage`, too.
pub(crate) fn traces_scenes_with(own: &str, stage: &str) -> bool {
    stage == own || INTERSECTION_STAGES.contains(&stage)
}

impl BuildRoot<'_> {
    /// The workspace itself.
    pub fn of(workspace: &Workspace) -> BuildRoot<'_> {
        BuildRoot {
            root: workspace.root(),
            target: None,
            sealed: false,
            quiet: false,
            launcher: None,
        }
    }

    /// Builds the worker in release, with the stages of `features`. If one of them does not
    /// compile, the others are still built. Cargo's progress and the compiler's messages go to
    /// stderr as they arrive, unless the build is sealed.
    pub fn build_worker(&self, features: &[&str]) -> Result<BuildOutcome, GraderError> {
        let show = !self.sealed && !self.quiet;
        if show && is_first_build(self.root, "release/worker.d") {
            errln!(
                "Compiling your code and the program that runs it: some ten seconds the first time."
            );
        }
        let stamps = match (self.launcher, self.target) {
            // Of a submission nothing was compiled before.
            (Some(_), _) => None,
            (None, Some(target)) => Some(Stamps::before_build(self.root, &target.join("release"))),
            (None, None) => own_stamps(self.root, "release"),
        };
        let command = self.command(features, show && has_colours());
        let built = run_cargo(command, WORKER, show, self.most_time())?;
        match self.without_foreign_files(built, features)? {
            Ok(program) => {
                stamps.iter().for_each(Stamps::store);
                ensure_not_of_the_future(&program, SystemTime::now())?;
                let worker = copy_under_own_name(program, features)?;
                Ok(BuildOutcome::Worker(Worker {
                    launcher: self.launcher.cloned(),
                    ..Worker::from(worker)
                }))
            }
            Err(mut errors) => {
                self.add_files_without_text(&mut errors, show);
                match self.launcher {
                    Some(_) => self.blame_the_code(&mut errors, features)?,
                    None => {
                        ensure_libraries_compile(self.root, &errors)?;
                        errors.ensure_of_the_code()?;
                    }
                }
                Ok(BuildOutcome::DoesNotCompile(
                    self.with_explanation(errors, features, show),
                ))
            }
        }
    }

    /// What was `built`, unless the compiler read files for it that are not the code's own: then
    /// this is an error of the crate, and what the compiler said may contain them.
    fn without_foreign_files(
        &self,
        built: Result<PathBuf, CompileErrors>,
        features: &[&str],
    ) -> Result<Result<PathBuf, CompileErrors>, GraderError> {
        let (Some(launcher), Some(target)) = (self.launcher, self.target) else {
            return Ok(built);
        };
        let mut linked = features.to_vec();
        if features.contains(&SCENES_FEATURE) {
            linked.extend(INTERSECTION_STAGES);
        }
        let folders = linked
            .into_iter()
            .map(|stage| (stage, Path::new("stages").join(stage)));
        let stages = folders.filter(|(_, folder)| self.root.join(folder).is_dir());
        let mut crates: Vec<(&str, PathBuf)> = stages.collect();
        crates.push((WORKER, Path::new("grader").join(WORKER)));
        let read = ReadFiles::of(self.root, target, &crates)?;
        if !read.foreign.is_empty() {
            return Ok(Err(CompileErrors {
                messages: read.foreign.values().cloned().collect(),
                failed_crates: read.foreign.into_keys().collect(),
                ..CompileErrors::default()
            }));
        }
        Ok(built.map_err(|mut errors| {
            let is_unknown = |name: &String| read.unknown.contains(name);
            if !launcher.closes_files() && errors.failed_crates.iter().any(is_unknown) {
                let limit = errors
                    .limit
                    .map(|limit| format!("error: building was ended: {limit}\n"));
                errors.messages = limit.unwrap_or_default() + NOT_SHOWN;
            }
            errors
        }))
    }

    /// How long cargo may run; `None` if it is not limited.
    fn most_time(&self) -> Option<Duration> {
        let end = self.launcher?.end();
        let left = end.map(|end| end.saturating_duration_since(Awake::now()));
        Some(left.map_or(MOST_TIME, |left| left.min(MOST_TIME)))
    }

    /// Makes sure that the errors of a limited build are the fault of a stage. If it was ended
    /// before the compiler named a crate, the first feature counts.
    fn blame_the_code(
        &self,
        errors: &mut CompileErrors,
        features: &[&str],
    ) -> Result<(), GraderError> {
        let stages = self.root.join("stages");
        let is_given =
            |name: &&String| *name != WORKER && (*name == "kit" || !stages.join(name).is_dir());
        if let Some(given) = errors.failed_crates.iter().find(is_given) {
            return Err(GraderError::new(format!(
                "the course's own crate `{given}` cannot be built for submissions: {}",
                errors.messages.trim()
            )));
        }
        if errors.failed_crates.is_empty() {
            let first = features.iter().map(ToString::to_string);
            errors.failed_crates.extend(first.take(1));
        }
        Ok(())
    }

    /// Adds an error for each file of a stage that failed which is no text: the compiler may not say
    /// where it met this file.
    fn add_files_without_text(&self, errors: &mut CompileErrors, show: bool) {
        for stage in errors.failed_crates.clone() {
            for sentence in sources::files_without_text(self.root, &stage) {
                let sentence = format!("error: {sentence}\n");
                if show {
                    err!("{sentence}");
                }
                errors.messages.insert_str(0, &sentence);
                errors.wrong_crates.insert(stage.clone());
            }
        }
    }

    /// Adds to the errors of a build what those about the worker mean.
    fn with_explanation(
        &self,
        mut errors: CompileErrors,
        features: &[&str],
        show: bool,
    ) -> CompileErrors {
        let calls = &errors.worker_messages;
        let explanation = match features {
            _ if calls.is_empty() => return errors,
            [stage] if self.root.join("stages").join(stage).is_dir() => {
                changed_signature::explain(self.root, stage, calls)
            }
            // Each stage is built alone next.
            _ => calls.clone(),
        };
        if show && features.len() == 1 {
            err!("{explanation}");
        }
        errors.messages.push_str(&explanation);
        errors
    }

    fn command(&self, features: &[&str], colours: bool) -> Command {
        let mut command = match self.launcher {
            // In the folder of the launcher's choice: cargo reads settings in all folders above.
            Some(launcher) => {
                let mut command = launcher.cargo();
                build_arguments(&mut command, WORKER, colours);
                command
                    .arg("--manifest-path")
                    .arg(self.root.join("Cargo.toml"));
                command
            }
            None => release_build(self.root, WORKER, colours),
        };
        let mut features = features.join(",");
        if self.launcher.is_some() {
            features.push_str(",sandbox");
        }
        command.args([
            "--keep-going",
            "--no-default-features",
            "--features",
            &features,
        ]);
        if self.sealed {
            command.args(["--offline", "--locked"]);
        }
        command.stderr(Stdio::piped());
        if colours {
            command.env("CARGO_TERM_COLOR", "always");
        }
        let target = self.target.map(Path::to_path_buf);
        if let Some(target) = target.or_else(|| target_folder::of(self.root)) {
            command.arg("--target-dir").arg(target);
        }
        command
    }
}

/// Returns an error if a crate failed that is not of the workspace: the settings of cargo or the
/// toolchain are at fault. A worked example is a program of its stage.
fn ensure_libraries_compile(root: &Path, errors: &CompileErrors) -> Result<(), GraderError> {
    let is_own = |name: &String| {
        let mut folders = ["stages", "grader"].into_iter();
        name == WORKED_EXAMPLE || folders.any(|folder| root.join(folder).join(name).is_dir())
    };
    match errors.failed_crates.iter().find(|name| !is_own(name)) {
        None => Ok(()),
        Some(library) => Err(GraderError::new(format!(
            "this machine cannot build the library `{library}`. This is no error in the code, so nothing is graded. See the compiler's messages, and settings such as `target` in a `.cargo/config.toml` above or at home; `cargo grader doctor` says what is missing"
        ))),
    }
}

/// Builds the program of `package` in the workspace `root`, in release. The program must not link a
/// stage. Returns its path, or the compiler's messages, which were also printed to stderr.
pub fn build_program(root: &Path, package: &str) -> Result<Result<PathBuf, String>, GraderError> {
    build_in(root, package, None)
}

/// As [`build_program`], for a program that links the stages of the workspace.
pub fn build_program_with_stages(
    root: &Path,
    package: &str,
) -> Result<Result<PathBuf, String>, GraderError> {
    let stamps = own_stamps(root, "release");
    let built = build_in(root, package, target_folder::of(root))?;
    if built.is_ok() {
        stamps.iter().for_each(Stamps::store);
    }
    Ok(built)
}

/// The test program of each stage with the worked examples of its chapters.
pub(crate) const WORKED_EXAMPLE: &str = "worked_example";

/// Builds the worked examples of `stage` as `cargo test` does. Returns the test program, or `None`
/// if it does not compile: the compiler's messages were printed to stderr.
pub(crate) fn build_worked_example(
    root: &Path,
    stage: &str,
) -> Result<Option<PathBuf>, GraderError> {
    if is_first_build(root, "debug/deps") {
        errln!("Compiling the tests, as `cargo test` does: half a minute the first time.");
    }
    let stamps = own_stamps(root, "debug");
    let mut command = cargo_in(root);
    command.args(["test", "--no-run", "--test", WORKED_EXAMPLE]);
    command.args(["--package", stage]);
    in_json(&mut command, has_colours());
    if let Some(target) = target_folder::of(root) {
        command.arg("--target-dir").arg(target);
    }
    let built = run_cargo(command, stage, true, None)?;
    match &built {
        Ok(_) => stamps.iter().for_each(Stamps::store),
        Err(errors) => {
            ensure_libraries_compile(root, errors)?;
            errors.ensure_of_the_code()?;
        }
    }
    Ok(built.ok())
}

/// The folder in which cargo builds the stages of the workspace `root`; `None` for cargo's default.
pub fn stages_target(root: &Path) -> Option<PathBuf> {
    target_folder::of(root)
}

fn build_in(
    root: &Path,
    package: &str,
    target: Option<PathBuf>,
) -> Result<Result<PathBuf, String>, GraderError> {
    match run_cargo(program_build(root, package, target), package, true, None)? {
        Ok(program) => Ok(Ok(program)),
        Err(errors) => {
            errors.ensure_of_the_code()?;
            Ok(Err(errors.messages))
        }
    }
}

/// The command that builds the program of `package`, in `target` or in cargo's own folder.
fn program_build(root: &Path, package: &str, target: Option<PathBuf>) -> Command {
    let mut command = release_build(root, package, has_colours());
    match target {
        Some(target) => command.arg("--target-dir").arg(target),
        // With the features of the grader's libraries: what is compiled for it is used.
        None => command.args(["--package", "grader"]),
    };
    command
}

/// Whether cargo has never written `file` in its own folder of the workspace `root`.
fn is_first_build(root: &Path, file: &str) -> bool {
    let is_own = target_folder::of(root).is_none();
    is_own && own_target(root).is_some_and(|target| !target.join(file).exists())
}

/// The folder in which cargo builds the stages of the workspace `root`.
fn own_target(root: &Path) -> Option<PathBuf> {
    target_folder::of(root).or_else(|| {
        let program = std::env::current_exe().ok()?;
        Some(program.parent()?.parent()?.to_path_buf())
    })
}

/// The stamps of the workspace `root` before a build of this profile in its own target folder.
fn own_stamps(root: &Path, profile: &str) -> Option<Stamps> {
    Some(Stamps::before_build(root, &own_target(root)?.join(profile)))
}

fn has_colours() -> bool {
    std::io::stderr().is_terminal()
}

/// The command `cargo build --release` for the program of `package`, which has the package's name.
fn release_build(root: &Path, package: &str, colours: bool) -> Command {
    let mut command = cargo_in(root);
    build_arguments(&mut command, package, colours);
    command
}

/// Cargo in the workspace `root`. Warnings in a student's code are no errors.
pub(crate) fn cargo_in(root: &Path) -> Command {
    let mut command = Command::new(child_processes::cargo());
    command.current_dir(root);
    if let Ok(flags) = std::env::var("RUSTFLAGS") {
        command.env("RUSTFLAGS", with_warnings_allowed(&flags));
    }
    command
}

/// Flags of the compiler without those that make each warning an error, as continuous integration
/// sets them: a variable that is not used costs no points.
fn with_warnings_allowed(flags: &str) -> String {
    let mut text = format!(
        " {} ",
        flags.split_whitespace().collect::<Vec<_>>().join(" ")
    );
    for flag in ["-D", "-F", "--deny", "--forbid"] {
        for between in ["", " ", "="] {
            text = text.replace(&format!(" {flag}{between}warnings "), " ");
        }
    }
    text.trim().to_string()
}

/// The arguments of that command.
fn build_arguments(command: &mut Command, package: &str, colours: bool) {
    command.args(["build", "--release", "--package", package, "--bin", package]);
    in_json(command, colours);
}

/// Lets cargo print its messages as JSON.
fn in_json(command: &mut Command, colours: bool) {
    command
        .arg("--message-format")
        .arg(if colours {
            "json-diagnostic-rendered-ansi"
        } else {
            "json"
        })
        .stdin(Stdio::null())
        .stdout(Stdio::piped());
}

/// A clock may be set by less than this while somebody works; the files of a shared disk have the
/// time of another machine.
const CLOCK_SLACK: Duration = Duration::from_secs(60);

/// Returns an error if `program` was built later than `now`: then cargo, which compares times, may
/// not see what was changed since the clock went back, and older code would be graded.
fn ensure_not_of_the_future(program: &Path, now: SystemTime) -> Result<(), GraderError> {
    let read = |e| GraderError::file("read", program, e);
    let built = program.metadata().map_err(read)?.modified().map_err(read)?;
    match built.duration_since(now) {
        Ok(ahead) if ahead > CLOCK_SLACK => Err(GraderError::new(format!(
            "{} is of a time that this machine's clock has not reached yet, so cargo does not see what was changed since. Nothing was graded. If the clock is right, remove {} and run again",
            program.display(),
            program.parent().unwrap_or(program).display()
        ))),
        _ => Ok(()),
    }
}

/// Copies the worker to a name that contains its features, because the next build with other
/// features overwrites the original.
fn copy_under_own_name(program: PathBuf, features: &[&str]) -> Result<PathBuf, GraderError> {
    let mut name = format!("worker-{}", features.join("-"));
    name.push_str(std::env::consts::EXE_SUFFIX);
    let copy = program.with_file_name(name);
    // Writes a new file and renames it, so that a worker that still runs keeps its old file.
    let fresh = copy.with_extension(format!("new{}", std::process::id()));
    let copied = std::fs::copy(&program, &fresh).and_then(|_| std::fs::rename(&fresh, &copy));
    copied.map_err(|e| {
        let _ = std::fs::remove_file(&fresh); // it may be incomplete
        GraderError::file("write", &copy, e)
    })?;
    Ok(copy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_stay_warnings() {
        for (flags, allowed) in [
            ("-D warnings", ""),
            ("-Dwarnings  --deny=warnings", ""),
            (
                "-C target-cpu=native --forbid warnings -W unused",
                "-C target-cpu=native -W unused",
            ),
            ("-D unused", "-D unused"),
        ] {
            assert_eq!(with_warnings_allowed(flags), allowed);
        }
    }

    #[test]
    fn a_program_from_the_future_is_not_run() {
        let folder = tempfile::tempdir().unwrap();
        let program = folder.path().join("worker");
        std::fs::write(&program, "").unwrap();
        let built = program.metadata().unwrap().modified().unwrap();
        let at = |now| ensure_not_of_the_future(&program, now).map_err(|why| why.to_string());
        assert_eq!(at(built), Ok(()));
        assert_eq!(at(built + 100 * CLOCK_SLACK), Ok(()));
        assert_eq!(at(built - CLOCK_SLACK / 2), Ok(()));
        let why = at(built - 2 * CLOCK_SLACK).unwrap_err();
        assert!(why.contains("clock has not reached yet"), "{why}");
    }

    /// A library with other features than the grader's would be compiled a second time.
    #[test]
    fn a_program_has_the_features_of_the_graders_libraries() {
        let command = program_build(Path::new("."), "book", None);
        let args: Vec<_> = command.get_args().collect();
        let is_named = |name| args.windows(2).any(|pair| pair == ["--package", name]);
        assert!(is_named("book") && is_named("grader"), "{args:?}");
    }

    /// A changed signature shows only where the worked example calls the function.
    #[test]
    fn an_error_in_a_worked_example_is_no_fault_of_the_machine() {
        let mut errors = CompileErrors::default();
        let says = "this function takes 3 arguments but 2 arguments were supplied";
        errors.add(WORKED_EXAMPLE, says.into(), true);
        assert_eq!(ensure_libraries_compile(Path::new("."), &errors), Ok(()));
    }

    /// The compiler does not say where it met a first file that is no text.
    #[test]
    fn a_file_in_utf_16_is_named_and_the_machine_is_not() {
        let folder = tempfile::tempdir().unwrap();
        let src = folder.path().join("stages/raygen/src");
        std::fs::create_dir_all(&src).unwrap();
        let root = BuildRoot {
            root: folder.path(),
            target: None,
            sealed: false,
            quiet: true,
            launcher: None,
        };
        let utf_16 = |mark: &[u8]| {
            let text = "pub fn f() {}".encode_utf16().flat_map(u16::to_le_bytes);
            mark.iter().copied().chain(text).collect::<Vec<u8>>()
        };
        for (bytes, is) in [
            (utf_16(b"\xff\xfe"), "UTF-16 text"),
            (utf_16(b""), "UTF-16 text"),
            (b"// caf\xe9\n".to_vec(), "no UTF-8 text"),
        ] {
            std::fs::write(src.join("lib.rs"), &bytes).unwrap();
            let mut errors = CompileErrors::default();
            errors.add("raygen", "couldn't read `lib.rs`".into(), false);
            assert!(errors.ensure_of_the_code().is_err());
            root.add_files_without_text(&mut errors, false);
            let expected = format!("error: stages/raygen/src/lib.rs is {is}");
            assert!(
                errors.messages.starts_with(&expected),
                "{}",
                errors.messages
            );
            assert_eq!(errors.ensure_of_the_code(), Ok(()));
            assert_eq!(ensure_libraries_compile(root.root, &errors), Ok(()));
            errors.add("serde_core", "can't find crate for `core`".into(), true);
            let why = ensure_libraries_compile(root.root, &errors).unwrap_err();
            assert!(
                why.to_string().contains("the library `serde_core`"),
                "{why}"
            );
        }
    }
}
