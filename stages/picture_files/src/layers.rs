//! Reads all layers of an `.exr` file: those of the renderer, and those of others.

use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, read};
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
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .on_progress(|_| ())
        .from_file(path)
        .map_err(|why| format!("{}: {why}", path.display()))?;
    let mut layers: Vec<FileLayer> = Vec::new();
    for part in &image.layer_data {
        let size = [part.size.width() as u32, part.size.height() as u32];
        let part_name = part.attributes.layer_name.as_ref();
        let part_name = part_name.map(ToString::to_string).unwrap_or_default();
        for channel in &part.channel_data.list {
            let whole = channel.name.to_string();
            let (prefix, short) = whole.rsplit_once('.').unwrap_or(("", &whole));
            let name = [part_name.as_str(), prefix]
                .into_iter()
                .filter(|name| !name.is_empty())
                .collect::<Vec<_>>()
                .join(".");
            let values = (short.to_owned(), numbers(&channel.sample_data));
            match layers.iter_mut().find(|layer| layer.name == name) {
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

fn numbers(samples: &FlatSamples) -> Vec<f32> {
    match samples {
        FlatSamples::F16(values) => values.iter().map(|value| value.to_f32()).collect(),
        FlatSamples::F32(values) => values.clone(),
        FlatSamples::U32(values) => values.iter().map(|&value| value as f32).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Channel, Values, write_exr};

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
    fn a_file_that_is_none_is_named() {
        let why = read_layers(Path::new("no_such.exr")).expect_err("no file");
        assert!(why.contains("no_such.exr"), "{why}");
    }
}
