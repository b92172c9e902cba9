//! Runs `cargo check` for the stages. Its messages go to the editor unchanged.

use super::rustc_message::CrateName;
use base::{GraderError, child_processes, outln};
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

/// What `cargo check` found.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// The libraries that compile, by name.
    pub crates: BTreeMap<String, CrateName>,
    /// Whether everything compiles, tests included.
    pub compiles: bool,
}

/// Checks `packages` of the workspace `root`, in the folder `target` if one is given. With a
/// `format`, cargo prints JSON, which this function copies to stdout line by line, but for the last
/// one: more messages may follow. Otherwise cargo prints for people.
pub fn run(
    root: &Path,
    target: Option<&Path>,
    packages: &[&str],
    format: Option<&str>,
) -> Result<Checked, GraderError> {
    let mut command = Command::new(child_processes::cargo());
    command
        .current_dir(root)
        .args(["check", "--all-targets", "--keep-going"])
        .stdin(Stdio::null());
    for package in packages {
        command.args(["--package", package]);
    }
    if let Some(target) = target {
        command.arg("--target-dir").arg(target);
    }
    if let Some(format) = format {
        let format = format!("--message-format={format}");
        command.arg(format).stdout(Stdio::piped());
    }
    let (mut child, _running) = child_processes::start(&mut command)
        .map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
    let mut checked = Checked::default();
    if let Some(stdout) = child.stdout.take() {
        for line in BufReader::new(stdout).lines() {
            let line =
                line.map_err(|e| GraderError::new(format!("cannot read cargo's messages: {e}")))?;
            if checked.read(&line) {
                outln!("{line}");
            }
        }
    }
    let status = child.wait();
    let status = status.map_err(|e| GraderError::new(format!("cannot wait for cargo: {e}")))?;
    checked.compiles = status.success();
    Ok(checked)
}

impl Checked {
    /// Notes what a line of cargo says. Returns whether the editor gets the line.
    fn read(&mut self, line: &str) -> bool {
        let Ok(message) = serde_json::from_str::<Value>(line) else {
            return true;
        };
        let reason = message.get("reason").and_then(Value::as_str);
        if reason == Some("compiler-artifact")
            && let Some((name, of)) = library(&message)
        {
            self.crates.insert(name, of);
        }
        reason != Some("build-finished")
    }
}

/// The library that a message about an artifact is about.
fn library(message: &Value) -> Option<(String, CrateName)> {
    let target = message.get("target")?;
    let kinds = target.get("kind")?.as_array()?;
    kinds.iter().any(|kind| kind == "lib").then_some(())?;
    let name = target.get("name")?.as_str()?.to_owned();
    let of = CrateName {
        package_id: message.get("package_id")?.clone(),
        manifest_path: message.get("manifest_path")?.clone(),
        target: target.clone(),
    };
    Some((name, of))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn libraries_are_named_as_cargo_names_them_and_the_last_line_is_kept_back() {
        let mut checked = Checked::default();
        let artifact = r#"{"reason":"compiler-artifact","package_id":"path+file:///c/stages/bvh#0.1.0","manifest_path":"/c/stages/bvh/Cargo.toml","target":{"kind":["lib"],"name":"bvh"}}"#;
        let test = artifact
            .replace("\"lib\"", "\"test\"")
            .replace("\"name\":\"bvh\"", "\"name\":\"worst\"");
        assert!(checked.read(artifact) && checked.read(&test));
        assert!(checked.read("no JSON"));
        assert!(!checked.read(r#"{"reason":"build-finished","success":true}"#));
        assert_eq!(checked.crates.keys().collect::<Vec<_>>(), ["bvh"]);
        assert_eq!(
            checked.crates["bvh"].manifest_path,
            "/c/stages/bvh/Cargo.toml"
        );
    }
}
