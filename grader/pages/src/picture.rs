//! Pictures of the worker's answers, for cases with one call per pixel.

pub use pictures::tone::of_answer as compose;

use base::{GraderError, write_whole};
use pictures::{Image, png};
use std::path::Path;

/// Writes the picture as a PNG file. The file is written completely or not at all.
pub fn write_png(path: &Path, picture: &Image) -> Result<(), GraderError> {
    write_whole(path, &png::encode_smallest(picture))
}

/// Reads a PNG file.
pub fn read_png(path: &Path) -> Result<Image, GraderError> {
    png::read(path).map_err(|e| GraderError::file("read", path, e))
}
