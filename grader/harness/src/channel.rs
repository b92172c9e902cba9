//! The channel to the grader: a socket that the worker gets as its standard input.
//!
//! It is neither a file nor has it a name, so code that only knows paths cannot open it. What the
//! student's code writes to its standard input arrives there, but without the key.

use std::io;
use wire::Case;
use wire::file::{self, FrameWriter};

/// Reads the cases and returns them with the writer of their records.
#[cfg(unix)]
pub(crate) fn open(_records: &str) -> io::Result<(Vec<Case>, FrameWriter)> {
    use std::os::fd::AsFd;
    use std::os::unix::net::UnixStream;
    let socket = UnixStream::from(io::stdin().as_fd().try_clone_to_owned()?);
    let (key, cases) = file::read_cases(&mut &socket)?;
    Ok((cases, FrameWriter::new(Box::new(socket), key)))
}

/// Reads the cases from the standard input. Their records are appended to the file `records`.
#[cfg(not(unix))]
pub(crate) fn open(records: &str) -> io::Result<(Vec<Case>, FrameWriter)> {
    let (key, cases) = file::read_cases(&mut io::stdin().lock())?;
    let out = std::fs::OpenOptions::new().append(true).open(records)?;
    Ok((cases, FrameWriter::new(Box::new(out), key)))
}
