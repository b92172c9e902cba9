//! Files of cases and records.
//!
//! A file of cases is one postcard value. A file of records is a run of frames, each after its
//! length as four little-endian bytes: what a killed worker had finished can still be read. The
//! student's code runs in the worker and can write to that file, so [`FrameReader`] expects
//! anything in it.

use crate::{Case, RecordFrame};
use std::fs::File;
use std::io::{self, BufReader, Read, Write};
use std::path::Path;

/// The largest frame that is read. The largest record of the course's cases has 3.4 MB, those of
/// `grader-cost`, which sends 60,000 rays at once, 13 MB. What is decoded takes up to 150 times the
/// memory of its bytes (a miss in a list of hits is one byte): no more than a worker itself may
/// take.
pub const MAX_FRAME_BYTES: u32 = 24 << 20;

/// Writes the cases for a worker.
pub fn write_cases(path: &Path, cases: &[Case]) -> io::Result<()> {
    std::fs::write(path, postcard::to_stdvec(cases).map_err(io::Error::other)?)
}

/// Reads the cases that a grader wrote.
pub fn read_cases(path: &Path) -> io::Result<Vec<Case>> {
    postcard::from_bytes(&std::fs::read(path)?).map_err(io::Error::other)
}

/// Appends one frame. It is in the operating system's hands when this returns.
pub fn write_frame(out: &mut dyn Write, frame: &RecordFrame) -> io::Result<()> {
    let body = postcard::to_stdvec(frame).map_err(io::Error::other)?;
    let length = u32::try_from(body.len()).map_err(io::Error::other)?;
    let mut bytes = length.to_le_bytes().to_vec();
    bytes.extend(body);
    out.write_all(&bytes)?;
    out.flush()
}

/// Reads frame after frame: each, or what is wrong about the one at which the reading ends. A frame
/// cut short at the end of the file is left out, as a worker leaves it that is killed.
pub struct FrameReader {
    input: Box<dyn Read>,
    ended: bool,
}

impl FrameReader {
    /// Reads the frames of a file; what is none, such as a pipe, is an error.
    pub fn open(path: &Path) -> io::Result<FrameReader> {
        if !std::fs::symlink_metadata(path)?.is_file() {
            return Err(io::Error::other("it is no file"));
        }
        Ok(FrameReader::new(Box::new(BufReader::new(File::open(
            path,
        )?))))
    }

    /// Reads the frames that come out of `input`.
    pub fn new(input: Box<dyn Read>) -> FrameReader {
        FrameReader {
            input,
            ended: false,
        }
    }

    /// The next frame, or none where the input ends. No more than [`MAX_FRAME_BYTES`] are read for
    /// it, and none before they are there.
    fn read(&mut self) -> Result<Option<RecordFrame>, String> {
        let Some(length) = self.bytes(4)? else {
            return Ok(None);
        };
        let length = length.iter().rev().fold(0, |n, &b| n << 8 | u32::from(b));
        if length > MAX_FRAME_BYTES {
            return Err(format!(
                "a record has {length} bytes, at most {MAX_FRAME_BYTES} are read"
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

    /// The next `count` bytes, if there are so many.
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
            write_frame(&mut bytes, &RecordFrame::Started { case }).expect("memory takes it");
        }
        bytes
    }

    #[test]
    fn what_was_written_comes_back() {
        let started = |case| Ok(RecordFrame::Started { case });
        assert_eq!(frames(&written()), [started(0), started(1)]);
    }

    #[test]
    fn a_frame_cut_short_is_left_out() {
        let bytes = written();
        for left in bytes.len() / 2..bytes.len() {
            assert_eq!(
                frames(&bytes[..left]),
                [Ok(RecordFrame::Started { case: 0 })]
            );
        }
    }

    #[test]
    fn the_reading_ends_at_a_frame_that_is_none() {
        for spoilt in [
            &[2, 0, 0, 0, 77, 0][..],
            // A byte too many.
            &[3, 0, 0, 0, 0, 1, 0],
            // 4 GB.
            &[255, 255, 255, 255, 0],
        ] {
            let bytes = [&written()[..], spoilt, &written()].concat();
            let frames = frames(&bytes);
            assert_eq!(frames.len(), 3, "{frames:?}");
            assert!(frames[2].is_err(), "{frames:?}");
        }
    }
}
