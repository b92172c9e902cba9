//! MTL, the material libraries of OBJ.
//!
//! A surface is a lamp if its `Ke` is not black, glass with `illum` 4, 6, 7 or 9, a mirror of
//! colour `Ks` with `illum` 3 or 5, and else diffuse.
//!
//! `Kd` and `map_Kd` are multiplied, as the format says, and as three.js and assimp do. The texture
//! alone is used beside a black `Kd`, which exporters write for "see the texture", and in files of
//! Blender, whose `Kd` beside a texture is a colour that Blender itself does not show.
//!
//! Blender means other things by `illum`: metal (3), whose amount is `Ka`, colour `Kd` and
//! roughness 1 - √(`Ns` / 1000), and transparency without refraction (6 and 9).

use super::builder::Builder;
use super::gltf_material::{MOSTLY, metal};
use super::obj::{decoded, statements};
use crate::collada::truncated;
use kit::{Material, Spectrum};
use std::collections::BTreeSet;
use std::path::Path;

/// The parameters of a material.
#[derive(Default)]
struct Parameters {
    name: String,
    diffuse: Option<Spectrum>,
    specular: Option<Spectrum>,
    emission: Spectrum,
    illumination: u32,
    ior: Option<f64>,
    metal: f64,
    exponent: f64,
    is_transparent: bool,
    /// The value of `map_Kd`.
    texture: Option<String>,
    has_specular_texture: bool,
    has_normals: bool,
    unknown: BTreeSet<String>,
}

/// Adds the materials of the library `file`, relative to `folder`, to the scene. Returns their
/// names and indices. A texture is beside the library, or else beside the OBJ file.
pub(super) fn add(
    builder: &mut Builder<'_>,
    folder: &Path,
    file: &str,
    bytes: &[u8],
) -> Vec<(String, u32)> {
    let text = decoded(bytes);
    let is_of_blender = text.starts_with("# Blender");
    let mut materials: Vec<Parameters> = Vec::new();
    for (line, word, value) in statements(&text) {
        let Some(material) = materials.last_mut().filter(|_| word != "newmtl") else {
            if word == "newmtl" {
                materials.push(Parameters {
                    name: value.to_owned(),
                    ..Parameters::default()
                });
            }
            continue;
        };
        if material.set(word, value).is_none() {
            let title = "parameters of materials that cannot be read";
            let place = format!("{file}, line {line}: {word} {value}");
            builder.warn(title, &place, "they are ignored");
        }
    }
    let add = |given: Parameters| {
        let index = given.add(builder, folder, Path::new(file), is_of_blender);
        (given.name, index)
    };
    materials.into_iter().map(add).collect()
}

impl Parameters {
    /// Sets the parameter `word`. `None` if its value cannot be read.
    fn set(&mut self, word: &str, value: &str) -> Option<()> {
        let number = || value.trim_start_matches("-halo").trim().parse::<f64>().ok();
        let color = || {
            let numbers: Option<Vec<f64>> =
                value.split_whitespace().map(|x| x.parse().ok()).collect();
            match numbers?[..] {
                [grey] => Some(Spectrum::grey(grey)),
                [r, g, b, ..] => Some(Spectrum::new(r, g, b)),
                _ => None,
            }
        };
        match word.to_ascii_lowercase().as_str() {
            // Colours of ambient light are in use for nothing else than Blender's metal.
            "ka" => self.metal = color().map_or(0.0, |color| color.r),
            "ns" => self.exponent = number().unwrap_or(0.0),
            "map_ka" | "map_ns" => {}
            "kd" => self.diffuse = Some(color()?),
            "ks" => self.specular = Some(color()?),
            "ke" => self.emission = color()?,
            "illum" => self.illumination = number()? as u32,
            "ni" => self.ior = Some(number()?),
            "d" => self.is_transparent |= number()? < 0.99,
            "map_d" => self.is_transparent = true,
            "map_kd" if value.is_empty() => return None,
            "map_kd" => self.texture = Some(value.to_owned()),
            "map_ks" => self.has_specular_texture = true,
            "map_bump" | "bump" | "norm" => self.has_normals = true,
            _ => drop(self.unknown.insert(word.to_owned())),
        }
        Some(())
    }

    fn add(
        &self,
        builder: &mut Builder<'_>,
        folder: &Path,
        library: &Path,
        is_of_blender: bool,
    ) -> u32 {
        let clamped = |color: Spectrum, most: f64| {
            let channel = |x: f64| x.clamp(0.0, most);
            Spectrum::new(channel(color.r), channel(color.g), channel(color.b))
        };
        let given = self.diffuse.unwrap_or(Spectrum::WHITE);
        let diffuse = clamped(given, 1.0);
        let emission = clamped(self.emission, f64::MAX);
        let roughness = 1.0 - (self.exponent / 1000.0).clamp(0.0, 1.0).sqrt();
        let material = match self.illumination {
            _ if !emission.is_black() => Material::Emission { radiance: emission },
            3 if is_of_blender && self.metal >= MOSTLY => metal(diffuse, roughness),
            3..=9 if is_of_blender => Material::Diffuse {
                reflectance: diffuse,
            },
            3 | 5 => Material::Mirror {
                reflectance: clamped(self.specular.unwrap_or(Spectrum::WHITE), 1.0),
            },
            4 | 6 | 7 | 9 => Material::Glass {
                reflectance: Spectrum::WHITE,
                transmittance: Spectrum::WHITE,
                roughness: 0.0,
                ior: self.ior.filter(|ior| *ior >= 1.0).unwrap_or(1.5),
            },
            _ => Material::Diffuse {
                reflectance: match (&self.texture, self.diffuse) {
                    (Some(_), _) if is_of_blender || diffuse.is_black() => Spectrum::WHITE,
                    (None, None) => Spectrum::grey(0.5),
                    _ => diffuse,
                },
            },
        };
        let is_diffuse = matches!(material, Material::Diffuse { .. });
        let is_glass = matches!(material, Material::Glass { .. });
        let is_tinted = is_diffuse && self.texture.is_some() && diffuse != Spectrum::WHITE;
        let is_plain = !self.has_specular_texture
            && (self.illumination == 1
                || (self.specular)
                    .is_none_or(|c| c == Spectrum::grey(0.5) || c.max_channel() < 0.1));
        let mut warn = |is_so: bool, title: &str, result: &str| {
            if is_so {
                builder.warn(title, &self.name, result);
            }
        };
        warn(
            (is_diffuse && diffuse != given) || emission != self.emission,
            "colours of materials below 0, or above 1",
            "they are clamped",
        );
        warn(
            self.is_transparent && !is_glass,
            "materials with transparent parts",
            "they are opaque",
        );
        warn(
            is_tinted && diffuse.is_black(),
            "a black `Kd` beside `map_Kd`",
            "the texture alone is used",
        );
        warn(
            is_tinted && !diffuse.is_black() && !is_of_blender,
            "`Kd` beside `map_Kd`",
            "they are multiplied; some programs show the texture alone: `Kd 1 1 1` does the same here",
        );
        warn(
            !emission.is_black() && self.diffuse.is_some_and(|c| !c.is_black()),
            "lamps that reflect light",
            "they reflect none",
        );
        warn(
            matches!(material, Material::Mirror { .. })
                && !is_of_blender
                && self.diffuse.is_some_and(|c| !c.is_black()),
            "the diffuse colour `Kd` of mirrors",
            "it is ignored: `illum` 3 and 5 are mirrors of colour `Ks`",
        );
        warn(self.has_normals, "normal maps", "they are ignored");
        warn(
            is_diffuse && !is_plain,
            "highlights of materials",
            "they are ignored: `illum` 3 makes a mirror",
        );
        warn(
            !is_diffuse && self.texture.is_some(),
            "textures of lamps, glass and mirrors",
            "only the texture of a diffuse surface is used",
        );
        if !self.unknown.is_empty() {
            let names = truncated(&Vec::from_iter(self.unknown.iter().map(|s| &**s)).join(", "));
            let title = "parameters of materials that are not read";
            builder.warn(
                title,
                &format!("{}: {names}", self.name),
                "they are ignored",
            );
        }
        let texture = self.texture.as_deref().filter(|_| is_diffuse).map(|value| {
            let given = after_options(value);
            if given != value {
                builder.warn("options of map_Kd", &self.name, "they are ignored");
            }
            let file = given.replace('\\', "/").replace('"', "");
            let beside = library.with_file_name(&file);
            match folder.join(&beside).is_file() {
                true => beside.to_string_lossy().into_owned(),
                false => file,
            }
        });
        builder.add_material(&self.name, material, texture)
    }
}

/// The name of a file, which may have blanks, after options such as `-s 2 2 1 -clamp on`.
fn after_options(value: &str) -> &str {
    let mut rest = value;
    while rest.starts_with('-') {
        let (option, mut after) = split(rest);
        let (is_numbers, most) = match option {
            "-o" | "-s" | "-t" => (true, 3),
            "-mm" => (true, 2),
            _ => (false, 1),
        };
        for _ in 0..most {
            let (word, others) = split(after);
            if !is_numbers || word.parse::<f64>().is_ok() {
                after = others;
            }
        }
        if after.is_empty() {
            break;
        }
        rest = after;
    }
    rest
}

/// The first word of a text and what follows.
pub(super) fn split(text: &str) -> (&str, &str) {
    let (word, rest) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    (word, rest.trim())
}
