//! Pictures of the worker's answers, for cases with one call per pixel.

use grader::error::GraderError;
use grader::report::write_whole;
use pictures::tone::tone;
use pictures::{Image, png};
use std::path::Path;
use wire::{Answer, Work};

/// Converts `answer` to a picture of `width` by `height` pixels, in the colours of
/// [`judge::picture`]. The answers are in rows from the bottom left. Returns `None` if the number
/// of answers is not the number of pixels, or if this kind of answer has no colour.
pub fn compose([width, height]: [u32; 2], work: &Work, answer: &Answer) -> Option<Image> {
    let colours = judge::picture::colours(work, answer)?;
    if colours.len() != width as usize * height as usize {
        return None;
    }
    Some(Image::from_fn([width, height], |x, y| {
        tone(colours[((height - 1 - y) * width + x) as usize])
    }))
}

/// Writes the picture as a PNG file. The file is written completely or not at all.
pub fn write_png(path: &Path, picture: &Image) -> Result<(), GraderError> {
    write_whole(path, &png::encode_smallest(picture))
}

/// Reads a PNG file.
pub fn read_png(path: &Path) -> Result<Image, GraderError> {
    png::read(path).map_err(|e| GraderError::file("read", path, e))
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::work::BoxWork;

    #[test]
    fn answers_start_at_the_bottom_left_pixel() {
        let work = Work::Boxes(BoxWork {
            boxes: Vec::new(),
            probes: Vec::new(),
        });
        let boxes = Answer::Boxes(vec![Some([0.0, 1.0]), None, None, None, None, None]);
        let picture = compose([3, 2], &work, &boxes).unwrap();
        assert_eq!(picture.get(0, 1), [255; 3]);
        assert_eq!(picture.get(0, 0), [0; 3]);
    }
}
