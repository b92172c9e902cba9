//! What is read of a submission: its source files, its hash, what was unusual about it.

use super::intake::{self, CommitTimes, Revision};
use crate::hash::Hasher;
use base::Workspace;
use base::{GraderError, is_of_the_machine};
use grader::course::Course;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use submission::Untrusted;
use submission::one::NotGraded;
use submission::read::Submission;

/// A submission that was opened and read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Content {
    /// The files of its stages.
    pub submission: Submission,
    /// The hash of the files that are graded.
    pub files: String,
    /// The hash of all that scores and notes depend on: also which files the course does not take,
    /// because it has others.
    pub hash: String,
    /// The hashes of the source files of each stage.
    pub sources: BTreeMap<String, String>,
    /// What was unusual about its form, as sentences.
    pub notes: Vec<Untrusted>,
    /// When its commit was made, if it is one of a clone.
    pub commit: Option<CommitTimes>,
}

/// Why a submission cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Unreadable {
    /// It is larger than a submission may be, or reading it takes more. The sentence names the limit.
    TooLarge(String),
    /// It is damaged, in another form, or not a submission. The sentence says what was found.
    Damaged(String),
    /// It is no clone, and a commit or a time was asked for. The sentence says what was found.
    /// Whether it counts is for a person to say.
    NoClone(String),
    /// The machine failed: its disk is full, for example. It may succeed if it is tried again.
    Machine(String),
}

impl Unreadable {
    /// The sentence, without its kind.
    pub fn why(self) -> String {
        match self {
            Unreadable::TooLarge(why)
            | Unreadable::Damaged(why)
            | Unreadable::NoClone(why)
            | Unreadable::Machine(why) => why,
        }
    }
}

impl From<GraderError> for Unreadable {
    fn from(error: GraderError) -> Unreadable {
        Unreadable::Machine(error.to_string())
    }
}

/// The error `e` at reading what was handed in: the machine's, or what `damage` says of the file.
pub(super) fn unreadable(
    action: &str,
    path: &Path,
    e: &std::io::Error,
    damage: impl FnOnce() -> String,
) -> Unreadable {
    match is_of_the_machine(e) {
        true => GraderError::file(action, path, e).into(),
        false => Unreadable::Damaged(damage()),
    }
}

/// Opens and reads the folder or file `path`.
pub fn read(
    path: &Path,
    course: &Course,
    workspace: &Workspace,
    revision: Option<&Revision>,
) -> Result<Content, Unreadable> {
    let opened = intake::open(path, &course.stages(), revision)?;
    let submission = Submission::read(&opened.root, course, workspace.root());
    let submission = submission.map_err(|error| {
        let mut why = match error {
            NotGraded::Infrastructure(why) => return Unreadable::Machine(why),
            NotGraded::Refused(why) => why,
        };
        // The folder may be a temporary one, with another name every time.
        let real = opened.root.canonicalize().ok();
        for root in real.iter().chain([&opened.root]) {
            let root = root.display().to_string();
            why = why.replace(&format!("{root}/"), "");
            why = why.replace(&root, "its folder");
        }
        Unreadable::Damaged(format!("cannot be used: {why}"))
    })?;
    let mut sources = BTreeMap::new();
    for (stage, files) in &submission.stages {
        let mut hasher = Hasher::default();
        for (path, text) in files {
            hasher.part(path.to_string_lossy().as_bytes()).part(text);
        }
        sources.insert(stage.clone(), hasher.finish());
    }
    let mut hasher = Hasher::default();
    for (stage, hash) in &sources {
        hasher.part(stage).part(hash);
    }
    for (stage, text) in &submission.examples {
        hasher.part("examples").part(stage).part(text);
    }
    let files = hasher.finish();
    let mut hasher = Hasher::default();
    hasher.part(&files).part("ignored");
    for path in &submission.ignored {
        hasher.part(path.raw());
    }
    let notes = opened
        .notes
        .iter()
        .chain(&submission.notes)
        .map(|note| Untrusted::from(note.as_str()))
        .collect();
    Ok(Content {
        submission,
        files,
        hash: hasher.finish(),
        sources,
        notes,
        commit: opened.commit,
    })
}
