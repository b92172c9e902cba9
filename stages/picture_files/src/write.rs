//! Writes pictures: equal pictures are equal files.

use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, FlatSamples, Image};
use image::codecs::hdr::HdrEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError, Rgb};
use std::fs::File;
use std::io::{self, BufWriter, Write};

/// A channel of an `.exr` file.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Its name: `layer.channel`, as other programs expect; `R`, `G`, `B` for the picture itself.
    pub name: &'static str,
    /// Its values, row by row from the top left.
    pub values: Values,
}

/// The values of a channel.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Floating-point values.
    Float(Vec<f32>),
    /// Numbers of primitives.
    Id(Vec<u32>),
}

/// Writes `w` x `h` pixels of three sRGB bytes each, row by row from the top left.
pub fn write_png(file: &File, rgb: &[u8], [w, h]: [u32; 2]) -> Result<(), ImageError> {
    let mut file = BufWriter::new(file);
    PngEncoder::new(&mut file).write_image(rgb, w, h, ExtendedColorType::Rgb8)?;
    Ok(file.flush()?)
}

/// Writes `w` x `h` radiances, row by row from the top left.
pub fn write_hdr(file: &File, radiance: &[[f32; 3]], [w, h]: [u32; 2]) -> Result<(), ImageError> {
    let mut file = BufWriter::new(file);
    let pixels: Vec<Rgb<f32>> = radiance.iter().copied().map(Rgb).collect();
    HdrEncoder::new(&mut file).encode(&pixels, w as usize, h as usize)?;
    Ok(file.flush()?)
}

/// Writes channels of `w` x `h` values. The blocks are encoded in order, on one thread.
pub fn write_exr(file: &File, channels: Vec<Channel>, [w, h]: [u32; 2]) -> io::Result<()> {
    let channels = channels.into_iter().map(|channel| {
        let samples = match channel.values {
            Values::Float(values) => FlatSamples::F32(values),
            Values::Id(values) => FlatSamples::U32(values),
        };
        AnyChannel::new(channel.name, samples)
    });
    Image::from_channels(
        (w as usize, h as usize),
        AnyChannels::sort(channels.collect()),
    )
    .write()
    .non_parallel()
    // The encoder seeks back to write the offsets of the blocks.
    .to_buffered(file)
    .map_err(|why| io::Error::other(why.to_string()))
}
