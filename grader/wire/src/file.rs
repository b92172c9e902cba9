//! Files of cases and records.
//!
//! A file of cases is one postcard value. A file of records is a run of frames, each after its length
//! as four little-endian bytes: what a killed worker had finished can still be read.

use crate::{Case, Frame};
use std::io::{self, Write};
use std::path::Path;

/// Writes the cases for a worker.
pub fn write_cases(path: &Path, cases: &[Case]) -> io::Result<()> {
    std::fs::write(path, postcard::to_stdvec(cases).map_err(io::Error::other)?)
}

/// Reads the cases that a grader wrote.
pub fn read_cases(path: &Path) -> io::Result<Vec<Case>> {
    postcard::from_bytes(&std::fs::read(path)?).map_err(io::Error::other)
}

/// Appends one frame. It is in the operating system's hands when this returns.
pub fn write_frame(out: &mut dyn Write, frame: &Frame) -> io::Result<()> {
    let body = postcard::to_stdvec(frame).map_err(io::Error::other)?;
    let length = u32::try_from(body.len()).map_err(io::Error::other)?;
    let mut bytes = length.to_le_bytes().to_vec();
    bytes.extend(body);
    out.write_all(&bytes)?;
    out.flush()
}

/// All whole frames of a file; a frame cut short at the end is left out.
pub fn read_frames(path: &Path) -> io::Result<Vec<Frame>> {
    let bytes = std::fs::read(path)?;
    let mut rest = bytes.as_slice();
    let mut frames = Vec::new();
    while let Some((length, after)) = rest.split_first_chunk::<4>() {
        let length = u32::from_le_bytes(*length) as usize;
        let Some((body, after)) = after.split_at_checked(length) else {
            break;
        };
        frames.push(postcard::from_bytes(body).map_err(io::Error::other)?);
        rest = after;
    }
    Ok(frames)
}
