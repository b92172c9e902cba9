//! The findings of the last run: a task whose code did not change is not graded again, and an
//! editor still gets all of them.

use super::finding::Finding;
use base::{GraderError, Workspace, write_whole};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The findings by the keys of their tasks.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct StoredFindings(BTreeMap<String, Entry>);

/// What is wrong in a task, and the code that this is true of.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Entry {
    code: String,
    findings: Vec<Finding>,
}

impl StoredFindings {
    /// Reads what is stored. What cannot be read is not known.
    pub fn read(workspace: &Workspace) -> StoredFindings {
        let text = std::fs::read_to_string(path(workspace)).unwrap_or_default();
        serde_json::from_str(&text).unwrap_or_default()
    }

    /// Whether the task `key` was graded with this code.
    pub fn knows(&self, key: &str, code: &str) -> bool {
        self.0.get(key).is_some_and(|entry| entry.code == code)
    }

    /// What was wrong in the task `key` when it was last graded.
    pub fn of_task(&self, key: &str) -> &[Finding] {
        self.0.get(key).map_or(&[], |entry| &entry.findings)
    }

    /// What is wrong in the tasks `keys`. A task is left out whose failed cases run functions of
    /// other tasks, too, if one of those is wrong by itself.
    pub fn of_tasks<'a>(&self, keys: &[&'a str]) -> BTreeMap<&'a str, &[Finding]> {
        let wrong = keys
            .iter()
            .map(|key| (*key, self.of_task(key)))
            .filter(|(_, findings)| !findings.is_empty());
        let mut findings: BTreeMap<&str, &[Finding]> = wrong.collect();
        if !findings.values().all(|findings| only_with_others(findings)) {
            findings.retain(|_, findings| !only_with_others(findings));
        }
        findings
    }

    /// Stores what is wrong in the task `key`, with this code.
    pub fn set(&mut self, key: &str, code: &str, findings: Vec<Finding>) {
        let code = code.to_owned();
        self.0.insert(key.to_owned(), Entry { code, findings });
    }

    /// Writes all of them.
    pub fn write(&self, workspace: &Workspace) -> Result<(), GraderError> {
        workspace.create_outputs()?;
        let text = serde_json::to_string(self)
            .map_err(|e| GraderError::new(format!("cannot store the findings: {e}")))?;
        write_whole(&path(workspace), text.as_bytes())
    }
}

/// Whether something is wrong, and only together with functions of other tasks.
pub fn only_with_others(findings: &[Finding]) -> bool {
    findings.iter().any(|finding| finding.only_with_others)
}

fn path(workspace: &Workspace) -> PathBuf {
    workspace.outputs().join("check.json")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fails_together_with_a_wrong_task_is_left_out() {
        let finding = |only_with_others| vec![Finding::for_tests(only_with_others)];
        let mut stored = StoredFindings::default();
        stored.set("triangles", "", finding(false));
        stored.set("traversal", "", finding(true));
        stored.set("boxes", "", Vec::new());
        let wrong = |keys: &[&'static str]| Vec::from_iter(stored.of_tasks(keys).into_keys());
        assert_eq!(wrong(&["triangles", "traversal", "boxes"]), ["triangles"]);
        assert_eq!(wrong(&["traversal", "boxes"]), ["traversal"]);
    }
}
