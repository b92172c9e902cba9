//! Builds the worker with the student's stages, and other programs of the workspace.

use crate::changed_signature;
use crate::child_processes;
use crate::compile_warnings::Warnings;
use crate::error::GraderError;
use crate::target_folder;
use crate::workspace::Workspace;
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::io::{BufRead, BufReader, IsTerminal};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The result of building a worker.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BuildOutcome {
    /// The path of the program.
    Worker(PathBuf),
    /// At least one crate does not compile.
    DoesNotCompile(CompileErrors),
}

/// The errors of a build that failed because code does not compile.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CompileErrors {
    /// The crates that have errors. Crates that depend on them were not built.
    pub failed_crates: BTreeSet<String>,
    /// The compiler's messages, but instead of those about the worker what they mean for the stage,
    /// if the worker links one stage. They were also printed to stderr unless the build is quiet or
    /// sealed.
    pub messages: String,
    /// The compiler's messages about the worker itself: a stage's functions do not fit its calls.
    worker_messages: String,
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
}

/// The package and the crate of the worker.
const WORKER: &str = "worker";

impl BuildRoot<'_> {
    /// The workspace itself.
    pub fn of(workspace: &Workspace) -> BuildRoot<'_> {
        BuildRoot {
            root: workspace.root(),
            target: None,
            sealed: false,
            quiet: false,
        }
    }

    /// Builds the worker in release, with the stages of `features`. If one of them does not
    /// compile, the others are still built. Cargo's progress and the compiler's messages go to
    /// stderr as they arrive, unless the build is sealed.
    pub fn build_worker(&self, features: &[&str]) -> Result<BuildOutcome, GraderError> {
        let show = !self.sealed && !self.quiet;
        match run_cargo(self.command(features, show && has_colours()), WORKER, show)? {
            Ok(program) => copy_under_own_name(program, features),
            Err(errors) => Ok(BuildOutcome::DoesNotCompile(
                self.with_explanation(errors, features, show),
            )),
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
            eprint!("{explanation}");
        }
        errors.messages.push_str(&explanation);
        errors
    }

    fn command(&self, features: &[&str], colours: bool) -> Command {
        let mut command = release_build(self.root, WORKER, colours);
        command.args([
            "--keep-going",
            "--no-default-features",
            "--features",
            &features.join(","),
        ]);
        if self.sealed {
            command.args(["--offline", "--locked"]);
        }
        if self.sealed || self.quiet {
            command.stderr(Stdio::piped());
        }
        let target = self.target.map(Path::to_path_buf);
        if let Some(target) = target.or_else(|| target_folder::of(self.root)) {
            command.arg("--target-dir").arg(target);
        }
        command
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
    build_in(root, package, target_folder::of(root))
}

fn build_in(
    root: &Path,
    package: &str,
    target: Option<PathBuf>,
) -> Result<Result<PathBuf, String>, GraderError> {
    let mut command = release_build(root, package, has_colours());
    if let Some(target) = target {
        command.arg("--target-dir").arg(target);
    }
    let built = run_cargo(command, package, true)?;
    Ok(built.map_err(|errors| errors.messages))
}

fn has_colours() -> bool {
    std::io::stderr().is_terminal()
}

/// The command `cargo build --release` for the program of `package`, which has the package's name.
fn release_build(root: &Path, package: &str, colours: bool) -> Command {
    let mut command = Command::new(cargo());
    command
        .current_dir(root)
        .args(["build", "--release", "--package", package, "--bin", package])
        .arg("--message-format")
        .arg(if colours {
            "json-diagnostic-rendered-ansi"
        } else {
            "json"
        })
        .stdin(Stdio::null())
        .stdout(Stdio::piped());
    command
}

/// Runs cargo to its end. Returns the path of the program that it built, or the compiler's errors.
/// `show` also prints the compiler's messages to stderr.
fn run_cargo(
    mut command: Command,
    package: &str,
    show: bool,
) -> Result<Result<PathBuf, CompileErrors>, GraderError> {
    let (mut child, _running) = child_processes::start(&mut command).map_err(|e| {
        GraderError::new(format!(
            "cannot run cargo ({}): {e}. Is a Rust toolchain installed?",
            cargo().display()
        ))
    })?;
    let progress = child
        .stderr
        .take()
        .map(|pipe| std::thread::spawn(move || std::io::read_to_string(pipe)));
    let stdout = child
        .stdout
        .take()
        .ok_or_else(|| GraderError::new("cannot read cargo's standard output"))?;
    let mut program = None;
    let mut errors = CompileErrors::default();
    let mut warnings = Warnings::default();
    for line in BufReader::new(stdout).lines() {
        let line =
            line.map_err(|e| GraderError::new(format!("cannot read cargo's messages: {e}")))?;
        match Message::read(&line) {
            Some(Message::Program(path)) => program = Some(path),
            Some(Message::Warning { of_crate }) => warnings.add(&of_crate),
            None => {}
            Some(Message::Error { text, of_crate }) => {
                if of_crate == WORKER && package == WORKER {
                    errors.worker_messages.push_str(&text);
                } else {
                    if show {
                        eprint!("{text}");
                    }
                    errors.messages.push_str(&text);
                }
                errors.failed_crates.insert(of_crate);
            }
        }
    }
    let status = child
        .wait()
        .map_err(|e| GraderError::new(format!("cannot wait for cargo: {e}")))?;
    if show {
        eprint!("{}", warnings.summary());
    }
    let stderr = progress.map(|thread| thread.join().ok().and_then(Result::ok).unwrap_or_default());
    match program {
        Some(program) if status.success() => Ok(Ok(program)),
        _ if !errors.failed_crates.is_empty() => Ok(Err(errors)),
        // Not the fault of the code: a library is missing, for example, or a manifest is broken.
        _ => Err(GraderError::new(format!(
            "cargo could not build the package {package} in {} ({status}). {}",
            command
                .get_current_dir()
                .unwrap_or(Path::new("."))
                .display(),
            stderr
                .as_deref()
                .unwrap_or("Cargo's message is above.")
                .trim()
        ))),
    }
}

/// The messages of cargo that matter here, read from its JSON output.
enum Message {
    /// A program was built, or was up to date.
    Program(PathBuf),
    /// A warning of the compiler about a crate.
    Warning { of_crate: String },
    /// An error of the compiler in a crate.
    Error { text: String, of_crate: String },
}

impl Message {
    fn read(line: &str) -> Option<Message> {
        let message: serde_json::Value = serde_json::from_str(line).ok()?;
        if let Some(program) = message.get("executable").and_then(|path| path.as_str()) {
            return Some(Message::Program(program.into()));
        }
        let diagnostic = message.get("message")?;
        let level = diagnostic.get("level")?.as_str()?;
        let text = diagnostic.get("rendered")?.as_str()?.to_string();
        let of_crate = message.get("target")?.get("name")?.as_str()?.to_string();
        if !level.starts_with("error") {
            return Some(Message::Warning { of_crate });
        }
        Some(Message::Error { text, of_crate })
    }
}

/// The cargo that runs the grader, or else the one on the path.
pub fn cargo() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Copies the worker to a name that contains its features, because the next build with other
/// features overwrites the original.
fn copy_under_own_name(program: PathBuf, features: &[&str]) -> Result<BuildOutcome, GraderError> {
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
    Ok(BuildOutcome::Worker(copy))
}
