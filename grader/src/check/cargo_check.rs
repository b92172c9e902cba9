//! Runs `cargo check` for the stages. Its messages go to the editor unchanged.

use super::rustc_message::CrateName;
use crate::build::cargo_in;
use base::{GraderError, child_processes, err, outln};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::Stdio;

/// What `cargo check` found.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// The libraries that compile, by name.
    pub crates: BTreeMap<String, CrateName>,
    /// Whether everything compiles, tests included.
    pub compiles: bool,
}

/// Who reads the messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reader {
    /// An editor: cargo's JSON goes to stdout, line by line, but for the last one, because more
    /// messages may follow.
    Editor,
    /// A person: the compiler's text goes to stderr.
    Person,
}

/// Checks `packages` of the workspace `root`, in the folder `target` if one is given. `colours`
/// colours the compiler's text.
pub fn run(
    root: &Path,
    target: Option<&Path>,
    packages: &[&str],
    reader: Reader,
    colours: bool,
) -> Result<Checked, GraderError> {
    let mut command = cargo_in(root);
    command
        .args(["check", "--all-targets", "--keep-going", "--message-format"])
        .arg(match colours {
            true => "json-diagnostic-rendered-ansi",
            false => "json",
        })
        .stdin(Stdio::null())
        .stdout(Stdio::piped());
    for package in packages {
        command.args(["--package", package]);
    }
    if let Some(target) = target {
        command.arg("--target-dir").arg(target);
    }
    let (mut child, _running) = child_processes::start(&mut command)
        .map_err(|e| GraderError::new(format!("cannot run cargo: {e}")))?;
    let mut checked = Checked::default();
    let mut shown = BTreeSet::new();
    if let Some(stdout) = child.stdout.take() {
        for line in BufReader::new(stdout).lines() {
            let line =
                line.map_err(|e| GraderError::new(format!("cannot read cargo's messages: {e}")))?;
            let is_shown = checked.read(&line);
            match reader {
                Reader::Editor if is_shown => outln!("{line}"),
                Reader::Editor => {}
                Reader::Person => err!("{}", new_text(&line, &mut shown).unwrap_or_default()),
            }
        }
    }
    let status = child
        .wait()
        .map_err(|e| GraderError::new(format!("cannot wait for cargo: {e}")))?;
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

/// The text of a message that is not `shown` yet. A library is compiled for itself and for its
/// tests, with the same messages.
fn new_text(line: &str, shown: &mut BTreeSet<String>) -> Option<String> {
    rendered(line).filter(|text| shown.insert(text.clone()))
}

/// The text of a message of the compiler, as a terminal shows it.
fn rendered(line: &str) -> Option<String> {
    let message: Value = serde_json::from_str(line).ok()?;
    let rendered = message.get("message")?.get("rendered")?;
    rendered.as_str().map(str::to_owned)
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
        let warning = r#"{"reason":"compiler-message","message":{"rendered":"warning: x\n"}}"#;
        let mut shown = BTreeSet::new();
        let texts = [warning, warning].map(|line| new_text(line, &mut shown));
        assert_eq!(texts, [Some("warning: x\n".into()), None]);
        assert_eq!(rendered(artifact), None);
        assert!(!checked.read(r#"{"reason":"build-finished","success":true}"#));
        assert_eq!(checked.crates.keys().collect::<Vec<_>>(), ["bvh"]);
        assert_eq!(
            checked.crates["bvh"].manifest_path,
            "/c/stages/bvh/Cargo.toml"
        );
    }
}
