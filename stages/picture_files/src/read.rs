//! Reads pictures: also what `image` leaves to its callers in `.hdr` and `.exr` files.

use crate::exr_file;
use image::codecs::hdr::HdrDecoder;
use image::{DynamicImage, ImageError, ImageFormat, ImageReader, ImageResult};
use std::io::{self, Cursor};
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
    let (w, h) = reader.into_dimensions()?;
    check_size(w, h)?;
    let pixels = match format {
        Some(ImageFormat::Hdr) => Pixels::Linear(decode_hdr(bytes)?),
        _ => {
            let picture = open(bytes, path)?.decode()?;
            Pixels::Srgb(picture.into_rgb8().as_chunks().0.to_vec())
        }
    };
    let size = [w, h];
    let note = None;
    Ok(Picture { size, pixels, note })
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

fn decode_hdr(bytes: &[u8]) -> ImageResult<Vec<[f32; 3]>> {
    let decoder = HdrDecoder::new(Cursor::new(bytes))?;
    let header = decoder.metadata();
    let exposure = header.exposure.unwrap_or(1.0);
    let (r, g, b) = header.color_correction.unwrap_or((1.0, 1.0, 1.0));
    let picture = DynamicImage::from_decoder(decoder)?.into_rgb32f();
    let mut pixels = picture.as_chunks().0.to_vec();
    if [exposure, r, g, b] != [1.0; 4] {
        for pixel in &mut pixels {
            for (channel, correction) in pixel.iter_mut().zip([r, g, b]) {
                *channel /= exposure * correction;
            }
        }
    }
    Ok(pixels)
}
