//! Pictures of the worker's answers, for cases with one call per pixel.

use image::{Rgb, RgbImage};
use std::io::Cursor;
use std::path::Path;
use wire::answer::Hit;
use wire::{Answer, Work};

use grader::error::GraderError;
use grader::report::write_whole;

/// The colour of a pixel whose value is NaN: magenta.
const NAN_COLOUR: Rgb<u8> = Rgb([255, 0, 255]);

/// Converts `answer` to a picture of `width` by `height` pixels, in the colours of
/// [`judge::picture`]. The answers are in rows from the bottom left. Returns `None` if the number
/// of answers is not the number of pixels, or if this kind of answer has no colour.
pub fn compose([width, height]: [u32; 2], work: &Work, answer: &Answer) -> Option<RgbImage> {
    let colours = judge::picture::colours(work, answer)?;
    if colours.len() != width as usize * height as usize {
        return None;
    }
    let mut picture = RgbImage::new(width, height);
    for (i, colour) in (0_u32..).zip(colours) {
        picture.put_pixel(i % width, height - 1 - i / width, tone(colour));
    }
    Some(picture)
}

/// Returns the colour of a hit: its normal, each component mapped from -1..1 to 0..1; black for a
/// miss.
pub fn normal_colour(hit: Option<&Hit>) -> Rgb<u8> {
    tone(judge::picture::hit(hit))
}

/// Applies the tone curve of the assignment's program: `255 · min(1, (c·√2)^(1/2.2))`.
fn tone(colour: [f64; 3]) -> Rgb<u8> {
    if colour.iter().any(|c| c.is_nan()) {
        return NAN_COLOUR;
    }
    Rgb(colour.map(|c| {
        (255.0
            * (c.max(0.0) * std::f64::consts::SQRT_2)
                .powf(1.0 / 2.2)
                .min(1.0)) as u8
    }))
}

/// Encodes the picture as a PNG.
pub fn encode_png(picture: &RgbImage) -> Result<Vec<u8>, GraderError> {
    let mut bytes = Cursor::new(Vec::new());
    let encoded = picture.write_to(&mut bytes, image::ImageFormat::Png);
    encoded.map_err(|e| GraderError::new(format!("cannot encode a picture: {e}")))?;
    Ok(bytes.into_inner())
}

/// Writes the picture as a PNG file. The file is written completely or not at all.
pub fn write_png(path: &Path, picture: &RgbImage) -> Result<(), GraderError> {
    write_whole(path, &encode_png(picture)?)
}

/// Reads a PNG file.
pub fn read_png(path: &Path) -> Result<RgbImage, GraderError> {
    Ok(image::open(path)
        .map_err(|e| GraderError::file("read", path, e))?
        .to_rgb8())
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
        assert_eq!(*picture.get_pixel(0, 1), Rgb([255; 3]));
        assert_eq!(*picture.get_pixel(0, 0), Rgb([0; 3]));
    }

    #[test]
    fn a_nan_normal_is_magenta() {
        assert_eq!(tone([f64::NAN, 0.0, 0.0]), NAN_COLOUR);
    }
}
