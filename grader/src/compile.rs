//! Building the worker with the student's stages.

use crate::error::GraderError;
use crate::workspace::Workspace;
use std::ffi::OsString;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// How building a worker ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Built {
    /// The program.
    Worker(PathBuf),
    /// The student's code does not compile; cargo has said why on stderr.
    DoesNotCompile,
}

/// A build of the worker, in release.
#[derive(Clone, Copy, Debug)]
pub struct Build<'a> {
    /// The workspace's top folder.
    pub root: &'a Path,
    /// Cargo features: the stages to link.
    pub features: &'a [&'a str],
    /// Where cargo keeps what it builds, if not in the workspace.
    pub target: Option<&'a Path>,
}

/// Builds the worker of `workspace` with the given cargo features. Cargo's progress and errors go to stderr as
/// they come.
pub fn worker(workspace: &Workspace, features: &[&str]) -> Result<Built, GraderError> {
    Build {
        root: workspace.root(),
        features,
        target: None,
    }
    .run()
}

impl Build<'_> {
    /// Runs cargo. Its progress and errors go to stderr as they come.
    pub fn run(&self) -> Result<Built, GraderError> {
        let cargo = cargo();
        let mut command = Command::new(&cargo);
        command
            .current_dir(self.root)
            .args([
                "build",
                "--release",
                "--package",
                "worker",
                "--bin",
                "worker",
                "--no-default-features",
            ])
            .args([
                "--features",
                &self.features.join(","),
                "--message-format",
                "json-render-diagnostics",
            ]);
        if let Some(target) = self.target {
            command.arg("--target-dir").arg(target);
        }
        let mut child = command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(|e| {
                GraderError::new(format!(
                    "cannot run cargo ({}): {e}. Is a Rust toolchain installed?",
                    cargo.display()
                ))
            })?;
        let mut messages = String::new();
        let mut stdout = child
            .stdout
            .take()
            .ok_or_else(|| GraderError::new("cargo has no output"))?;
        stdout
            .read_to_string(&mut messages)
            .map_err(|e| GraderError::new(format!("cannot read cargo's messages: {e}")))?;
        let status = child
            .wait()
            .map_err(|e| GraderError::new(format!("cargo was lost: {e}")))?;
        if !status.success() {
            return Ok(Built::DoesNotCompile);
        }
        let program = messages.lines().filter_map(executable_of).next_back();
        let program = program.ok_or_else(|| {
            GraderError::new("cargo built no worker. Is `grader/worker` in the workspace?")
        })?;
        keep_apart(program, self.features)
    }
}

/// The cargo that built the grader's caller, else the one on the path.
pub(crate) fn cargo() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// The program that one of cargo's JSON messages speaks of.
fn executable_of(line: &str) -> Option<PathBuf> {
    let message: serde_json::Value = serde_json::from_str(line).ok()?;
    Some(PathBuf::from(message.get("executable")?.as_str()?))
}

/// Copies the program under a name of its own: the next build with other features would overwrite it.
fn keep_apart(program: PathBuf, features: &[&str]) -> Result<Built, GraderError> {
    let mut name = format!("worker-{}", features.join("-"));
    name.push_str(std::env::consts::EXE_SUFFIX);
    let copy = program.with_file_name(name);
    // Written beside and renamed: a worker that still runs from the old file is not disturbed.
    let fresh = copy.with_extension(format!("new{}", std::process::id()));
    let copied = std::fs::copy(&program, &fresh).and_then(|_| std::fs::rename(&fresh, &copy));
    copied.map_err(|e| GraderError::file("write", &copy, e))?;
    Ok(Built::Worker(copy))
}
