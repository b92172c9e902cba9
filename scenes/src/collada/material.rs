//! `<material>` and `<effect>`: what surfaces are made of.
//!
//! The course's own materials stand in `<extra><technique profile="CGL">` of the effect:
//! `emission{radiance}`, `mirror{reflectance}`, `glossy{reflectance, shininess}`,
//! `glass{reflectance, transmittance, roughness, ior}`, `refraction{transmittance, roughness, ior}`.
//! Without one of them the diffuse colour, or picture, of `phong`, `lambert` or `blinn` counts.

use super::document::{
    Document, Element, child, children, course_technique, descend, describe, tag,
};
use super::numbers::{exactly, floats};
use super::texture;
use crate::diagnostic::SceneError;
use kit::{Material, Spectrum};

/// What a `<material>` element says of a surface.
pub(super) struct Finish {
    pub(super) material: Material,
    /// The file of the picture that tints it.
    pub(super) picture: Option<String>,
}

impl Finish {
    /// The grey of surfaces that have no usable material.
    pub(super) const DEFAULT: Finish = Finish {
        material: Material::Diffuse {
            reflectance: Spectrum::grey(0.5),
        },
        picture: None,
    };
}

impl From<Material> for Finish {
    fn from(material: Material) -> Finish {
        Finish {
            material,
            picture: None,
        }
    }
}

/// Reads the material that a `<material>` element names.
pub(super) fn read<'a>(doc: &Document<'a>, material: Element<'a>) -> Result<Finish, SceneError> {
    let instance = doc.child(material, "instance_effect")?;
    let effect = doc.target(instance, "url", "effect")?;
    if let Some(technique) = course_technique(effect) {
        match children(technique).next() {
            Some(element) => return course_material(doc, element).map(Finish::from),
            None => doc.warn(|| {
                let expected = "expected emission, mirror, glossy, glass or refraction";
                doc.on(technique, "the technique names no material", expected)
                    .help("the common profile of the effect is taken instead")
            }),
        }
    }
    common_material(doc, effect)
}

fn course_material<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Material, SceneError> {
    let tint = |name: &str| tint(doc, element, name);
    let number = |name: &str, least: f64| number(doc, element, name, least);
    Ok(match tag(element) {
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
        other => {
            return Err(doc
                .on(
                    element,
                    format!("<{other}> is not a material"),
                    "expected emission, mirror, glossy, glass or refraction",
                )
                .help("for a matte surface leave the <extra> out and give a diffuse colour")
                .into());
        }
    })
}

/// The diffuse colour or picture of the common profile.
fn common_material<'a>(doc: &Document<'a>, effect: Element<'a>) -> Result<Finish, SceneError> {
    let technique = descend(effect, &["profile_COMMON", "technique"]);
    let shader = technique.and_then(|technique| {
        children(technique).find(|shader| matches!(tag(*shader), "phong" | "lambert" | "blinn"))
    });
    let diffuse = shader.and_then(|shader| child(shader, "diffuse"));
    if let Some(texture) = diffuse.and_then(|diffuse| child(diffuse, "texture")) {
        return Ok(match texture::file(doc, effect, texture)? {
            Some(file) => Finish {
                material: Material::Diffuse {
                    reflectance: Spectrum::WHITE,
                },
                picture: Some(file),
            },
            None => Finish::DEFAULT,
        });
    }
    let Some(diffuse) = diffuse.and_then(|diffuse| child(diffuse, "color")) else {
        doc.warn(|| {
            let title = format!("{} has no diffuse colour", describe(effect));
            let at = diffuse.or(shader).unwrap_or(effect);
            doc.on(
                at,
                title,
                "expected <color> in <diffuse> of phong, lambert or blinn",
            )
            .help("taken as grey, 0.5 0.5 0.5")
        });
        return Ok(Finish::DEFAULT);
    };
    if let Some(emission) = shader.and_then(|shader| descend(shader, &["emission", "color"]))
        && !color(doc, emission)?.is_black()
    {
        doc.warn(|| {
            doc.on(
                emission,
                "the emission of the common profile is passed over",
                "gives no light",
            )
            .help("write <extra><technique profile=\"CGL\"><emission><radiance> in the effect")
        });
    }
    Ok(Finish::from(Material::Diffuse {
        reflectance: share(doc, diffuse)?,
    }))
}

/// Red, green and blue, none negative. A fourth number, alpha, is passed over.
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
            .help("light cannot be less than none: write 0 or more")
            .into());
    }
    Ok(Spectrum::new(r, g, b))
}

/// A colour that says which share of light goes on: channels above 1 are cut to 1, with a warning.
fn share<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Spectrum, SceneError> {
    let given = color(doc, element)?;
    if given.max_channel() > 1.0 {
        doc.warn(|| {
            let title = format!("{} gives back more light than it gets", describe(element));
            doc.on(
                element,
                title,
                "expected at most 1; channels above it are taken as 1",
            )
        });
    }
    Ok(Spectrum::new(
        given.r.min(1.0),
        given.g.min(1.0),
        given.b.min(1.0),
    ))
}

/// A share inside a course material; without it all light goes on, with a warning.
fn tint<'a>(doc: &Document<'a>, material: Element<'a>, name: &str) -> Result<Spectrum, SceneError> {
    match child(material, name) {
        Some(element) => share(doc, element),
        None => {
            doc.warn(|| {
                let title = format!("<{}> has no <{name}>", tag(material));
                doc.on(
                    material,
                    title,
                    format!("expected <{name}>; taken as 1 1 1"),
                )
            });
            Ok(Spectrum::WHITE)
        }
    }
}

/// Smooth if the file does not say.
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
