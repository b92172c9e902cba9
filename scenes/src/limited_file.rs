//! Reads files of limited size, whatever their names lead to.

use crate::collada::limits::MAX_FILE_BYTES;
use crate::diagnostic::{Diagnostic, SceneError};
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::Path;

/// The bytes of a file. It is an error of the kind `FileTooLarge` if there are too many.
pub(crate) fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?
        .take(MAX_FILE_BYTES + 1)
        .read_to_end(&mut bytes)?;
    match bytes.len() as u64 > MAX_FILE_BYTES {
        false => Ok(bytes),
        true => {
            let why = format!("the file has more than {MAX_FILE_BYTES} bytes");
            Err(io::Error::new(ErrorKind::FileTooLarge, why))
        }
    }
}

/// The bytes of the scene file `path`, which messages call `name`. Its errors include advice.
pub(crate) fn read_scene(path: &Path, name: &str) -> Result<Vec<u8>, SceneError> {
    let read = read(path).map_err(|error| {
        let help = match error.kind() {
            ErrorKind::FileTooLarge => {
                return Diagnostic::about_file(name, error.to_string())
                    .help("simplify the meshes before the export");
            }
            ErrorKind::NotFound => "check the path: it is relative to the current folder",
            ErrorKind::PermissionDenied => "change the permissions of the file",
            _ => "pass the path of a file",
        };
        Diagnostic::about_file(name, format!("the file cannot be read: {error}")).help(help)
    });
    Ok(read?)
}
