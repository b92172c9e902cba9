//! Where the goldens come from.

use super::read;
use base::{GraderError, Workspace, fnv};
use std::fmt::Write;
use std::process::Command;

/// The text of `golden/provenance.toml`.
pub(super) fn text(workspace: &Workspace) -> Result<String, GraderError> {
    let rustc = Command::new("rustc")
        .arg("--version")
        .output()
        .map(|output| String::from_utf8_lossy(&output.stdout).trim().to_string())
        .unwrap_or_default();
    let mut text = String::from("# Written by `grader bless`: what the goldens were made with.\n");
    let _ = writeln!(text, "toolchain = {rustc:?}");
    let _ = writeln!(
        text,
        "target = \"{}-{}\"",
        std::env::consts::ARCH,
        std::env::consts::OS
    );
    let _ = writeln!(
        text,
        "flags = {:?}",
        std::env::var("RUSTFLAGS").unwrap_or_default()
    );
    let _ = writeln!(
        text,
        "seed = 0\noracle = \"every golden is judged in all aspects at the robust bounds, except for what not_judged.txt lists\"\n\n[scenes]"
    );
    let folder = workspace.root().join("scenes/dae");
    let mut scenes = Vec::new();
    for entry in std::fs::read_dir(&folder).map_err(|e| GraderError::file("read", &folder, e))? {
        scenes.push(
            entry
                .map_err(|e| GraderError::file("read", &folder, e))?
                .path(),
        );
    }
    scenes.sort();
    for path in scenes {
        let name = path.file_name().unwrap_or_default().display().to_string();
        let _ = writeln!(
            text,
            "{name:?} = \"{:016x}\"",
            read(&path)?.bytes().fold(fnv::START, fnv::add)
        );
    }
    Ok(text)
}
