//! The layers of an `.exr` file beside its picture: normals, depths, numbers of primitives.

use kit::FilmSize;
use pathtracer::rate_picture::viridis;
use pathtracer::tone::Tone;
use picture_files::{FileLayer, read_layers};
use std::path::Path;

/// A layer.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Its name in the file.
    pub name: String,
    /// The names of its channels.
    pub channels: Vec<String>,
    /// The values of each channel, row by row from the bottom left.
    values: Vec<Vec<f32>>,
    width: u32,
    looks_like: Look,
}

/// How the values of a layer become colours.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Look {
    /// Radiance or reflectance: these channels are red, green and blue.
    Color([usize; 3]),
    /// Directions: these channels are x, y and z.
    Direction([usize; 3]),
    /// One number, from the least to the greatest one.
    Number(f32, f32),
}

/// Stands for no primitive in a layer of numbers of primitives.
const NO_PRIMITIVE: f32 = u32::MAX as f32;

impl Layer {
    /// The layers of a file that have the size of its picture, without the picture itself.
    pub fn load(path: &Path, size: FilmSize) -> Result<Vec<Layer>, String> {
        let layers = read_layers(path)?
            .into_iter()
            .filter(|layer| layer.size == [size.w, size.h]);
        Ok(layers
            .filter(|layer| !layer.name.is_empty())
            .map(Layer::new)
            .collect())
    }

    fn new(layer: FileLayer) -> Layer {
        let width = layer.size[0];
        let from_bottom = |values: Vec<f32>| {
            let rows = values.chunks(width.max(1) as usize).rev();
            rows.flatten().copied().collect::<Vec<f32>>()
        };
        let (channels, values): (Vec<String>, Vec<Vec<f32>>) = layer
            .channels
            .into_iter()
            .map(|(name, values)| (name, from_bottom(values)))
            .unzip();
        let named = |names: [&str; 3]| {
            let [a, b, c] = names.map(|name| channels.iter().position(|channel| channel == name));
            Some([a?, b?, c?])
        };
        let looks_like = match (named(["R", "G", "B"]), named(["X", "Y", "Z"])) {
            (Some(color), _) => Look::Color(color),
            (None, Some(direction)) => Look::Direction(direction),
            (None, None) => {
                let numbers = values
                    .first()
                    .into_iter()
                    .flatten()
                    .copied()
                    .filter(|x| x.is_finite() && *x != NO_PRIMITIVE);
                let least = numbers.clone().fold(f32::INFINITY, f32::min);
                Look::Number(least, numbers.fold(f32::NEG_INFINITY, f32::max))
            }
        };
        Layer {
            name: layer.name,
            channels,
            values,
            width,
            looks_like,
        }
    }

    /// The values of a pixel, channel by channel.
    pub fn get(&self, x: u32, y: u32) -> Vec<f32> {
        let at = y as usize * self.width as usize + x as usize;
        self.values.iter().map(|values| values[at]).collect()
    }

    /// The least and the greatest number, if the layer has one number for each pixel.
    pub fn range(&self) -> Option<[f32; 2]> {
        match self.looks_like {
            Look::Number(least, greatest) => Some([least, greatest]),
            _ => None,
        }
    }

    /// The bytes of a pixel: colours with this tone, directions around grey, numbers in false
    /// colours.
    pub fn bytes(&self, x: u32, y: u32, tone: Tone) -> [u8; 3] {
        let values = self.get(x, y);
        match self.looks_like {
            Look::Color(channels) => tone.to_bytes(channels.map(|c| f64::from(values[c])).into()),
            Look::Direction(channels) => {
                channels.map(|c| (255.0 * (0.5 * values[c] + 0.5).clamp(0.0, 1.0)).round() as u8)
            }
            Look::Number(least, greatest) => match values[0] {
                value if value.is_nan() || value == NO_PRIMITIVE => [0; 3],
                value => {
                    let range = f64::from(greatest - least).max(f64::MIN_POSITIVE);
                    viridis(f64::from(value - least) / range)
                }
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layer(channels: &[(&str, &[f32])]) -> Layer {
        let channels = channels.iter();
        Layer::new(FileLayer {
            name: "layer".to_owned(),
            size: [2, 2],
            channels: channels
                .map(|(name, values)| ((*name).to_owned(), values.to_vec()))
                .collect(),
        })
    }

    #[test]
    fn rows_count_from_the_bottom() {
        let depth = layer(&[("Z", &[1.0, 2.0, 3.0, 4.0])]);
        assert_eq!(depth.get(1, 0), [4.0]);
        assert_eq!(depth.get(0, 1), [1.0]);
    }

    #[test]
    fn numbers_go_from_the_least_to_the_greatest_color() {
        let none = u32::MAX as f32;
        let prims = layer(&[("id", &[3.0, 7.0, none, 5.0])]);
        assert_eq!(prims.range(), Some([3.0, 7.0]));
        let bytes = |x, y| prims.bytes(x, y, Tone::default());
        assert_eq!(bytes(0, 1), viridis(0.0));
        assert_eq!(bytes(1, 1), viridis(1.0));
        assert_eq!(bytes(1, 0), viridis(0.5));
        assert_eq!(bytes(0, 0), [0; 3], "no primitive");
    }

    #[test]
    fn directions_are_shown_around_grey() {
        let up = [1.0; 4];
        let none = [0.0; 4];
        let down = [-1.0; 4];
        let normals = layer(&[("X", &none), ("Y", &up), ("Z", &down)]);
        assert_eq!(normals.bytes(0, 0, Tone::default()), [128, 255, 0]);
        assert_eq!(normals.range(), None);
    }
}
