//! Reads files of limited size.

use crate::collada::limits::MAX_FILE_BYTES;
use std::io;
use std::path::Path;

/// The bytes of a file, of limited size.
pub(super) fn read_file(path: &Path) -> io::Result<Vec<u8>> {
    let length = std::fs::metadata(path)?.len();
    if length > MAX_FILE_BYTES {
        let why = format!("it has {length} bytes, and {MAX_FILE_BYTES} are the limit");
        return Err(io::Error::other(why));
    }
    std::fs::read(path)
}
