//! Stores the answers in `target/first-light/predictions.json`. They are for the student alone and
//! give no points.

use base::{GraderError, Workspace, write_whole};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

/// What was answered, by the keys of the tasks.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Predictions(BTreeMap<String, Vec<Round>>);

/// One round of questions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Round {
    /// The seed of the numbers.
    pub seed: u64,
    /// The answers in the order of the questions.
    pub answers: Vec<Answer>,
}

/// An answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// The question.
    pub question: String,
    /// What was typed; empty for a question that was skipped.
    pub typed: String,
    /// Whether it was right.
    pub is_right: bool,
}

/// The file in a workspace.
pub fn file(workspace: &Workspace) -> PathBuf {
    workspace.outputs().join("predictions.json")
}

impl Predictions {
    /// Reads the predictions of a workspace: none if there is no file yet, an error if it is
    /// damaged.
    pub fn read(workspace: &Workspace) -> Result<Predictions, GraderError> {
        let path = file(workspace);
        match fs::read_to_string(&path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                Ok(Predictions::default())
            }
            Err(error) => Err(GraderError::file("read", &path, error)),
            Ok(text) => serde_json::from_str(&text).map_err(|error| {
                GraderError::new(format!(
                    "{} is damaged: {error}. Delete it: only what you predicted so far is lost",
                    path.display()
                ))
            }),
        }
    }

    /// Adds a round and writes the file.
    pub fn add(
        mut self,
        workspace: &Workspace,
        key: &str,
        round: Round,
    ) -> Result<(), GraderError> {
        self.0.entry(key.into()).or_default().push(round);
        workspace.create_outputs()?;
        let text =
            serde_json::to_string_pretty(&self).map_err(|e| GraderError::new(e.to_string()))?;
        write_whole(&file(workspace), text.as_bytes())
    }

    /// The rounds of a task so far.
    pub fn rounds(&self, key: &str) -> &[Round] {
        self.0.get(key).map_or(&[], Vec::as_slice)
    }
}
