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
    finding: Option<Finding>,
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

    /// What is wrong in the task `key`.
    pub fn of(&self, key: &str) -> Option<&Finding> {
        self.0.get(key)?.finding.as_ref()
    }

    /// Stores what is wrong in the task `key`, with this code.
    pub fn set(&mut self, key: &str, code: &str, finding: Option<Finding>) {
        let code = code.to_owned();
        self.0.insert(key.to_owned(), Entry { code, finding });
    }

    /// Writes all of them.
    pub fn write(&self, workspace: &Workspace) -> Result<(), GraderError> {
        workspace.create_outputs()?;
        let text = serde_json::to_string(self)
            .map_err(|e| GraderError::new(format!("cannot store the findings: {e}")))?;
        write_whole(&path(workspace), text.as_bytes())
    }
}

fn path(workspace: &Workspace) -> PathBuf {
    workspace.outputs().join("check.json")
}
