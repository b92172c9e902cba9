//! Reads pictures: also what `image` leaves to its callers in `.hdr` and `.exr` files.

use crate::exr_file;
use image::codecs::hdr::{HdrDecoder, SIGNATURE};
use image::{DynamicImage, ImageError, ImageFormat, ImageReader, ImageResult};
use std::io::{self, Cursor, Read};
use std::path::Path;

/// A picture file's content.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width and height.
    pub size: [u32; 2],
    /// The pixels row by row from the top left.
    pub pixels: Pixels,
    /// What is to be said about the file.
    pub note: Option<String>,
}

/// The colours of a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// sRGB bytes.
    Srgb(Vec<[u8; 3]>),
    /// Linear values, of `.exr` and `.hdr` files.
    Linear(Vec<[f32; 3]>),
}

/// The most pixels of a picture.
const MAX_PIXELS: u64 = 1 << 26;

/// The picture in these bytes of the file `path`, of at most 2^26 pixels.
///
/// The values of an `.hdr` file are divided by its `EXPOSURE` and `COLORCORR`, as its format says:
/// the results are radiances. Of an `.exr` file with several parts the first one with colours is
/// used, which the note says.
pub fn decode(bytes: &[u8], path: &Path) -> ImageResult<Picture> {
    let reader = open(bytes, path)?;
    let format = reader.format();
    if format == Some(ImageFormat::OpenExr) {
        return exr_file::decode(bytes);
    }
    if format == Some(ImageFormat::Hdr) {
        return decode_hdr(bytes);
    }
    let (w, h) = reader.into_dimensions()?;
    check_size(w, h)?;
    let picture = open(bytes, path)?.decode()?;
    Ok(Picture {
        size: [w, h],
        pixels: Pixels::Srgb(picture.into_rgb8().as_chunks().0.to_vec()),
        note: None,
    })
}

/// An error if a picture of `w` x `h` pixels is too large.
pub(crate) fn check_size(w: u32, h: u32) -> ImageResult<()> {
    if u64::from(w) * u64::from(h) > MAX_PIXELS {
        return Err(invalid(format!(
            "it has {w} x {h} pixels, more than {MAX_PIXELS}: make it smaller"
        )));
    }
    Ok(())
}

/// The error that a file cannot be used.
pub(crate) fn invalid(why: impl ToString) -> ImageError {
    ImageError::IoError(io::Error::new(io::ErrorKind::InvalidData, why.to_string()))
}

/// A reader of the format that the bytes begin with, else that of the extension: `.tga` files begin
/// with nothing of their own.
fn open<'b>(bytes: &'b [u8], path: &Path) -> ImageResult<ImageReader<Cursor<&'b [u8]>>> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format()?;
    if let (None, Ok(format)) = (reader.format(), ImageFormat::from_path(path)) {
        reader.set_format(format);
    }
    Ok(reader)
}

/// That colours are not those of a display.
pub(crate) const OTHER_PRIMARIES: &str =
    "its colours have other primaries than those of sRGB; they are used as if they were of sRGB";

/// Red, green, blue and white of sRGB, as points of the CIE diagram.
const SRGB: [[f32; 2]; 4] = [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06], [0.3127, 0.329]];

/// Whether primaries are others than those of sRGB: also Radiance's own white is near enough.
pub(crate) fn are_other_primaries(given: [[f32; 2]; 4]) -> bool {
    let pairs = given.iter().flatten().zip(SRGB.iter().flatten());
    pairs.into_iter().any(|(a, b)| (a - b).abs() > 0.03)
}

fn decode_hdr(bytes: &[u8]) -> ImageResult<Picture> {
    // After `#?` Radiance takes the name of any program, the decoder only its own, and then skips
    // the rest of the line.
    let decoder = match bytes.strip_prefix(b"#?") {
        Some(rest) => HdrDecoder::new(SIGNATURE.chain(rest)),
        None => HdrDecoder::new([].chain(bytes)),
    }?;
    let header = decoder.metadata();
    check_size(header.width, header.height)?;
    let exposure = header.exposure.unwrap_or(1.0);
    let (r, g, b) = header.color_correction.unwrap_or((1.0, 1.0, 1.0));
    let given = header.custom_attributes.iter();
    let is_other = given
        .filter(|(key, _)| key == "PRIMARIES")
        .any(|(_, value)| {
            let numbers: Vec<f32> = value.split_whitespace().flat_map(str::parse).collect();
            let points = numbers.as_chunks().0;
            points.try_into().is_ok_and(are_other_primaries)
        });
    let picture = DynamicImage::from_decoder(decoder)?.into_rgb32f();
    let mut pixels = picture.as_chunks().0.to_vec();
    if [exposure, r, g, b] != [1.0; 4] {
        for pixel in &mut pixels {
            for (channel, correction) in pixel.iter_mut().zip([r, g, b]) {
                *channel /= exposure * correction;
            }
        }
    }
    Ok(Picture {
        size: [header.width, header.height],
        pixels: Pixels::Linear(pixels),
        note: is_other.then(|| OTHER_PRIMARIES.to_owned()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One pixel of the radiance 1, 0.5, 0.
    fn hdr(header: &str) -> Picture {
        let bytes = [header.as_bytes(), b"\n-Y 1 +X 1\n", &[128, 64, 0, 129]].concat();
        decode(&bytes, Path::new("a.hdr")).expect("a picture")
    }

    #[test]
    fn headers_of_hdr_files_are_read() {
        for header in [
            "#?RADIANCE\n",
            "#?RGBE\nFORMAT=32-bit_rle_rgbe\n",
            "#?pvalue 1.0\nPRIMARIES=0.64 0.33 0.29 0.6 0.15 0.06 0.333 0.333\n",
        ] {
            let picture = hdr(header);
            assert_eq!(picture.pixels, Pixels::Linear(vec![[1.0, 0.5, 0.0]]));
            assert_eq!((picture.size, picture.note), ([1, 1], None));
        }
        let wide = hdr("#?RADIANCE\nPRIMARIES=0.7347 0.2653 0 1 0 -0.08 0.3217 0.3377\n");
        assert_eq!(wide.note.as_deref(), Some(OTHER_PRIMARIES));
        let none = decode(b"RADIANCE\n\n-Y 1 +X 1\n", Path::new("a.hdr"));
        assert!(none.is_err(), "{none:?}");
    }
}
