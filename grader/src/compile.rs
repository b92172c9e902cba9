//! Building the worker with the student's stages, and other programs of the workspace.

use crate::child_processes;
use crate::error::GraderError;
use crate::target_folder;
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::io::{BufRead, BufReader, IsTerminal};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// How building a worker ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Built {
    /// The program.
    Worker(PathBuf),
    /// Some of the code does not compile.
    DoesNotCompile(Broken),
}

/// Code that does not compile.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Broken {
    /// The crates that have errors. What depends on them was not tried.
    pub crates: BTreeSet<String>,
    /// The compiler's messages, which have been shown on stderr unless the build is sealed.
    pub messages: String,
}

/// A build of the worker, in release.
#[derive(Clone, Copy, Debug)]
pub struct Build<'a> {
    /// The workspace's top folder.
    pub root: &'a Path,
    /// Cargo features: the stages to link, all of which are tried even where one does not compile.
    pub features: &'a [&'a str],
    /// Where cargo keeps what it builds, if not in the workspace.
    pub target: Option<&'a Path>,
    /// No network, no other versions of libraries than the lock file's, and nothing shown: for code that is not
    /// the caller's own.
    pub sealed: bool,
}

impl Build<'_> {
    /// Runs cargo. Its progress and the compiler's messages go to stderr as they come.
    pub fn run(&self) -> Result<Built, GraderError> {
        let show = !self.sealed;
        match follow(self.command(show && has_colours()), "worker", show)? {
            Ok(program) => keep_apart(program, self.features),
            Err(broken) => Ok(Built::DoesNotCompile(broken)),
        }
    }

    fn command(&self, colours: bool) -> Command {
        let mut command = release_build(self.root, "worker", colours);
        command.args([
            "--keep-going",
            "--no-default-features",
            "--features",
            &self.features.join(","),
        ]);
        if self.sealed {
            command
                .args(["--offline", "--locked"])
                .stderr(Stdio::piped());
        }
        let target = self.target.map(Path::to_path_buf);
        if let Some(target) = target.or_else(|| target_folder::of(self.root)) {
            command.arg("--target-dir").arg(target);
        }
        command
    }
}

/// Builds the program of `package`, which links no stage, in release: the program, or the compiler's messages, which
/// have been shown on stderr.
pub fn program(root: &Path, package: &str) -> Result<Result<PathBuf, String>, GraderError> {
    build_program(root, package, None)
}

/// As [`program`], for a program that links the stages of the workspace.
pub fn program_with_stages(
    root: &Path,
    package: &str,
) -> Result<Result<PathBuf, String>, GraderError> {
    build_program(root, package, target_folder::of(root))
}

fn build_program(
    root: &Path,
    package: &str,
    target: Option<PathBuf>,
) -> Result<Result<PathBuf, String>, GraderError> {
    let mut command = release_build(root, package, has_colours());
    if let Some(target) = target {
        command.arg("--target-dir").arg(target);
    }
    let followed = follow(command, package, true)?;
    Ok(followed.map_err(|broken| broken.messages))
}

fn has_colours() -> bool {
    std::io::stderr().is_terminal()
}

/// Cargo, told to build the program of `package`, which has the package's name.
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

/// Runs cargo to its end: the program that it built, or what the compiler says against the code. `show` passes that on to
/// stderr.
fn follow(
    mut command: Command,
    package: &str,
    show: bool,
) -> Result<Result<PathBuf, Broken>, GraderError> {
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
        .ok_or_else(|| GraderError::new("cargo has no output"))?;
    let mut program = None;
    let mut broken = Broken::default();
    for line in BufReader::new(stdout).lines() {
        let line =
            line.map_err(|e| GraderError::new(format!("cannot read cargo's messages: {e}")))?;
        match Message::read(&line) {
            Some(Message::Program(path)) => program = Some(path),
            Some(Message::Warning(text)) if show => eprint!("{text}"),
            Some(Message::Warning(_)) | None => {}
            Some(Message::Error { text, of_crate }) => {
                if show {
                    eprint!("{text}");
                }
                broken.messages.push_str(&text);
                broken.crates.insert(of_crate);
            }
        }
    }
    let status = child
        .wait()
        .map_err(|e| GraderError::new(format!("cargo was lost: {e}")))?;
    let said = progress.map(|thread| thread.join().ok().and_then(Result::ok).unwrap_or_default());
    match program {
        Some(program) if status.success() => Ok(Ok(program)),
        _ if !broken.messages.is_empty() => Ok(Err(broken)),
        // Nothing that the code could be blamed for: a library that is not there, a broken manifest.
        _ => Err(GraderError::new(format!(
            "cargo could not build the package {package} in {} ({status}). {}",
            command
                .get_current_dir()
                .unwrap_or(Path::new("."))
                .display(),
            said.as_deref().unwrap_or("Its reason stands above.").trim()
        ))),
    }
}

/// One of cargo's JSON messages, if it is of interest.
enum Message {
    /// A program was built, or was there already.
    Program(PathBuf),
    /// The compiler is not content.
    Warning(String),
    /// The compiler gave up on a crate.
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
        if !level.starts_with("error") {
            return Some(Message::Warning(text));
        }
        let of_crate = message.get("target")?.get("name")?.as_str()?.to_string();
        Some(Message::Error { text, of_crate })
    }
}

/// The cargo that built the grader's caller, else the one on the path.
pub fn cargo() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Copies the program under a name of its own: the next build with other features would overwrite it.
fn keep_apart(program: PathBuf, features: &[&str]) -> Result<Built, GraderError> {
    let mut name = format!("worker-{}", features.join("-"));
    name.push_str(std::env::consts::EXE_SUFFIX);
    let copy = program.with_file_name(name);
    // Written beside and renamed: a worker that still runs from the old file is not disturbed.
    let fresh = copy.with_extension(format!("new{}", std::process::id()));
    let copied = std::fs::copy(&program, &fresh).and_then(|_| std::fs::rename(&fresh, &copy));
    copied.map_err(|e| {
        // Half a program is of no use to anybody.
        let _ = std::fs::remove_file(&fresh);
        GraderError::file("write", &copy, e)
    })?;
    Ok(Built::Worker(copy))
}
