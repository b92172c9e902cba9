//! Reads and writes files of cases and records.
//!
//! A file of cases is one postcard value. A file of records is a sequence of frames, each after its
//! length as four little-endian bytes: if a worker is killed, the frames before can still be read.
//! The student's code runs in the worker and can write to that file, so [`FrameReader`] expects
//! anything in it.

use crate::{Case, RecordFrame};
use std::fs::File;
use std::io::{self, BufReader, Read, Write};
use std::path::Path;

/// The largest frame that is read. The largest record of the course's cases has 3.4 MB, those of
/// `grader-cost`, which sends 60,000 rays at once, 13 MB. A decoded frame takes up to 150 times the
/// memory of its bytes (a miss in a list of hits is one byte), which is no more than a worker may
/// allocate.
pub const MAX_FRAME_BYTES: u32 = 24 << 20;

/// Writes the cases for a worker.
pub fn write_cases(path: &Path, cases: &[Case]) -> io::Result<()> {
    std::fs::write(path, postcard::to_stdvec(cases).map_err(io::Error::other)?)
}

/// Reads the cases that a grader wrote.
pub fn read_cases(path: &Path) -> io::Result<Vec<Case>> {
    postcard::from_bytes(&std::fs::read(path)?).map_err(io::Error::other)
}

/// Appends one frame and flushes it to the operating system.
pub fn write_frame(out: &mut dyn Write, frame: &RecordFrame) -> io::Result<()> {
    let body = postcard::to_stdvec(frame).map_err(io::Error::other)?;
    let length = u32::try_from(body.len()).map_err(io::Error::other)?;
    let mut bytes = length.to_le_bytes().to_vec();
    bytes.extend(body);
    out.write_all(&bytes)?;
    out.flush()
}

/// An iterator over the frames of a file. It ends after the first invalid frame, with an error that
/// describes it. An incomplete frame at the end of the file, left by a killed worker, is skipped.
pub struct FrameReader {
    input: Box<dyn Read>,
    ended: bool,
}

impl FrameReader {
    /// Opens a file of frames. Anything but a regular file, such as a pipe, is an error.
    pub fn open(path: &Path) -> io::Result<FrameReader> {
        if !std::fs::symlink_metadata(path)?.is_file() {
            return Err(io::Error::other("it is not a regular file"));
        }
        Ok(FrameReader::new(Box::new(BufReader::new(File::open(
            path,
        )?))))
    }

    /// Reads frames from `input`.
    pub fn new(input: Box<dyn Read>) -> FrameReader {
        FrameReader {
            input,
            ended: false,
        }
    }

    /// Reads the next frame; `None` where the input ends. It reads at most [`MAX_FRAME_BYTES`] and
    /// allocates no memory for bytes that are not there.
    fn read(&mut self) -> Result<Option<RecordFrame>, String> {
        let Some(length) = self.bytes(4)? else {
            return Ok(None);
        };
        let length = length.iter().rev().fold(0, |n, &b| n << 8 | u32::from(b));
        if length > MAX_FRAME_BYTES {
            return Err(format!(
                "a record has {length} bytes, expected at most {MAX_FRAME_BYTES}"
            ));
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(bytes: &[u8]) -> Vec<Result<RecordFrame, String>> {
        FrameReader::new(Box::new(io::Cursor::new(bytes.to_vec()))).collect()
    }

    fn written() -> Vec<u8> {
        let mut bytes = Vec::new();
        for case in [0, 1] {
            write_frame(&mut bytes, &RecordFrame::Started { case })
                .expect("writing to memory succeeds");
        }
        bytes
    }

    #[test]
    fn written_frames_are_read_back() {
        let started = |case| Ok(RecordFrame::Started { case });
        assert_eq!(frames(&written()), [started(0), started(1)]);
    }

    #[test]
    fn an_incomplete_frame_is_skipped() {
        let bytes = written();
        for left in bytes.len() / 2..bytes.len() {
            assert_eq!(
                frames(&bytes[..left]),
                [Ok(RecordFrame::Started { case: 0 })]
            );
        }
    }

    #[test]
    fn reading_ends_at_an_invalid_frame() {
        for invalid in [
            &[2, 0, 0, 0, 77, 0][..],
            // A byte too many.
            &[3, 0, 0, 0, 0, 1, 0],
            // 4 GB.
            &[255, 255, 255, 255, 0],
        ] {
            let bytes = [&written()[..], invalid, &written()].concat();
            let frames = frames(&bytes);
            assert_eq!(frames.len(), 3, "{frames:?}");
            assert!(frames[2].is_err(), "{frames:?}");
        }
    }
}
