//! The materials of glTF: what of them the materials of the course can show.
//!
//! A surface has one material here, so the rule is, in this order: emission without a texture makes
//! it a lamp; a transmission of at least a half, glass; a metal without a texture of its roughness,
//! a mirror, or a glossy surface if it is rough; else it is diffuse, with the base colour and its
//! texture. What is unlit, or of the old specular glossiness, is diffuse.

use super::builder::Builder;
use super::gltf::{File, is_data};
use crate::diagnostic::SceneError;
use gltf::image::Source;
use gltf::material::AlphaMode;
use gltf::texture::{Info, MagFilter, WrappingMode};
use kit::{Material, Spectrum, Vec2, math};

/// From this share on a surface is a metal, or glass.
pub(super) const MOSTLY: f64 = 0.5;

/// Below this roughness a metal is a mirror.
const SMOOTH: f64 = 0.1;

/// The index of refraction of glTF's materials without one.
const DEFAULT_IOR: f32 = 1.5;

/// A material in the scene, and how its texture is placed.
#[derive(Clone, Copy)]
pub(super) struct ReadMaterial {
    pub(super) index: u32,
    pub(super) placement: TexturePlacement,
}

/// Which texture coordinates a texture uses, and their transform (`KHR_texture_transform`).
#[derive(Clone, Copy)]
pub(super) struct TexturePlacement {
    pub(super) set: u32,
    offset: [f32; 2],
    rotation: f32,
    scale: [f32; 2],
}

impl TexturePlacement {
    const IDENTITY: TexturePlacement = TexturePlacement {
        set: 0,
        offset: [0.0; 2],
        rotation: 0.0,
        scale: [1.0; 2],
    };

    fn of(info: &Info<'_>) -> TexturePlacement {
        let set = info.tex_coord();
        match info.texture_transform() {
            None => TexturePlacement {
                set,
                ..TexturePlacement::IDENTITY
            },
            Some(transform) => TexturePlacement {
                set: transform.tex_coord().unwrap_or(set),
                offset: transform.offset(),
                rotation: transform.rotation(),
                scale: transform.scale(),
            },
        }
    }

    /// The coordinates in the picture with v upwards; in glTF, v points down.
    pub(super) fn apply(&self, [u, v]: [f64; 2]) -> Vec2 {
        let (sin, cos) = math::sin_cos(f64::from(self.rotation));
        let (u, v) = (u * f64::from(self.scale[0]), v * f64::from(self.scale[1]));
        let [x, y] = [u * cos + v * sin, v * cos - u * sin];
        let [x, y] = [x + f64::from(self.offset[0]), y + f64::from(self.offset[1])];
        Vec2::new(x, 1.0 - y)
    }
}

/// Adds a material to the scene. That of a primitive without one is the builder's default.
pub(super) fn add(
    builder: &mut Builder<'_>,
    file: &File<'_>,
    given: &gltf::Material<'_>,
) -> Result<ReadMaterial, SceneError> {
    let Some(number) = given.index() else {
        return Ok(ReadMaterial {
            index: builder.default_material(),
            placement: TexturePlacement::IDENTITY,
        });
    };
    let name = given
        .name()
        .map_or(format!("material {number}"), str::to_owned);
    let pbr = given.pbr_metallic_roughness();
    let old = given.pbr_specular_glossiness();
    let factor = old.as_ref().map(|old| old.diffuse_factor());
    let [r, g, b, alpha] = factor.unwrap_or(pbr.base_color_factor());
    let base = color([r, g, b]);
    let emission =
        color(given.emissive_factor()) * f64::from(given.emissive_strength().unwrap_or(1.0));
    let transmission = given
        .transmission()
        .map_or(0.0, |t| f64::from(t.transmission_factor()));
    let roughness = pbr.roughness_factor();
    let metallic = match given.unlit() || old.is_some() {
        true => 0.0,
        false => f64::from(pbr.metallic_factor()),
    };
    // Microfacets as wide as this: squared, as the format says.
    let alpha_width = f64::from(roughness * roughness);
    let emits = !emission.is_black() && given.emissive_texture().is_none();
    let material = if emits {
        Material::Emission { radiance: emission }
    } else if transmission >= MOSTLY {
        Material::Glass {
            reflectance: Spectrum::WHITE,
            transmittance: base,
            roughness: alpha_width,
            ior: f64::from(given.ior().unwrap_or(DEFAULT_IOR)).max(1.0),
        }
    } else if metallic >= MOSTLY && pbr.metallic_roughness_texture().is_none() {
        metal(base, f64::from(roughness))
    } else {
        Material::Diffuse { reflectance: base }
    };
    let mut warn = |is_so: bool, title: &str, result: &str| {
        if is_so {
            builder.warn(title, &name, result);
        }
    };
    let is_diffuse = matches!(material, Material::Diffuse { .. });
    let is_glass = matches!(material, Material::Glass { .. });
    warn(
        given.alpha_mode() != AlphaMode::Opaque
            && transmission < MOSTLY
            && (alpha < 1.0 || pbr.base_color_texture().is_some()),
        "materials with transparent parts",
        "they are opaque",
    );
    warn(
        !emission.is_black() && !emits,
        "materials whose light has a texture",
        "they emit no light",
    );
    warn(
        is_diffuse && pbr.metallic_roughness_texture().is_some() && metallic > 0.0,
        "materials with a texture of metal and roughness",
        "they are diffuse",
    );
    warn(
        emits && given.double_sided(),
        "lamps that shine on both sides",
        "they shine on their fronts only",
    );
    warn(
        emits && !base.is_black(),
        "lamps that reflect light",
        "they reflect none",
    );
    warn(
        is_diffuse
            && !emits
            && metallic > 0.25
            && metallic < MOSTLY
            && pbr.metallic_roughness_texture().is_none(),
        "materials that are partly metal",
        "they are diffuse",
    );
    warn(
        transmission > 0.0 && transmission < MOSTLY,
        "materials that let a little light through",
        "they let none through",
    );
    let has_texture = |t: &gltf::material::Transmission<'_>| t.transmission_texture().is_some();
    warn(
        given.transmission().as_ref().is_some_and(has_texture)
            || (is_glass && pbr.metallic_roughness_texture().is_some()),
        "textures of glass and of its roughness",
        "the glass is the same everywhere",
    );
    warn(
        is_diffuse && given.unlit(),
        "materials without light (KHR_materials_unlit)",
        "they are diffuse",
    );
    warn(
        given.normal_texture().is_some(),
        "normal maps",
        "they are ignored",
    );
    warn(
        !is_diffuse && pbr.base_color_texture().is_some(),
        "textures of lamps, glass and metal",
        "only the texture of a diffuse surface is used",
    );
    warn(
        old.is_some(),
        "KHR_materials_pbrSpecularGlossiness",
        "only the diffuse colour of these materials is used",
    );
    let mut placement = TexturePlacement::IDENTITY;
    let mut texture = None;
    let info = match old {
        Some(old) => old.diffuse_texture(),
        None => pbr.base_color_texture(),
    };
    if let Some(info) = info.filter(|_| is_diffuse) {
        placement = TexturePlacement::of(&info);
        let sampler = info.texture().sampler();
        if sampler.mag_filter() == Some(MagFilter::Nearest) {
            builder.warn("textures without a filter", &name, "they are smoothed");
        }
        if [sampler.wrap_s(), sampler.wrap_t()] != [WrappingMode::Repeat; 2] {
            builder.warn(
                "textures that are clamped or mirrored",
                &name,
                "they are repeated",
            );
        }
        texture = image(builder, file, &info)?;
        if texture.is_none() {
            let title = "textures whose image is in no format of glTF itself";
            let result = "the colour without the texture is used: export PNG or JPEG images";
            builder.warn(title, &name, result);
        }
    }
    Ok(ReadMaterial {
        index: builder.add_material(&name, material, texture),
        placement,
    })
}

/// A mirror, or a glossy surface if it is rough.
pub(super) fn metal(reflectance: Spectrum, roughness: f64) -> Material {
    if roughness < SMOOTH {
        return Material::Mirror { reflectance };
    }
    // Microfacets are as wide as the roughness squared, and lobes of this exponent as wide as they.
    let shininess = (2.0 / roughness.powi(4) - 2.0).max(0.0);
    Material::Glossy {
        reflectance,
        shininess,
    }
}

/// The name of the image of a texture; `None` if only an extension has one. Images inside of the
/// file are stored in the builder.
fn image(
    builder: &mut Builder<'_>,
    file: &File<'_>,
    info: &Info<'_>,
) -> Result<Option<String>, SceneError> {
    let Some(image) = info.texture().source() else {
        return Ok(None);
    };
    let name = format!("image {} of {}", image.index(), builder.file);
    let bytes = match image.source() {
        Source::View { view, .. } => {
            let bytes = file.buffers.view(&view).map_err(|why| file.damaged(why))?;
            bytes.to_vec()
        }
        Source::Uri { uri, .. } if is_data(uri) => file.data(uri)?,
        Source::Uri { uri, .. } => return Ok(Some(file.path(uri))),
    };
    builder.textures.embedded.insert(name.clone(), bytes);
    Ok(Some(name))
}

fn color(channels: [f32; 3]) -> Spectrum {
    Spectrum::from(channels.map(|channel| f64::from(channel).max(0.0)))
}
