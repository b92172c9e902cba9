//! The command `grader offline`: downloads every library that the project can need.

use base::program::Exit;
use base::{GraderError, Workspace, bytes_below, child_processes, outln};
use clap::Command as CommandLine;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

pub(super) fn command() -> CommandLine {
    CommandLine::new("offline")
        .about("Downloads the libraries of all programs of the project, so that every command works without a network")
}

pub(super) fn run() -> Result<Exit, GraderError> {
    let workspace = Workspace::above(Path::new("."))?;
    let root = workspace.root();
    let host = host()?;
    fetch(root, &host, false)?;
    let folders = library_folders(root, &host)?;
    let size: u64 = folders.iter().map(|folder| bytes_below(folder)).sum();
    outln!(
        "{} are on this machine, {} MB unpacked. Every command works without a network now",
        judge::plural(folders.len(), "library", "libraries"),
        size.div_ceil(1 << 20)
    );
    Ok(Exit::Passed)
}

/// Whether all libraries are on this machine already.
pub(super) fn is_complete(root: &Path) -> bool {
    host().is_ok_and(|host| fetch(root, &host, true).is_ok())
}

/// The target triple of this machine, which cargo builds for.
fn host() -> Result<String, GraderError> {
    let output = Command::new("rustc")
        .arg("-vV")
        .output()
        .map_err(|e| GraderError::new(format!("cannot run rustc: {e}")))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let host = text.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned)
        .ok_or_else(|| GraderError::new("`rustc -vV` does not say for which machine it compiles"))
}

/// Downloads what is missing; `offline` fails instead.
fn fetch(root: &Path, host: &str, offline: bool) -> Result<(), GraderError> {
    let mut cargo = Command::new(child_processes::cargo());
    cargo
        .current_dir(root)
        .args(["fetch", "--locked", "--target", host]);
    if offline {
        cargo.args(["--offline", "--quiet"]);
        cargo.stderr(std::process::Stdio::null());
    }
    let status = cargo
        .status()
        .map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
    match status.success() {
        true => Ok(()),
        false => Err(GraderError::new(
            "cargo could not download every library: its message is above. Run this again with a network",
        )),
    }
}

/// The folders of the libraries that the project does not contain itself.
fn library_folders(root: &Path, host: &str) -> Result<BTreeSet<PathBuf>, GraderError> {
    let output = Command::new(child_processes::cargo())
        .current_dir(root)
        .args(["metadata", "--format-version", "1", "--locked", "--offline"])
        .args(["--filter-platform", host])
        .output()
        .map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
    let metadata: Value = serde_json::from_slice(&output.stdout).map_err(|e| {
        let says = String::from_utf8_lossy(&output.stderr);
        GraderError::new(format!(
            "cannot read `cargo metadata`: {e}. {}",
            says.trim()
        ))
    })?;
    Ok(folders_of(&metadata))
}

/// The folders of the packages of `cargo metadata` that have a source other than a folder.
fn folders_of(metadata: &Value) -> BTreeSet<PathBuf> {
    let packages = metadata["packages"].as_array().into_iter().flatten();
    let libraries = packages.filter(|package| !package["source"].is_null());
    let manifests = libraries.filter_map(|package| package["manifest_path"].as_str());
    manifests
        .filter_map(|path| Path::new(path).parent().map(Path::to_path_buf))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_projects_own_crates_are_not_downloaded() {
        let metadata = json!({"packages": [
            {"source": null, "manifest_path": "/course/stages/kit/Cargo.toml"},
            {"source": "registry+x", "manifest_path": "/registry/glam-0.34.0/Cargo.toml"},
        ]});
        let folders = folders_of(&metadata);
        assert!(folders.iter().eq([Path::new("/registry/glam-0.34.0")]));
    }
}
