//! Why a submission has no score.

use base::{GraderError, is_of_the_machine};
use std::fmt;
use std::io;
use std::path::Path;

/// Why a submission has no score. The text is a sentence for the person who grades.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotGraded {
    /// The folder is not a submission, or has a file that a submission may not contain. Grading it
    /// again does not help.
    Refused(String),
    /// The machine or the course failed, not the submission: a full disk, for example. It may
    /// succeed if it is tried again.
    Infrastructure(String),
}

impl NotGraded {
    /// The error `e` at reading what was handed in.
    pub(crate) fn at(action: &str, path: &Path, e: &io::Error) -> NotGraded {
        let why = GraderError::file(action, path, e).to_string();
        match is_of_the_machine(e) {
            true => NotGraded::Infrastructure(why),
            false => NotGraded::Refused(why),
        }
    }
}

impl From<GraderError> for NotGraded {
    fn from(error: GraderError) -> NotGraded {
        NotGraded::Infrastructure(error.to_string())
    }
}

impl From<NotGraded> for GraderError {
    fn from(error: NotGraded) -> GraderError {
        GraderError::new(error.to_string())
    }
}

impl fmt::Display for NotGraded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (NotGraded::Refused(why) | NotGraded::Infrastructure(why)) = self;
        f.write_str(why)
    }
}

impl std::error::Error for NotGraded {}
