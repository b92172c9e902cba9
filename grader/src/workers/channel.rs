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

/// When a worker that sends nothing counts as stalled.
#[derive(Clone, Debug)]
pub(crate) struct Deadline(Rc<Cell<Instant>>);

impl Deadline {
    /// The next frame may take this long from now on.
    pub(crate) fn set(&self, wait: Duration) {
        self.0.set(Instant::now() + wait);
    }

    /// Whether it has passed.
    pub(crate) fn has_passed(&self) -> bool {
        self.left().is_none()
    }

    fn left(&self) -> Option<Duration> {
        let left = self.0.get().checked_duration_since(Instant::now());
        left.filter(|left| !left.is_zero())
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
        let deadline = Deadline(Rc::new(Cell::new(Instant::now())));
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
        let left = self.deadline.left().ok_or(io::ErrorKind::TimedOut)?;
        self.socket.set_read_timeout(Some(left))?;
        match self.socket.read(buffer) {
            // A worker that ends before it has read all cases sends nothing more: its status says
            // why.
            Err(e) if e.kind() == io::ErrorKind::ConnectionReset => Ok(0),
            read => read,
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
        let deadline = Deadline(Rc::new(Cell::new(Instant::now())));
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
            self.deadline.left().ok_or(io::ErrorKind::TimedOut)?;
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}
