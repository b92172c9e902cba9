//! Reads pictures: also what `image` leaves to its callers in `.hdr` and `.exr` files.

use exr::meta::MetaData;
use image::codecs::hdr::HdrDecoder;
use image::{DynamicImage, ImageFormat, ImageReader, ImageResult};
use std::io::Cursor;
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

/// The picture in these bytes of the file `path`.
///
/// The values of an `.hdr` file are divided by its `EXPOSURE` and `COLORCORR`, as its format says:
/// the results are radiances. Of an `.exr` file with several parts the first one with colours is
/// used, which the note says.
pub fn decode(bytes: &[u8], path: &Path) -> ImageResult<Picture> {
    let reader = open(bytes, path)?;
    let (picture, note) = match reader.format() {
        Some(ImageFormat::Hdr) => (decode_hdr(bytes)?, None),
        Some(ImageFormat::OpenExr) => (reader.decode()?, several_parts(bytes)),
        _ => (reader.decode()?, None),
    };
    let size = [picture.width(), picture.height()];
    let pixels = match picture {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            Pixels::Linear(picture.into_rgb32f().pixels().map(|p| p.0).collect())
        }
        _ => Pixels::Srgb(picture.into_rgb8().pixels().map(|p| p.0).collect()),
    };
    Ok(Picture { size, pixels, note })
}

/// Width and height of that picture, without decoding it.
pub fn dimensions(bytes: &[u8], path: &Path) -> ImageResult<(u32, u32)> {
    open(bytes, path)?.into_dimensions()
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

fn decode_hdr(bytes: &[u8]) -> ImageResult<DynamicImage> {
    let decoder = HdrDecoder::new(Cursor::new(bytes))?;
    let header = decoder.metadata();
    let exposure = header.exposure.unwrap_or(1.0);
    let (r, g, b) = header.color_correction.unwrap_or((1.0, 1.0, 1.0));
    let mut picture = DynamicImage::from_decoder(decoder)?.into_rgb32f();
    if [exposure, r, g, b] != [1.0; 4] {
        for pixel in picture.pixels_mut() {
            for (channel, correction) in pixel.0.iter_mut().zip([r, g, b]) {
                *channel /= exposure * correction;
            }
        }
    }
    Ok(DynamicImage::ImageRgb32F(picture))
}

/// If an `.exr` file has several parts: which one is used.
fn several_parts(bytes: &[u8]) -> Option<String> {
    let headers = MetaData::read_from_buffered(bytes, false).ok()?.headers;
    if headers.len() < 2 {
        return None;
    }
    let has_colors = |header: &exr::meta::header::Header| {
        let names = header.channels.list.iter().map(|channel| &channel.name);
        ["R", "G", "B"]
            .iter()
            .all(|color| names.clone().any(|name| name.eq(color)))
    };
    let used = headers.iter().position(has_colors)?;
    let layer = headers[used].own_attributes.layer_name.as_ref();
    let name = layer.map_or(String::new(), |layer| format!(", `{layer}`"));
    Some(format!(
        "the file has {} parts; using the first one with R, G and B: number {}{name}",
        headers.len(),
        used + 1
    ))
}
