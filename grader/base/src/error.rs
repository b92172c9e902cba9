//! Errors that are not the fault of the student's code.

use std::fmt;
use std::path::Path;

/// An error in the grader or in its input. The message says what happened, where, and what to do.
/// A program that returns it ends with exit code 2.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GraderError(String);

impl GraderError {
    /// An error with this message.
    pub fn new(message: impl Into<String>) -> GraderError {
        GraderError(message.into())
    }

    /// The error "cannot `action` `path`: `cause`", such as "cannot read a.toml: not found".
    pub fn file(action: &str, path: &Path, cause: impl fmt::Display) -> GraderError {
        GraderError(format!("cannot {action} {}: {cause}", path.display()))
    }
}

/// The cause of an error about a temporary file, without the file's random name.
pub fn without_path(error: &std::io::Error) -> String {
    let inner = error.get_ref().and_then(std::error::Error::source);
    let text = inner.map_or_else(|| error.to_string(), ToString::to_string);
    // `tempfile` adds the path to the text, and has no source.
    text.split(" at path \"").next().unwrap_or_default().into()
}

impl fmt::Display for GraderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for GraderError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_temporary_files_are_left_out() {
        let error = tempfile::Builder::new()
            .tempfile_in("no/such/folder")
            .expect_err("the folder does not exist");
        assert!(error.to_string().contains("no/such/folder"));
        assert!(!without_path(&error).contains("folder\""), "{error}");
        assert!(without_path(&error).contains("os error"), "{error}");
    }
}
