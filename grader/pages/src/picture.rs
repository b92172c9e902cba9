//! Pictures of the worker's answers, for cases with one call per pixel.

use image::{Rgb, RgbImage};
use std::io::Cursor;
use std::path::Path;
use wire::Answer;
use wire::answer::Hit;

use grader::error::GraderError;
use grader::report::write_whole;

/// The colour of a pixel whose value is NaN: magenta.
const NAN_COLOUR: Rgb<u8> = Rgb([255, 0, 255]);

/// Converts `answer` to a picture of `width` by `height` pixels. The answers are in rows from the
/// bottom left.
///
/// Hits show their normal, camera rays their direction, boxes the distance at which the ray enters
/// them (near is bright). A miss is black. Returns `None` if the number of answers is not the
/// number of pixels, or if this kind of answer has no colour.
pub fn compose([width, height]: [u32; 2], answer: &Answer) -> Option<RgbImage> {
    let colours: Vec<Rgb<u8>> = match answer {
        Answer::Hits(answer) => answer
            .hits
            .iter()
            .map(|hit| normal_colour(hit.as_ref()))
            .collect(),
        Answer::Triangles(answers) => answers
            .iter()
            .map(|answer| normal_colour(answer.hit.as_ref()))
            .collect(),
        Answer::Spheres(answers) => answers
            .iter()
            .map(|answer| normal_colour(answer.hit.as_ref()))
            .collect(),
        Answer::CameraRays(rays) => rays.iter().map(|ray| direction_colour(ray.d)).collect(),
        Answer::Pixels(pixels) => pixels.iter().map(|pixel| tone(pixel.radiance)).collect(),
        Answer::Boxes(boxes) => boxes
            .iter()
            .map(|inside| distance_colour(inside.map(|[enters, _]| enters)))
            .collect(),
        _ => return None,
    };
    if colours.len() != width as usize * height as usize {
        return None;
    }
    let mut picture = RgbImage::new(width, height);
    for (i, colour) in (0_u32..).zip(colours) {
        picture.put_pixel(i % width, height - 1 - i / width, colour);
    }
    Some(picture)
}

/// Returns the colour of a hit: its normal, each component mapped from -1..1 to 0..1; black for a
/// miss.
pub fn normal_colour(hit: Option<&Hit>) -> Rgb<u8> {
    hit.map_or(Rgb([0; 3]), |hit| direction_colour(hit.n))
}

fn direction_colour(d: [f64; 3]) -> Rgb<u8> {
    tone(d.map(|component| component / 2.0 + 0.5))
}

fn distance_colour(t: Option<f64>) -> Rgb<u8> {
    t.map_or(Rgb([0; 3]), |t| {
        tone([0.2, 0.5, 1.0].map(|tint| (-tint * t / 4.0).exp()))
    })
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

    #[test]
    fn answers_start_at_the_bottom_left_pixel() {
        let boxes = Answer::Boxes(vec![Some([0.0, 1.0]), None, None, None, None, None]);
        let picture = compose([3, 2], &boxes).unwrap();
        assert_eq!(*picture.get_pixel(0, 1), Rgb([255; 3]));
        assert_eq!(*picture.get_pixel(0, 0), Rgb([0; 3]));
    }

    #[test]
    fn a_nan_normal_is_magenta() {
        assert_eq!(direction_colour([f64::NAN, 0.0, 0.0]), NAN_COLOUR);
    }
}
