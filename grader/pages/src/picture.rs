//! Pictures of the worker's answers, for cases with one call per pixel.

pub use pictures::tone::of_answer as compose;

use base::{GraderError, write_whole};
use pictures::cause::Cause;
use pictures::{Image, png, sheet};
use std::path::Path;

/// Writes the picture as a PNG file. The file is written completely or not at all.
pub fn write_png(path: &Path, picture: &Image) -> Result<(), GraderError> {
    write_whole(path, &png::encode_smallest(picture))
}

/// The causes that the legend of a task's picture names, expected and yours beside their
/// difference; empty for bytes that are no PNG file.
pub fn causes(file: &[u8]) -> Vec<Cause> {
    png::decode(file).map_or_else(|_| Vec::new(), |picture| sheet::causes(&picture))
}

/// Reads a PNG file.
pub fn read_png(path: &Path) -> Result<Image, GraderError> {
    png::read(path).map_err(|e| GraderError::file("read", path, e))
}
