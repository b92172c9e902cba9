//! Reads `.exr` files: the picture, or all layers.

use crate::read::{OTHER_PRIMARIES, Picture, Pixels, are_other_primaries, check_size, invalid};
use exr::block::reader::Reader;
use exr::image::{FlatImage, FlatSamples};
use exr::meta::attribute::{Chromaticities, EnvironmentMap};
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers, Vec2, read};
use image::ImageResult;
use std::fmt;
use std::io::Cursor;
use std::path::Path;

/// The channels of an `.exr` file whose names start alike.
#[derive(Clone, Debug, PartialEq)]
pub struct FileLayer {
    /// What stands before the last dot of the channels' names, after the name of the file's part if
    /// it has one; empty for the picture itself.
    pub name: String,
    /// Width and height.
    pub size: [u32; 2],
    /// What stands after the dot of each channel, and its values row by row from the top left.
    pub channels: Vec<(String, Vec<f32>)>,
}

/// Reads all layers of a file, in their order. The error is a sentence.
pub fn read_layers(path: &Path) -> Result<Vec<FileLayer>, String> {
    let failed = |why: &dyn fmt::Display| format!("{}: {why}", path.display());
    let bytes = std::fs::read(path).map_err(|why| failed(&why))?;
    let image = open(&bytes).and_then(parse).map_err(|why| failed(&why))?;
    let mut layers: Vec<FileLayer> = Vec::new();
    for part in image.layer_data {
        let size = [part.size.width() as u32, part.size.height() as u32];
        let part_name = part.attributes.layer_name.as_ref();
        let part_name = part_name.map(ToString::to_string).unwrap_or_default();
        for channel in part.channel_data.list {
            let whole = channel.name.to_string();
            let (prefix, short) = whole.rsplit_once('.').unwrap_or(("", &whole));
            let name = [part_name.as_str(), prefix]
                .into_iter()
                .filter(|name| !name.is_empty())
                .collect::<Vec<_>>()
                .join(".");
            let values = (short.to_owned(), numbers(channel.sample_data));
            let mut known = layers.iter_mut();
            match known.find(|layer| layer.name == name && layer.size == size) {
                Some(layer) => layer.channels.push(values),
                None => layers.push(FileLayer {
                    name,
                    size,
                    channels: vec![values],
                }),
            }
        }
    }
    Ok(layers)
}

/// The first part with colours, and which one that is if there are several. What is outside of its
/// data window is black.
pub(crate) fn decode(bytes: &[u8]) -> ImageResult<Picture> {
    let reader = open(bytes)?;
    let (header, number, colors) = with_colors(reader.headers())?;
    if header.own_attributes.environment_map == Some(EnvironmentMap::Cube) {
        return Err(invalid(
            "it is a cube map: `exrenvmap -latlong` makes a picture of longitude and latitude",
        ));
    }
    let window = header.shared_attributes.display_window;
    let (w, h) = (window.size.width(), window.size.height());
    check_size(w as u32, h as u32)?;
    let note = (reader.headers().len() > 1).then(|| {
        let layer = header.own_attributes.layer_name.as_ref();
        let name = layer.map_or(String::new(), |layer| format!(", `{layer}`"));
        format!(
            "the file has {} parts; using the first one with {}: number {}{name}",
            reader.headers().len(),
            if colors == GREY { "Y" } else { "R, G and B" },
            number + 1
        )
    });
    let primaries = &header.shared_attributes.chromaticities;
    let is_other = colors == COLORS && primaries.as_ref().is_some_and(are_other);
    let notes = note
        .into_iter()
        .chain(is_other.then(|| OTHER_PRIMARIES.to_owned()));
    let note = notes.reduce(|all, note| all + "; " + &note);
    let mut image = parse(reader)?;
    let part = image.layer_data.swap_remove(number);
    let offset = part.attributes.layer_position - window.position;
    let (left, top) = (i64::from(offset.x()), i64::from(offset.y()));
    let mut pixels = vec![[0.0; 3]; w * h];
    for channel in part.channel_data.list {
        let color = colors.iter().position(|&name| channel.name.eq(name));
        let Some(color) = color else { continue };
        let places = if colors == GREY {
            0..3
        } else {
            color..color + 1
        };
        let values = numbers(channel.sample_data);
        if values.len() != part.size.area() {
            return Err(invalid("channels of fewer values than pixels are not read"));
        }
        for (row, y) in values.chunks(part.size.width()).zip(top..) {
            for (value, x) in row.iter().zip(left..) {
                if (0..w as i64).contains(&x) && (0..h as i64).contains(&y) {
                    pixels[y as usize * w + x as usize][places.clone()].fill(*value);
                }
            }
        }
    }
    Ok(Picture {
        size: [w as u32, h as u32],
        pixels: Pixels::Linear(pixels),
        note,
    })
}

/// The channels of colours, and that of a grey picture.
const COLORS: &[&str] = &["R", "G", "B"];
const GREY: &[&str] = &["Y"];

fn are_other(primaries: &Chromaticities) -> bool {
    let Chromaticities {
        red,
        green,
        blue,
        white,
    } = primaries;
    are_other_primaries([red, green, blue, white].map(|point| [point.x(), point.y()]))
}

/// The first part with colours, else the first grey one, its number and its channels. A part with
/// `RY` or `X` is not grey: its `Y` belongs to colours that are not read, or is a coordinate.
fn with_colors(headers: &[Header]) -> ImageResult<(&Header, usize, &'static [&'static str])> {
    let has = |header: &Header, wanted: &str| {
        let mut channels = header.channels.list.iter();
        channels.any(|channel| channel.name.eq(wanted))
    };
    let found = [COLORS, GREY].into_iter().find_map(|colors| {
        let of_part = |header: &Header| {
            let is_grey = !(has(header, "RY") || has(header, "X"));
            colors.iter().all(|color| has(header, color)) && (colors == COLORS || is_grey)
        };
        let number = headers.iter().position(of_part)?;
        Some((&headers[number], number, colors))
    });
    found.ok_or_else(|| invalid("it has no channels R, G and B, and no Y alone"))
}

/// The most values of all channels: those of a picture of 4K with 60 channels.
const MAX_VALUES: f64 = (1_u64 << 29) as f64;

/// Reads the headers. The parts, of which all channels are read, may be larger than the picture.
fn open(bytes: &[u8]) -> ImageResult<Reader<Cursor<&[u8]>>> {
    let reader = exr::block::read(Cursor::new(bytes), false).map_err(invalid)?;
    let values = |header: &Header| {
        let Vec2(w, h) = header.layer_size;
        w as f64 * h as f64 * header.channels.list.len() as f64
    };
    let values: f64 = reader.headers().iter().map(values).sum();
    if values > MAX_VALUES {
        let why = format!("its channels have {values} values, more than {MAX_VALUES}");
        return Err(invalid(why + ": make it smaller"));
    }
    Ok(reader)
}

fn parse(reader: Reader<Cursor<&[u8]>>) -> ImageResult<FlatImage> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_chunks(reader);
    image.map_err(invalid)
}

fn numbers(samples: FlatSamples) -> Vec<f32> {
    match samples {
        FlatSamples::F16(values) => values.into_iter().map(|value| value.to_f32()).collect(),
        FlatSamples::F32(values) => values,
        FlatSamples::U32(values) => values.into_iter().map(|value| value as f32).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Channel, Values, write_exr};
    use exr::image::write::WritableImage;
    use exr::image::{AnyChannel, AnyChannels};
    use exr::meta::header::{ImageAttributes, LayerAttributes};

    type Attributes = (ImageAttributes, LayerAttributes);

    #[test]
    fn the_layers_that_are_written_are_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("layers.exr");
        let channel = |name, values| Channel { name, values };
        let written = vec![
            channel("R", Values::Float(vec![1.0, 2.0])),
            channel("normal.X", Values::Float(vec![-0.5, 0.25])),
            channel("normal.Y", Values::Float(vec![0.5, 0.75])),
            channel("primitive.id", Values::Id(vec![7, 9])),
        ];
        let file = std::fs::File::create(&path).expect("a file");
        write_exr(&file, written, [2, 1]).expect("a file");
        let layers = read_layers(&path).expect("layers");
        let names: Vec<&str> = layers.iter().map(|layer| layer.name.as_str()).collect();
        assert_eq!(names, ["", "normal", "primitive"]);
        assert_eq!(layers[1].size, [2, 1]);
        let expected = [("X", [-0.5, 0.25]), ("Y", [0.5, 0.75])];
        let expected = expected.map(|(name, values)| (name.to_owned(), values.to_vec()));
        assert_eq!(layers[1].channels, expected);
        assert_eq!(layers[2].channels[0].1, [7.0, 9.0]);
    }

    #[test]
    fn grey_files_are_grey() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("grey.exr");
        let pixels = |names: &[&'static str]| {
            let channel = |(i, &name): (usize, &&'static str)| {
                let values = Values::Float(vec![i as f32, 0.25]);
                Channel { name, values }
            };
            let channels = names.iter().enumerate().map(channel).collect();
            let file = std::fs::File::create(&path).expect("a file");
            write_exr(&file, channels, [2, 1]).expect("a file");
            decode(&std::fs::read(&path).expect("a file")).map(|picture| picture.pixels)
        };
        let linear = |first: [f32; 3]| Pixels::Linear(vec![first, [0.25; 3]]);
        assert_eq!(pixels(&["A", "Y"]).expect("grey"), linear([1.0; 3]));
        assert_eq!(
            pixels(&["B", "G", "R", "Y"]).expect("colours"),
            linear([2.0, 1.0, 0.0])
        );
        for none in [["BY", "RY", "Y"], ["R", "G", "Z"], ["X", "Y", "Z"]] {
            let why = pixels(&none).expect_err("no colours").to_string();
            assert!(why.contains("no channels R, G and B"), "{why}");
        }
    }

    /// The answer for a file of 2 x 1 white pixels with other attributes.
    fn decoded(change: impl Fn(&mut Attributes)) -> ImageResult<Picture> {
        let white = |name| AnyChannel::new(name, FlatSamples::F32(vec![1.0; 2]));
        let channels = AnyChannels::sort(COLORS.iter().copied().map(white).collect());
        let mut image = exr::image::Image::from_channels((2, 1), channels);
        let mut attributes = (image.attributes, image.layer_data.attributes);
        change(&mut attributes);
        (image.attributes, image.layer_data.attributes) = attributes;
        let mut file = Cursor::new(Vec::new());
        image.write().to_buffered(&mut file).expect("a file");
        decode(file.get_ref())
    }

    #[test]
    fn what_attributes_say_of_the_pixels_is_named() {
        let note = |[x, y]: [f32; 2]| {
            let [red, green, blue, white] = [(0.64, 0.33), (0.3, 0.6), (0.15, 0.06), (x, y)];
            let primaries = Chromaticities {
                red: red.into(),
                green: green.into(),
                blue: blue.into(),
                white: white.into(),
            };
            let picture = decoded(|(shared, _)| shared.chromaticities = Some(primaries));
            picture.expect("a picture").note
        };
        assert_eq!(note([0.3127, 0.329]), None);
        assert_eq!(note([0.45, 0.41]).as_deref(), Some(OTHER_PRIMARIES));
        let cube = decoded(|(_, own)| own.environment_map = Some(EnvironmentMap::Cube));
        let why = cube.expect_err("a cube").to_string();
        assert!(why.contains("cube map"), "{why}");
    }

    /// A few hundred bytes, of which 40,000 x 40,000 pixels of four bytes were made.
    #[test]
    fn parts_larger_than_the_picture_have_a_limit() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("large.exr");
        let file = std::fs::File::create(&path).expect("a file");
        let channel = |name| Channel {
            name,
            values: Values::Float(vec![1.0; 2]),
        };
        write_exr(&file, ["R", "G", "B"].map(channel).into(), [2, 1]).expect("a file");
        let mut bytes = std::fs::read(&path).expect("a file");
        let mut set = |name: &[u8], skipped: usize, numbers: &[u32]| {
            let found = bytes.windows(name.len()).position(|part| part == name);
            let at = found.expect("an attribute") + name.len() + skipped;
            let numbers: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
            bytes[at..at + numbers.len()].copy_from_slice(&numbers);
        };
        set(b"dataWindow\0box2i\0", 12, &[39_999, 39_999]);
        set(b"chunkCount\0int\0", 4, &[625 * 625]);
        std::fs::write(&path, &bytes).expect("a file");
        let all = read_layers(&path).expect_err("too large");
        for why in [decode(&bytes).expect_err("too large").to_string(), all] {
            assert!(why.contains("4800000000 values"), "{why}");
        }
    }

    #[test]
    fn a_file_that_is_none_is_named() {
        let why = read_layers(Path::new("no_such.exr")).expect_err("no file");
        assert!(why.contains("no_such.exr"), "{why}");
    }
}
