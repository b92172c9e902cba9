//! The channel to the grader: a socket that the worker gets as its standard input.
//!
//! It is neither a file nor has it a name, so code that only knows paths cannot open it. What the
//! student's code writes to its standard input arrives there, but without the key.

use std::io::{self, Read};
use wire::Case;
use wire::file::{self, FrameWriter};

/// The worker's end of the channel.
pub(crate) struct Channel {
    pub(crate) cases: Vec<Case>,
    pub(crate) records: FrameWriter,
    /// Where the replies to its questions arrive.
    pub(crate) replies: Box<dyn Read + Send>,
}

/// Reads the cases.
#[cfg(unix)]
pub(crate) fn open(_records: &str) -> io::Result<Channel> {
    use std::os::fd::AsFd;
    use std::os::unix::net::UnixStream;
    let socket = UnixStream::from(io::stdin().as_fd().try_clone_to_owned()?);
    let (key, cases) = file::read_cases(&mut &socket)?;
    let replies = Box::new(std::fs::File::from(std::os::fd::OwnedFd::from(
        socket.try_clone()?,
    )));
    Ok(Channel {
        cases,
        records: FrameWriter::new(Box::new(socket), key),
        replies,
    })
}

/// Reads the cases from the standard input. Their records are appended to the file `records`.
#[cfg(not(unix))]
pub(crate) fn open(records: &str) -> io::Result<Channel> {
    let (key, cases) = file::read_cases(&mut io::stdin().lock())?;
    let out = std::fs::OpenOptions::new().append(true).open(records)?;
    Ok(Channel {
        cases,
        records: FrameWriter::new(Box::new(out), key),
        replies: Box::new(io::empty()),
    })
}
