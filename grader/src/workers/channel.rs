//! The grader's end of the channel to a worker: sends the cases, receives the frames.
//!
//! It is a socket without a name. Where the standard input of a program cannot be one, the worker
//! gets the cases through a pipe and writes its frames to a file.

use std::cell::Cell;
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::Stdio;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};
use wire::Case;
use wire::file::{self, FrameReader, Key};

/// How long a worker may take to read its cases.
#[cfg(unix)]
const SENDING: Duration = Duration::from_secs(120);

/// How often to look whether a worker sends something. Of the time between two looks no more
/// counts: where this program and its workers were stopped, or the clock jumped, no worker has
/// stalled.
const LOOK: Duration = Duration::from_secs(1);

/// How long a worker may still send nothing before it counts as stalled.
#[derive(Clone, Debug, Default)]
pub(crate) struct Deadline(Rc<Cell<Duration>>);

impl Deadline {
    /// The next frame may take this long from now on.
    pub(crate) fn set(&self, wait: Duration) {
        self.0.set(wait);
    }

    /// Whether it has passed.
    pub(crate) fn has_passed(&self) -> bool {
        self.0.get().is_zero()
    }

    /// Makes a `look` that waits no longer than it is told to.
    fn look<T>(&self, look: impl FnOnce(Duration) -> io::Result<T>) -> io::Result<T> {
        let left = self.0.get();
        if left.is_zero() {
            return Err(io::ErrorKind::TimedOut.into());
        }
        let start = Instant::now();
        let found = look(left.min(LOOK));
        let passed = start.elapsed().min(LOOK);
        self.0.set(left.saturating_sub(passed));
        found
    }
}

/// The end of a socket whose other end is the worker's standard input.
#[cfg(unix)]
#[derive(Debug)]
pub(crate) struct Channel {
    socket: std::os::unix::net::UnixStream,
    key: Key,
}

#[cfg(unix)]
impl Channel {
    /// A new channel, and what the worker gets as its standard input. A file of records would be
    /// in `folder`.
    pub(crate) fn new(_folder: &Path) -> io::Result<(Channel, Stdio)> {
        let (socket, theirs) = std::os::unix::net::UnixStream::pair()?;
        let key = Key::random();
        let theirs = std::os::fd::OwnedFd::from(theirs);
        Ok((Channel { socket, key }, theirs.into()))
    }

    /// The first argument of the worker.
    pub(crate) fn records(&self) -> &Path {
        Path::new("-")
    }

    /// Sends the cases. Afterwards the worker reads the end of its standard input, unless it is to
    /// read replies: the writer of these is returned.
    pub(crate) fn send(
        &self,
        cases: &[Case],
        replies: bool,
    ) -> io::Result<Option<impl Write + use<>>> {
        self.socket.set_write_timeout(Some(SENDING))?;
        let mut out = io::BufWriter::new(&self.socket);
        file::write_cases(&mut out, self.key, cases)?;
        if replies {
            return Ok(Some(self.socket.try_clone()?));
        }
        self.socket.shutdown(std::net::Shutdown::Write)?;
        Ok(None)
    }

    /// Whether a worker can read replies here.
    pub(crate) const REPLIES: bool = true;

    /// The frames of the worker as they arrive. They end when the deadline passes. `has_ended` says
    /// whether the worker has.
    pub(crate) fn frames(self, _has_ended: &Arc<AtomicBool>) -> (FrameReader, Deadline) {
        let deadline = Deadline::default();
        let input = Box::new(io::BufReader::new(UntilDeadline {
            socket: self.socket,
            deadline: deadline.clone(),
        }));
        (FrameReader::new(input, self.key), deadline)
    }
}

/// A socket that is read until a deadline passes.
#[cfg(unix)]
struct UntilDeadline {
    socket: std::os::unix::net::UnixStream,
    deadline: Deadline,
}

#[cfg(unix)]
impl Read for UntilDeadline {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        use io::ErrorKind::{ConnectionReset, TimedOut, WouldBlock};
        loop {
            let read = self.deadline.look(|wait| {
                self.socket.set_read_timeout(Some(wait))?;
                self.socket.read(buffer)
            });
            match read {
                Err(e) if matches!(e.kind(), WouldBlock | TimedOut) => {
                    if self.deadline.has_passed() {
                        return Err(e);
                    }
                }
                // A worker that ends before it has read all cases sends nothing more: its status
                // says why.
                Err(e) if e.kind() == ConnectionReset => return Ok(0),
                read => return read,
            }
        }
    }
}

/// A pipe to the worker's standard input, and a file that the worker writes to.
#[cfg(not(unix))]
#[derive(Debug)]
pub(crate) struct Channel {
    cases: io::PipeWriter,
    records: std::path::PathBuf,
    key: Key,
}

#[cfg(not(unix))]
impl Channel {
    /// A new channel, and what the worker gets as its standard input. The file of records is in
    /// `folder`.
    pub(crate) fn new(folder: &Path) -> io::Result<(Channel, Stdio)> {
        let (theirs, cases) = io::pipe()?;
        let records = folder.join("records");
        // Nothing that an earlier worker wrote is read again.
        std::fs::File::create(&records)?;
        let key = Key::random();
        let channel = Channel {
            cases,
            records,
            key,
        };
        Ok((channel, theirs.into()))
    }

    /// The first argument of the worker.
    pub(crate) fn records(&self) -> &Path {
        &self.records
    }

    /// Sends the cases.
    pub(crate) fn send(
        &self,
        cases: &[Case],
        _replies: bool,
    ) -> io::Result<Option<impl Write + use<>>> {
        file::write_cases(&mut io::BufWriter::new(&self.cases), self.key, cases)?;
        Ok(None::<io::Sink>)
    }

    /// Whether a worker can read replies here.
    pub(crate) const REPLIES: bool = false;

    /// The frames of the worker as they arrive. They end when the deadline passes or when
    /// `has_ended` says that the worker has ended.
    pub(crate) fn frames(self, has_ended: &Arc<AtomicBool>) -> (FrameReader, Deadline) {
        let deadline = Deadline::default();
        let input = Box::new(GrowingFile {
            file: std::fs::File::open(&self.records),
            deadline: deadline.clone(),
            has_ended: has_ended.clone(),
        });
        (FrameReader::new(input, self.key), deadline)
    }
}

/// A file that a worker appends to.
#[cfg(not(unix))]
struct GrowingFile {
    file: io::Result<std::fs::File>,
    deadline: Deadline,
    has_ended: Arc<AtomicBool>,
}

#[cfg(not(unix))]
impl Read for GrowingFile {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let file = self.file.as_mut().map_err(|e| io::Error::from(e.kind()))?;
        loop {
            let ended = self.has_ended.load(std::sync::atomic::Ordering::Acquire);
            let count = file.read(buffer)?;
            if count > 0 || ended {
                return Ok(count);
            }
            self.deadline.look(|_| {
                std::thread::sleep(Duration::from_millis(1));
                Ok(())
            })?;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pause_counts_as_one_look() {
        let deadline = Deadline::default();
        assert!(deadline.has_passed());
        deadline.set(3 * LOOK);
        let stopped = deadline.look(|wait| {
            assert_eq!(wait, LOOK);
            std::thread::sleep(LOOK + LOOK / 10);
            Ok(())
        });
        stopped.expect("there is time left");
        assert_eq!(deadline.0.get(), 2 * LOOK);
        deadline.set(Duration::ZERO);
        assert!(deadline.look(|_| Ok(())).is_err());
    }
}
