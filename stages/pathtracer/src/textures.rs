//! Loads the textures of a scene and looks them up.

use crate::texture_file::read_texture;
use kit::math::pow;
use kit::{Hit, Scene, Spectrum, Texture, Vec2};
use picture_files::{ImageError, Picture, Pixels};
use std::fmt;
use std::path::{Path, PathBuf};

/// The textures of a scene, in the order of [`TextureMap::files`](kit::texture::TextureMap::files).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Textures {
    list: Vec<Texture>,
}

/// A texture that is not what the scene file asks for.
#[derive(Debug)]
pub enum TextureWarning {
    /// It cannot be read. Its surfaces are grey instead.
    Missing {
        /// The path of the file.
        path: PathBuf,
        /// Why it cannot be read.
        why: String,
    },
    /// Not all of the file is used.
    Partial {
        /// The path of the file.
        path: PathBuf,
        /// Which part is used.
        note: String,
    },
    /// It is not at its path, but a file of its name is near the scene.
    Moved {
        /// The path of the file, as it is in the scene file.
        path: PathBuf,
        /// The file that is used.
        found: PathBuf,
    },
}

impl fmt::Display for TextureWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TextureWarning::Missing { path, why } => write!(
                f,
                "cannot read the texture {}: {why}; its surfaces are grey, 0.5 0.5 0.5",
                path.display()
            ),
            TextureWarning::Partial { path, note } => write!(f, "{}: {note}", path.display()),
            TextureWarning::Moved { path, found } => write!(
                f,
                "there is no texture {}; using {}",
                path.display(),
                found.display()
            ),
        }
    }
}

impl From<Vec<Texture>> for Textures {
    /// Textures in the order of the scene's files.
    fn from(list: Vec<Texture>) -> Textures {
        Textures { list }
    }
}

impl Textures {
    /// Reads the textures of `scene`. Their paths are relative to `folder`, that of the scene file.
    pub fn load(scene: &Scene, folder: &Path) -> (Textures, Vec<TextureWarning>) {
        let mut warnings = Vec::new();
        let files = scene.textures.files.iter();
        let list = files.map(|file| {
            let embedded = scene.textures.embedded.get(file);
            // The name of an image inside of the scene file is not a path.
            let path = match embedded {
                Some(_) => PathBuf::from(file),
                None => folder.join(file),
            };
            let (found, decoded) = match embedded {
                Some(bytes) => (path.clone(), decode(bytes, &path)),
                None => {
                    let (found, bytes) = read_texture(folder, file);
                    let bytes = bytes.map_err(|why| why.to_string());
                    let decoded = bytes.and_then(|read| decode(&read, &found));
                    (found, decoded)
                }
            };
            match decoded {
                Ok((texture, note)) => {
                    if let Some(note) = note {
                        let path = found.clone();
                        warnings.push(TextureWarning::Partial { path, note });
                    }
                    if found != path {
                        let path = file.into();
                        warnings.push(TextureWarning::Moved { path, found });
                    }
                    texture
                }
                Err(why) => {
                    warnings.push(TextureWarning::Missing { path: found, why });
                    Texture::uniform(Spectrum::grey(0.5))
                }
            }
        });
        (Textures::from(list.collect::<Vec<_>>()), warnings)
    }

    /// Whether the scene has no textures.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The colour of the texture at `hit`; `None` if the surface has no texture.
    #[inline]
    pub fn at(&self, scene: &Scene, hit: &Hit) -> Option<Spectrum> {
        if self.is_empty() {
            return None;
        }
        let object = &scene.objects[scene.object_of[hit.prim.0 as usize] as usize];
        let file = scene.textures.of_material(object.material)?;
        // A surface without texture coordinates has (0, 0) everywhere.
        let uv = scene.textures.uv(hit).unwrap_or(Vec2::ZERO);
        Some(self.list[file as usize].at(uv))
    }
}

/// The texture in the bytes of the image file `path`, and what is to be said about the file.
fn decode(bytes: &[u8], path: &Path) -> Result<(Texture, Option<String>), String> {
    let describe = |why: ImageError| match why {
        ImageError::IoError(why) => why.to_string(),
        other => format!("{other} (png, jpg, bmp, tga, exr and hdr can be read)"),
    };
    let Picture { size, pixels, note } = picture_files::decode(bytes, path).map_err(describe)?;
    let texture = Texture::new(size[0] as usize, texels(&pixels));
    Ok((texture.ok_or("it is empty")?, note))
}

/// Linear reflectances in [0, 1].
fn texels(pixels: &Pixels) -> Vec<Spectrum> {
    match pixels {
        Pixels::Linear(pixels) => {
            let linear = |channel: f32| {
                if channel > 0.0 {
                    f64::from(channel).min(1.0)
                } else {
                    0.0
                }
            };
            let texel = |p: &[f32; 3]| Spectrum::from(p.map(linear));
            pixels.iter().map(texel).collect()
        }
        Pixels::Srgb(pixels) => {
            let linear: Vec<f64> = (0..=u8::MAX).map(from_srgb).collect();
            let texel = |p: &[u8; 3]| Spectrum::from(p.map(|byte| linear[usize::from(byte)]));
            pixels.iter().map(texel).collect()
        }
    }
}

/// The linear value of an sRGB byte (IEC 61966-2-1).
fn from_srgb(byte: u8) -> f64 {
    let encoded = f64::from(byte) / 255.0;
    if encoded <= 0.04045 {
        encoded / 12.92
    } else {
        pow((encoded + 0.055) / 1.055, 2.4)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_srgb() {
        assert_eq!(from_srgb(0), 0.0);
        assert_eq!(from_srgb(255), 1.0);
        // A photographic grey card reflects 18 % of the light: byte 118.
        assert!((from_srgb(118) - 0.18).abs() < 0.003);
        let increases = (0..255).all(|byte| from_srgb(byte) < from_srgb(byte + 1));
        assert!(increases);
    }

    /// Such an image has the path of its scene file in its name.
    #[test]
    fn an_image_inside_of_the_scene_file_is_no_other_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let model = folder.path().join("a.glb");
        std::fs::write(&model, "no image").expect("a file");
        let red = folder.path().join("red.png");
        let file = std::fs::File::create(&red).expect("a file");
        picture_files::write_png(&file, &[255, 0, 0], [1, 1]).expect("a PNG");
        let png = std::fs::read(&red).expect("a PNG");
        let name = format!("image 0 of {}", model.display());
        let mut scene = Scene::default();
        scene.textures.add_material(Some(name.clone()));
        scene.textures.embedded.insert(name, png);
        let (textures, warnings) = Textures::load(&scene, folder.path());
        assert!(warnings.is_empty(), "{warnings:?}");
        assert_eq!(
            textures.list[0].at(Vec2::ZERO),
            Spectrum::new(1.0, 0.0, 0.0)
        );
    }
}
