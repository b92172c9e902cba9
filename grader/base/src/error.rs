//! Errors that are not the fault of the student's code.

use std::fmt;
use std::io;
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

/// Whether the machine failed at reading or writing, such as a full disk, a lost network share or a
/// missing permission. Other errors are about what was read: a name that is too long, or bytes that
/// a library did not expect.
pub fn is_of_the_machine(error: &io::Error) -> bool {
    use io::ErrorKind as Kind;
    // A library may have packed the system's error into its own.
    let inner = error.get_ref().and_then(std::error::Error::source);
    let packed = inner.and_then(|source| source.downcast_ref::<io::Error>());
    if let Some(packed) = packed {
        return is_of_the_machine(packed);
    }
    let is_about_the_file = matches!(
        error.kind(),
        Kind::NotFound
            | Kind::NotADirectory
            | Kind::IsADirectory
            | Kind::AlreadyExists
            | Kind::InvalidFilename
            | Kind::InvalidInput
            | Kind::InvalidData
    );
    let code = error.raw_os_error();
    code.is_some_and(|code| !is_about_the_file && code != LINKS_IN_A_CIRCLE)
}

/// The system's number of an error for links that lead to each other (ELOOP).
const LINKS_IN_A_CIRCLE: i32 = if cfg!(target_os = "linux") { 40 } else { 62 };

/// The cause of an error about a temporary file, without the file's random name.
pub fn without_path(error: &io::Error) -> String {
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
    fn what_the_machine_lacks_is_not_the_files_fault() {
        // Too many open files, input or output, no space, no permission, a lost network share.
        for code in [24, 5, 28, 13, 116] {
            let error = io::Error::from_raw_os_error(code);
            assert!(is_of_the_machine(&error), "{error}");
        }
        let library = io::Error::new(io::ErrorKind::InvalidData, "no such method");
        for error in [
            io::Error::from_raw_os_error(22), // before the start of a file
            io::Error::from_raw_os_error(LINKS_IN_A_CIRCLE),
            io::Error::from_raw_os_error(2),
            io::ErrorKind::UnexpectedEof.into(),
            library,
        ] {
            assert!(!is_of_the_machine(&error), "{error}");
        }
    }

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
