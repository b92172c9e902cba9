//! What can go wrong that is not the student's code.

use std::fmt;
use std::path::Path;

/// The grader or its input is at fault: what, where, and what to do. Ends with exit code 2.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GraderError(String);

impl GraderError {
    /// An error with its whole sentence.
    pub fn new(sentence: impl Into<String>) -> GraderError {
        GraderError(sentence.into())
    }

    /// `doing` something with the file `path` failed.
    pub fn file(doing: &str, path: &Path, cause: impl fmt::Display) -> GraderError {
        GraderError(format!("cannot {doing} {}: {cause}", path.display()))
    }
}

/// What went wrong with a temporary file, without its name, which tells nobody anything.
pub fn without_path(error: &std::io::Error) -> String {
    let inner = error.get_ref().and_then(std::error::Error::source);
    inner.map_or_else(|| error.to_string(), ToString::to_string)
}

impl fmt::Display for GraderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for GraderError {}
