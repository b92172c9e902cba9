//! The pictures that surfaces carry, read from their files.

use image::{DynamicImage, ImageError};
use kit::math::pow;
use kit::{Hit, Scene, Spectrum, Texture, Vec2};
use std::fmt;
use std::path::{Path, PathBuf};

/// More texels than this in one picture are refused: with 24 bytes each, 1.6 GB.
const MAX_TEXELS: u64 = 1 << 26;

/// The pictures of a scene, in the order of [`TextureMap::files`](kit::texture::TextureMap::files).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Textures {
    list: Vec<Texture>,
}

/// A picture that cannot be read. Its surfaces are grey instead.
#[derive(Debug)]
pub struct MissingTexture {
    /// Where it was looked for.
    pub path: PathBuf,
    /// Why it is not there.
    pub why: String,
}

impl fmt::Display for MissingTexture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let MissingTexture { path, why } = self;
        let path = path.display();
        write!(
            f,
            "cannot read the texture {path}: {why}; its surfaces are grey, 0.5 0.5 0.5"
        )
    }
}

impl From<Vec<Texture>> for Textures {
    /// Pictures in the order of the scene's files.
    fn from(list: Vec<Texture>) -> Textures {
        Textures { list }
    }
}

impl Textures {
    /// Reads the pictures of `scene`; their paths count from `folder`, the scene file's own.
    pub fn load(scene: &Scene, folder: &Path) -> (Textures, Vec<MissingTexture>) {
        let mut missing = Vec::new();
        let files = scene.textures.files.iter();
        let list = files.map(|file| {
            let path = folder.join(file);
            load_texture(&path).unwrap_or_else(|why| {
                missing.push(MissingTexture { path, why });
                Texture::uniform(Spectrum::grey(0.5))
            })
        });
        (Textures::from(list.collect::<Vec<_>>()), missing)
    }

    /// Whether there is nothing to look up.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// What the picture on the surface shows where it was hit. `None` if the surface carries none.
    #[inline]
    pub fn at(&self, scene: &Scene, hit: &Hit) -> Option<Spectrum> {
        if self.is_empty() {
            return None;
        }
        let object = &scene.objects[scene.object_of[hit.prim.0 as usize] as usize];
        let file = scene.textures.of_material(object.material)?;
        // A surface without coordinates shows one point of its picture, as if all its vertices had none.
        let uv = scene.textures.uv(hit).unwrap_or(Vec2::ZERO);
        Some(self.list[file as usize].at(uv))
    }
}

fn load_texture(path: &Path) -> Result<Texture, String> {
    let readable = |why: ImageError| match why {
        ImageError::IoError(why) => why.to_string(),
        other => format!("{other} (png, jpg, exr and hdr can be read)"),
    };
    let reader = image::ImageReader::open(path)
        .and_then(|reader| reader.with_guessed_format())
        .map_err(|why| why.to_string())?;
    let (width, height) = reader.into_dimensions().map_err(readable)?;
    if u64::from(width) * u64::from(height) > MAX_TEXELS {
        return Err(format!(
            "it has {width} x {height} texels, more than {MAX_TEXELS}: make it smaller"
        ));
    }
    let picture = image::open(path).map_err(readable)?;
    Texture::new(width as usize, texels(&picture)).ok_or_else(|| "it is empty".to_owned())
}

/// Linear reflectance in [0, 1], row by row from the top left. Bytes stand for light as in sRGB; numbers of
/// exr and hdr files are linear.
fn texels(picture: &DynamicImage) -> Vec<Spectrum> {
    match picture {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            let linear = |channel: f32| {
                if channel > 0.0 {
                    f64::from(channel).min(1.0)
                } else {
                    0.0
                }
            };
            let pixels = picture.to_rgb32f();
            pixels
                .pixels()
                .map(|p| Spectrum::from(p.0.map(linear)))
                .collect()
        }
        _ => {
            let linear: Vec<f64> = (0..=u8::MAX).map(from_srgb).collect();
            let pixels = picture.to_rgb8();
            pixels
                .pixels()
                .map(|p| Spectrum::from(p.0.map(|byte| linear[usize::from(byte)])))
                .collect()
        }
    }
}

/// The light that a byte stands for (IEC 61966-2-1).
fn from_srgb(byte: u8) -> f64 {
    let shown = f64::from(byte) / 255.0;
    if shown <= 0.04045 {
        shown / 12.92
    } else {
        pow((shown + 0.055) / 1.055, 2.4)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_srgb() {
        assert_eq!(from_srgb(0), 0.0);
        assert_eq!(from_srgb(255), 1.0);
        // Middle grey of a photographer's card: 18 % of the light, byte 118.
        assert!((from_srgb(118) - 0.18).abs() < 0.003);
        let rising = (0..255).all(|byte| from_srgb(byte) < from_srgb(byte + 1));
        assert!(rising);
    }
}
