//! `<material>` and `<effect>`: the materials of surfaces.
//!
//! The materials of the course's extension are in `<extra><technique profile="CGL">` of the effect:
//! `emission{radiance}`, `mirror{reflectance}`, `glossy{reflectance, shininess}`,
//! `glass{reflectance, transmittance, roughness, ior}`,
//! `refraction{transmittance, roughness, ior}`. Otherwise the diffuse colour or texture of `phong`,
//! `lambert` or `blinn` is used.

use super::document::{
    Document, Element, child, children, course_technique, descendant, describe, tag,
};
use super::numbers::{exactly, floats};
use super::parameter;
use super::texture;
use crate::diagnostic::SceneError;
use kit::{Material, Spectrum};

/// A material and its texture, as described by a `<material>` element.
pub(super) struct TexturedMaterial {
    pub(super) material: Material,
    /// The image file of the texture.
    pub(super) texture: Option<String>,
}

impl TexturedMaterial {
    /// The default grey, for surfaces without a usable material.
    pub(super) const DEFAULT: TexturedMaterial = TexturedMaterial {
        material: Material::Diffuse {
            reflectance: Spectrum::grey(0.5),
        },
        texture: None,
    };
}

impl From<Material> for TexturedMaterial {
    fn from(material: Material) -> TexturedMaterial {
        TexturedMaterial {
            material,
            texture: None,
        }
    }
}

/// Reads a `<material>` element. Without an effect, with a warning: the default grey.
pub(super) fn read<'a>(
    doc: &Document<'a>,
    material: Element<'a>,
) -> Result<TexturedMaterial, SceneError> {
    let instance = doc.child(material, "instance_effect");
    let effect = instance
        .clone()
        .and_then(|instance| doc.target(instance, "url", "effect"));
    let (instance, effect) = match (instance, effect) {
        (Ok(instance), Ok(effect)) => (instance, effect),
        (Err(error), _) | (_, Err(error)) => {
            doc.warn_of(error, "the surface uses grey, 0.5 0.5 0.5");
            return Ok(TexturedMaterial::DEFAULT);
        }
    };
    if let Some(technique) = course_technique(effect) {
        let expected = "expected emission, mirror, glossy, glass or refraction";
        let element = children(technique).next();
        if let Some(element) = element
            && let Some(material) = course_material(doc, element)?
        {
            return Ok(material.into());
        }
        let title = match element {
            Some(other) => format!("<{}> is not a material", tag(other)),
            None => "the technique contains no material".to_owned(),
        };
        doc.on(element.unwrap_or(technique), title, expected)
            .help("the common profile of the effect is used instead")
            .warn();
    }
    common_material(doc, instance, effect)
}

/// A material of the course's extension. `None` if it is unknown.
fn course_material<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
) -> Result<Option<Material>, SceneError> {
    let tint = |name: &str| tint(doc, element, name);
    let number = |name: &str, least: f64| number(doc, element, name, least);
    Ok(Some(match tag(element) {
        "emission" => Material::Emission {
            radiance: color(doc, doc.child(element, "radiance")?)?,
        },
        "mirror" => Material::Mirror {
            reflectance: tint("reflectance")?,
        },
        "glossy" => Material::Glossy {
            reflectance: tint("reflectance")?,
            shininess: number("shininess", 0.0)?,
        },
        "refraction" => Material::Refraction {
            transmittance: tint("transmittance")?,
            roughness: roughness(doc, element)?,
            ior: number("ior", f64::MIN_POSITIVE)?,
        },
        "glass" => Material::Glass {
            reflectance: tint("reflectance")?,
            transmittance: tint("transmittance")?,
            roughness: roughness(doc, element)?,
            ior: number("ior", f64::MIN_POSITIVE)?,
        },
        _ => return Ok(None),
    }))
}

/// The diffuse colour or texture of the common profile.
fn common_material<'a>(
    doc: &Document<'a>,
    instance: Element<'a>,
    effect: Element<'a>,
) -> Result<TexturedMaterial, SceneError> {
    let technique = descendant(effect, &["profile_COMMON", "technique"]);
    let shader = technique.and_then(|technique| {
        children(technique).find(|shader| matches!(tag(*shader), "phong" | "lambert" | "blinn"))
    });
    let diffuse = shader.and_then(|shader| child(shader, "diffuse"));
    if let Some(shader) = shader {
        warn_of_transparency(doc, shader);
    }
    if let Some(texture) = diffuse.and_then(|diffuse| child(diffuse, "texture")) {
        return Ok(match texture::file(doc, effect, texture)? {
            Some(file) => TexturedMaterial {
                material: Material::Diffuse {
                    reflectance: Spectrum::WHITE,
                },
                texture: Some(file),
            },
            None => TexturedMaterial::DEFAULT,
        });
    }
    let color_element = diffuse.and_then(|diffuse| {
        let param = child(diffuse, "param");
        child(diffuse, "color").or(param.and_then(|p| parameter::color(instance, effect, p)))
    });
    let Some(color_element) = color_element else {
        let title = format!("{} has no diffuse colour", describe(effect));
        let expected = "expected <color> in <diffuse> of phong, lambert or blinn";
        doc.on(diffuse.or(shader).unwrap_or(effect), title, expected)
            .help("using grey, 0.5 0.5 0.5")
            .warn();
        return Ok(TexturedMaterial::DEFAULT);
    };
    if let Some(emission) = shader.and_then(|shader| descendant(shader, &["emission", "color"]))
        && !color(doc, emission)?.is_black()
    {
        let title = "the emission of the common profile is ignored";
        doc.on(emission, title, "this surface emits no light")
            .help("write <extra><technique profile=\"CGL\"><emission><radiance> in the effect")
            .warn();
    }
    Ok(TexturedMaterial::from(Material::Diffuse {
        reflectance: clamped_color(doc, color_element)?,
    }))
}

/// Warns if parts of a surface are meant to be transparent, or all of it to some degree. Exporters
/// do not agree whether an opaque surface has the opacity 0 or 1, so neither is told.
fn warn_of_transparency<'a>(doc: &Document<'a>, shader: Element<'a>) {
    let transparent = child(shader, "transparent");
    let texture = transparent.and_then(|transparent| child(transparent, "texture"));
    let numbers = |element: Option<Element<'a>>, name: &str| {
        let number = element.and_then(|element| child(element, name));
        number.and_then(|number| floats(doc, number).ok())
    };
    let transparency =
        numbers(child(shader, "transparency"), "float").and_then(|list| list.first().copied());
    let color = numbers(transparent, "color").filter(|list| list.len() == 4);
    let is_alpha = transparent
        .and_then(|transparent| transparent.attribute("opaque"))
        .is_none_or(|opaque| opaque.starts_with("A_"));
    let strengths = match &color {
        None => &[1.0][..],
        Some(color) if is_alpha => &color[3..],
        Some(color) => &color[..3],
    };
    let is_partial = |strength: &f64| {
        let opacity = strength * transparency.unwrap_or(1.0);
        (0.01..=0.99).contains(&opacity)
    };
    if texture.is_none() && !strengths.iter().any(is_partial) {
        return;
    }
    let place = texture.or(transparent).unwrap_or(shader);
    let title = "the transparency of the common profile is ignored";
    doc.on(place, title, "this surface is opaque")
        .help("for glass write <extra><technique profile=\"CGL\"><glass> in the effect")
        .warn();
}

/// Reads a colour: red, green and blue, none negative. A fourth number, alpha, is ignored.
pub(super) fn color<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Spectrum, SceneError> {
    let numbers = floats(doc, element)?;
    let (3 | 4) = numbers.len() else {
        let title = format!("{} has {} numbers", describe(element), numbers.len());
        return Err(doc
            .on(element, title, "expected red, green and blue")
            .help("write three numbers, such as 0.8 0.8 0.8")
            .into());
    };
    let [r, g, b] = [numbers[0], numbers[1], numbers[2]];
    if r.min(g).min(b) < 0.0 {
        let title = format!("{} has a negative channel: {r} {g} {b}", describe(element));
        return Err(doc
            .on(element, title, "expected numbers >= 0")
            .help("light cannot be negative: write 0 or more")
            .into());
    }
    Ok(Spectrum::new(r, g, b))
}

/// Reads a reflectance or transmittance. Channels above 1 are clamped to 1, with a warning.
fn clamped_color<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Spectrum, SceneError> {
    let given = color(doc, element)?;
    if given.max_channel() > 1.0 {
        let title = format!("{} has a channel above 1", describe(element));
        let result = "expected at most 1; larger channels are clamped to 1";
        doc.on(element, title, result).warn();
    }
    Ok(Spectrum::new(
        given.r.min(1.0),
        given.g.min(1.0),
        given.b.min(1.0),
    ))
}

/// A reflectance or transmittance of a course material. If it is missing: 1, with a warning.
fn tint<'a>(doc: &Document<'a>, material: Element<'a>, name: &str) -> Result<Spectrum, SceneError> {
    match child(material, name) {
        Some(element) => clamped_color(doc, element),
        None => {
            let title = format!("<{}> has no <{name}>", tag(material));
            let result = format!("expected <{name}>; using 1 1 1");
            doc.on(material, title, result).warn();
            Ok(Spectrum::WHITE)
        }
    }
}

/// The roughness of a course material. If it is missing: 0, a smooth surface.
fn roughness<'a>(doc: &Document<'a>, material: Element<'a>) -> Result<f64, SceneError> {
    match child(material, "roughness") {
        Some(_) => number(doc, material, "roughness", 0.0),
        None => Ok(0.0),
    }
}

fn number<'a>(
    doc: &Document<'a>,
    material: Element<'a>,
    name: &str,
    least: f64,
) -> Result<f64, SceneError> {
    let element = doc.child(material, name)?;
    let [number] = exactly(doc, element, name)?;
    if number < least {
        let bound = if least > 0.0 { "> 0" } else { ">= 0" };
        return Err(doc
            .on(
                element,
                format!("{name} is {number}"),
                format!("expected a number {bound}"),
            )
            .help(format!("correct the {name}"))
            .into());
    }
    Ok(number)
}
