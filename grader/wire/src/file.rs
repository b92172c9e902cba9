//! What grader and worker send each other.
//!
//! The grader sends a [`Key`] and the cases, as one postcard value after its length. The worker answers with a
//! sequence of frames, each after a header: its length as four little-endian bytes, the key, and the
//! number of the frame as eight little-endian bytes. If a worker is killed, the frames before can
//! still be read.
//!
//! The student's code runs in the worker. Without `unsafe` it cannot read the worker's memory, so
//! it does not know the key: what it writes into the channel is no frame. Nevertheless
//! [`FrameReader`] expects anything.

use crate::{Case, RecordFrame, Work};
use std::hash::{BuildHasher, Hasher, RandomState};
use std::io::{self, Read, Write};

/// The largest frame that is read. The largest record of the course's cases has 3.4 MB, those of
/// `grader-cost`, which sends 60,000 rays at once, 13 MB. A decoded frame takes up to 150 times the
/// memory of its bytes (a miss in a list of hits is one byte), which is no more than a worker may
/// allocate.
pub const MAX_FRAME_BYTES: u32 = 24 << 20;

/// The most bytes of all records of one worker: they are in memory at once. Those of honest code have a
/// tenth of it.
const MAX_STREAM_BYTES: u64 = 512 << 20;

/// The length of a header: length, key and number of the frame.
const HEADER_BYTES: usize = 4 + KEY_BYTES + 8;

const KEY_BYTES: usize = 16;

/// Random bytes that only the grader and the worker's own code know.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Key([u8; KEY_BYTES]);

impl Key {
    /// A new key, from the randomness of the operating system.
    pub fn random() -> Key {
        // The keys of a `RandomState` are the system's, and its hash cannot be guessed without them.
        let half = || RandomState::new().build_hasher().finish().to_le_bytes();
        let mut key = [0; KEY_BYTES];
        key[..8].copy_from_slice(&half());
        key[8..].copy_from_slice(&half());
        Key(key)
    }
}

/// Without the bytes, which belong in no output.
impl std::fmt::Debug for Key {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Key")
    }
}

/// Writes the key and the cases for a worker.
pub fn write_cases(out: &mut dyn Write, key: Key, cases: &[Case]) -> io::Result<()> {
    out.write_all(&key.0)?;
    let cases = postcard::to_stdvec(cases).map_err(io::Error::other)?;
    out.write_all(&(cases.len() as u64).to_le_bytes())?;
    out.write_all(&cases)?;
    out.flush()
}

/// Reads what [`write_cases`] wrote.
pub fn read_cases(input: &mut dyn Read) -> io::Result<(Key, Vec<Case>)> {
    let mut key = [0; KEY_BYTES];
    input.read_exact(&mut key)?;
    let mut length = [0; 8];
    input.read_exact(&mut length)?;
    let length = u64::from_le_bytes(length);
    let mut cases = Vec::new();
    input.take(length).read_to_end(&mut cases)?;
    if cases.len() as u64 != length {
        return Err(io::ErrorKind::UnexpectedEof.into());
    }
    let cases = postcard::from_bytes(&cases).map_err(io::Error::other)?;
    Ok((Key(key), cases))
}

/// The bytes of a question, as a file keeps them.
pub fn work_to_bytes(work: &Work) -> Vec<u8> {
    postcard::to_stdvec(work).expect("a question is plain numbers and texts")
}

/// Reads what [`work_to_bytes`] wrote.
pub fn work_from_bytes(bytes: &[u8]) -> io::Result<Work> {
    postcard::from_bytes(bytes).map_err(io::Error::other)
}

/// Writes the frames of one worker.
pub struct FrameWriter {
    out: Box<dyn Write + Send>,
    key: Key,
    number: u64,
}

impl FrameWriter {
    /// A writer whose first frame has number 0.
    pub fn new(out: Box<dyn Write + Send>, key: Key) -> FrameWriter {
        FrameWriter {
            out,
            key,
            number: 0,
        }
    }

    /// Appends one frame and flushes it to the operating system.
    pub fn write(&mut self, frame: &RecordFrame) -> io::Result<()> {
        let bytes = with_header(&body_of(frame)?, self.key, self.number)?;
        self.number += 1;
        self.out.write_all(&bytes)?;
        self.out.flush()
    }
}

/// A frame without its header.
pub fn body_of(frame: &RecordFrame) -> io::Result<Vec<u8>> {
    postcard::to_stdvec(frame).map_err(io::Error::other)
}

/// Frame number `number`: its header and `body`.
pub fn with_header(body: &[u8], key: Key, number: u64) -> io::Result<Vec<u8>> {
    let length = u32::try_from(body.len()).map_err(io::Error::other)?;
    let mut bytes = header(length, key, number).to_vec();
    bytes.extend(body);
    Ok(bytes)
}

fn header(length: u32, key: Key, number: u64) -> [u8; HEADER_BYTES] {
    let mut header = [0; HEADER_BYTES];
    header[..4].copy_from_slice(&length.to_le_bytes());
    header[4..4 + KEY_BYTES].copy_from_slice(&key.0);
    header[4 + KEY_BYTES..].copy_from_slice(&number.to_le_bytes());
    header
}

/// An iterator over the frames of a worker. It ends after the first invalid frame, with an error
/// that describes it. An incomplete frame at the end, left by a killed worker, is skipped.
pub struct FrameReader {
    input: Box<dyn Read>,
    key: Key,
    number: u64,
    /// How many bytes of frames may still be read.
    left: u64,
    ended: bool,
}

impl FrameReader {
    /// Reads the frames with this key from `input`.
    pub fn new(input: Box<dyn Read>, key: Key) -> FrameReader {
        FrameReader {
            input,
            key,
            number: 0,
            left: MAX_STREAM_BYTES,
            ended: false,
        }
    }

    /// Reads the next frame; `None` where the input ends. It reads at most [`MAX_FRAME_BYTES`] and
    /// allocates no memory for bytes that are not there.
    fn read(&mut self) -> Result<Option<RecordFrame>, String> {
        let Some(found) = self.bytes(HEADER_BYTES as u32)? else {
            return Ok(None);
        };
        let length = found[..4]
            .iter()
            .rev()
            .fold(0, |n, &b| n << 8 | u32::from(b));
        if found != header(length, self.key, self.number) {
            return Err("something else than the worker wrote into its channel".to_string());
        }
        self.number += 1;
        if length > MAX_FRAME_BYTES {
            return Err(format!(
                "a record has {length} bytes, expected at most {MAX_FRAME_BYTES}"
            ));
        }
        self.left = self.left.checked_sub(length.into()).ok_or_else(|| {
            format!("the records of all cases have more than {MAX_STREAM_BYTES} bytes together")
        })?;
        let Some(body) = self.bytes(length)? else {
            return Ok(None);
        };
        match postcard::take_from_bytes(&body) {
            Ok((frame, [])) => Ok(Some(frame)),
            Ok((_, rest)) => Err(format!("{} bytes are left over", rest.len())),
            Err(e) => Err(format!("it does not decode ({e})")),
        }
    }

    /// Reads the next `count` bytes; `None` if the input has fewer.
    fn bytes(&mut self, count: u32) -> Result<Option<Vec<u8>>, String> {
        let mut bytes = Vec::new();
        let mut some = self.input.as_mut().take(count.into());
        some.read_to_end(&mut bytes).map_err(|e| e.to_string())?;
        Ok((bytes.len() == count as usize).then_some(bytes))
    }
}

impl Iterator for FrameReader {
    type Item = Result<RecordFrame, String>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let read = self.read().transpose();
        self.ended = !matches!(read, Some(Ok(_)));
        read
    }
}
