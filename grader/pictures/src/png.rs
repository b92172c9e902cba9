//! PNG files of 8 bits per channel.

use crate::Image;
use crate::image::Rgb;
use png::Compression;
use std::collections::BTreeSet;
use std::io::{BufReader, Cursor};
use std::path::Path;

/// The largest width and height of a file that is read. Those of the course are far smaller.
const MAX_SIDE: u32 = 4096;

/// The largest palette of a PNG file.
const PALETTE: usize = 256;

/// Encodes the picture, with a palette if it has few colours. The same picture always gives the
/// same bytes.
pub fn encode(picture: &Image) -> Vec<u8> {
    with_palette(picture, Compression::Fast)
        .unwrap_or_else(|| with_filter(picture, None, FILTERS[0], Compression::Fast))
}

/// As [`encode`], in many times the time: for files that are stored. Which filter is best depends
/// on the picture, and saves up to a fifth.
pub fn encode_smallest(picture: &Image) -> Vec<u8> {
    with_palette(picture, Compression::High).unwrap_or_else(|| {
        let all = FILTERS.map(|filter| with_filter(picture, None, filter, Compression::High));
        let smallest = all.into_iter().min_by_key(Vec::len);
        smallest.expect("there are filters")
    })
}

/// The file with a palette; `None` if the picture has too many colours.
fn with_palette(picture: &Image, compression: Compression) -> Option<Vec<u8>> {
    let colours: BTreeSet<Rgb> = picture.pixels().iter().copied().collect();
    let colours: Vec<Rgb> = colours.into_iter().collect();
    // The filters of rows predict brightness from neighbours; indices have none.
    let file = || with_filter(picture, Some(&colours), png::Filter::NoFilter, compression);
    (colours.len() <= PALETTE).then(file)
}

/// The filters of rows. The first of equally good ones is taken.
const FILTERS: [png::Filter; 6] = [
    png::Filter::Adaptive,
    png::Filter::NoFilter,
    png::Filter::Sub,
    png::Filter::Up,
    png::Filter::Avg,
    png::Filter::Paeth,
];

/// Encodes the picture with one filter, as indices into `palette` if there is one.
fn with_filter(
    picture: &Image,
    palette: Option<&[Rgb]>,
    filter: png::Filter,
    compression: Compression,
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let [w, h] = picture.size();
    let mut encoder = png::Encoder::new(&mut bytes, w, h);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(compression);
    encoder.set_filter(filter);
    let data = match palette {
        Some(colours) => {
            encoder.set_color(png::ColorType::Indexed);
            encoder.set_palette(colours.as_flattened().to_vec());
            let index = |colour: &Rgb| colours.partition_point(|other| other < colour) as u8;
            picture.pixels().iter().map(index).collect()
        }
        None => {
            encoder.set_color(png::ColorType::Rgb);
            picture.bytes().to_vec()
        }
    };
    let written = encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(&data));
    written.expect("memory takes all bytes, and no picture has more than a PNG file can");
    bytes
}

/// Reads a PNG file of colours. The error says what is wrong with the file.
pub fn read(path: &Path) -> Result<Image, String> {
    let file = std::fs::read(path).map_err(|e| e.to_string())?;
    decode(&file)
}

/// Decodes a PNG file of colours, with or without a palette.
pub fn decode(file: &[u8]) -> Result<Image, String> {
    let mut decoder = png::Decoder::new(BufReader::new(Cursor::new(file)));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let size = [reader.info().width, reader.info().height];
    if size.iter().any(|side| *side > MAX_SIDE) {
        let [w, h] = size;
        return Err(format!(
            "it has {w} x {h} pixels, expected at most {MAX_SIDE} x {MAX_SIDE}"
        ));
    }
    let (colours, _) = reader.output_color_type();
    if colours != png::ColorType::Rgb {
        return Err(format!("its pixels are {colours:?}, expected Rgb"));
    }
    let length = reader.output_buffer_size().ok_or("it is too large")?;
    let mut bytes = vec![0; length];
    let frame = reader.next_frame(&mut bytes).map_err(|e| e.to_string())?;
    Image::from_bytes(size, &bytes[..frame.buffer_size()])
        .ok_or_else(|| "it has not as many pixels as its header says".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_survives_its_file() {
        let picture = Image::from_fn([7, 5], |x, y| [x as u8 * 30, y as u8 * 50, 255]);
        assert_eq!(decode(&encode(&picture)), Ok(picture));
        let colourful = Image::from_fn([40, 30], |x, y| [x as u8 * 6, y as u8 * 8, 255]);
        assert!(colourful.pixels().len() > PALETTE);
        let smallest = encode_smallest(&colourful);
        assert!(smallest.len() <= encode(&colourful).len());
        assert_eq!(decode(&smallest).as_ref(), Ok(&colourful));
        assert_eq!(decode(&encode(&colourful)), Ok(colourful));
    }

    #[test]
    fn a_broken_file_is_an_error() {
        let mut file = encode(&Image::filled([40, 40], [1, 2, 3]));
        file.truncate(50);
        assert!(decode(&file).is_err());
        assert!(decode(b"no png").is_err());
    }
}
