//! The last result of every task, in `target/first-light/results.json`: a run of one task does not
//! erase what is known of the others.

use crate::course::Task;
use crate::course::sources;
use crate::report::table::status_text;
use crate::report::{Report, TaskReport};
use crate::score::Status;
use base::{GraderError, Workspace, write_whole};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The last results, by the keys of their tasks.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Results(BTreeMap<String, TaskScore>);

/// The last result of a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TaskScore {
    /// Core points earned.
    pub score: f64,
    /// Core points possible.
    pub max_score: f64,
    /// Robust points earned.
    pub robust_score: f64,
    /// Robust points possible.
    pub robust_max_score: f64,
    /// Whether it was attempted.
    pub attempted: bool,
    /// The status as text.
    pub status: String,
    /// The [fingerprint](sources::fingerprint) of the stage that was graded.
    pub sources: String,
}

#[cfg(test)]
impl TaskScore {
    /// The last result of an attempted task without robust points.
    pub(crate) fn of(score: f64, max_score: f64) -> TaskScore {
        TaskScore {
            score,
            max_score,
            robust_score: 0.0,
            robust_max_score: 0.0,
            attempted: true,
            status: String::new(),
            sources: String::new(),
        }
    }
}

impl TaskScore {
    /// Whether every core point was earned.
    pub fn is_complete(&self) -> bool {
        self.score >= self.max_score
    }
}

/// The fingerprint of each stage of some tasks.
pub type Fingerprints = BTreeMap<String, String>;

/// Computes the fingerprints of the stages of `tasks`. Call it before these are built.
pub fn fingerprints(workspace: &Workspace, tasks: &[&Task]) -> Result<Fingerprints, GraderError> {
    let stages = crate::course::stages_of(tasks.iter().copied());
    stages
        .into_iter()
        .map(|stage| {
            let files = sources::read(workspace.root(), stage)?;
            Ok((stage.to_owned(), sources::fingerprint(&files)))
        })
        .collect()
}

impl Results {
    /// Reads the stored results. Where nothing is stored or it cannot be read, nothing is known:
    /// the next run writes it anew.
    pub fn read(workspace: &Workspace) -> Results {
        let text = std::fs::read_to_string(path(workspace)).unwrap_or_default();
        serde_json::from_str(&text).unwrap_or_default()
    }

    /// Replaces the results of the tasks of `report`, whose stages had these fingerprints.
    pub fn merge(&mut self, report: &Report, fingerprints: &Fingerprints) {
        let scores = report.tasks.iter().map(|TaskReport { result, .. }| {
            let score = TaskScore {
                score: result.score,
                max_score: result.max_score,
                robust_score: result.robust_score,
                robust_max_score: result.robust_max_score,
                attempted: result.status != Status::NotAttempted,
                status: status_text(&result.status),
                sources: fingerprints.get(&result.stage).cloned().unwrap_or_default(),
            };
            (result.key.clone(), score)
        });
        self.0.extend(scores);
    }

    /// Stores the results.
    pub fn write(&self, workspace: &Workspace) -> Result<(), GraderError> {
        let json = serde_json::to_string_pretty(self)
            .map_err(|e| GraderError::new(format!("cannot write the results as JSON: {e}")))?;
        workspace.create_outputs()?;
        write_whole(&path(workspace), json.as_bytes())
    }

    /// The last result of the task `key`.
    pub fn of(&self, key: &str) -> Option<&TaskScore> {
        self.0.get(key)
    }
}

fn path(workspace: &Workspace) -> PathBuf {
    workspace.outputs().join("results.json")
}
