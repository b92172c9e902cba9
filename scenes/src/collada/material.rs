//! `<material>` and `<effect>`: the materials of surfaces.
//!
//! The materials of the course's extension are in `<extra><technique profile="CGL">` of the effect:
//! `emission{radiance}`, `mirror{reflectance}`, `glossy{reflectance, shininess}`,
//! `glass{reflectance, transmittance, roughness, ior}`,
//! `refraction{transmittance, roughness, ior}`. Otherwise `phong`, `lambert` or `blinn` is read. A
//! surface has one material here, so the strongest of three parts is used, by its largest channel:
//!
//! - `diffuse`, a colour or a texture: a diffuse surface. A texture counts as white.
//! - `reflective` times `reflectivity`: a mirror. A missing factor is 1 if the other one exists.
//! - `specular` with `shininess`: a glossy surface, only if nothing else reflects: a highlight is
//!   not meant to reflect the scene.
//!
//! The other parts are left out, with one warning per material. `specular` 0.5 with `shininess` 50
//! is ignored without one: Blender wrote it for every material. So is a part of at most a tenth.

use super::document::{
    Document, Element, child, children, course_technique, descendant, describe, tag,
};
use super::numbers::{exactly, floats};
use super::parameter::EffectInstance;
use super::texture::{self, TextureImage};
use crate::diagnostic::SceneError;
use kit::{Material, Spectrum};

/// A material and its texture, as described by a `<material>` element.
pub(super) struct TexturedMaterial<'a> {
    pub(super) material: Material,
    pub(super) texture: Option<TextureImage<'a>>,
}

impl TexturedMaterial<'_> {
    /// The default grey, for surfaces without a usable material.
    pub(super) const DEFAULT: TexturedMaterial<'static> = TexturedMaterial {
        material: Material::Diffuse {
            reflectance: Spectrum::grey(0.5),
        },
        texture: None,
    };
}

impl From<Material> for TexturedMaterial<'_> {
    fn from(material: Material) -> Self {
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
) -> Result<TexturedMaterial<'a>, SceneError> {
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
    common_material(doc, &EffectInstance { effect, instance })
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

/// The material of the common profile: the strongest of its parts.
fn common_material<'a>(
    doc: &Document<'a>,
    effect: &EffectInstance<'a>,
) -> Result<TexturedMaterial<'a>, SceneError> {
    let technique = descendant(effect.effect, &["profile_COMMON", "technique"]);
    let shader = technique.and_then(|technique| {
        children(technique)
            .find(|shader| matches!(tag(*shader), "phong" | "lambert" | "blinn" | "constant"))
    });
    let diffuse = shader.and_then(|shader| child(shader, "diffuse"));
    let gloss = match shader {
        Some(shader) => {
            warn_of_emission(doc, effect, shader);
            warn_of_transparency(doc, effect, shader);
            Gloss::read(doc, effect, shader)
        }
        None => Gloss::default(),
    };
    if let Some(texture) = diffuse.and_then(|diffuse| child(diffuse, "texture")) {
        gloss.warn_if_strong(doc);
        let texture = texture::image(doc, effect, texture)?;
        return Ok(match texture {
            Some(_) => TexturedMaterial {
                material: Material::Diffuse {
                    reflectance: Spectrum::WHITE,
                },
                texture,
            },
            None => TexturedMaterial::DEFAULT,
        });
    }
    let color_element = diffuse.and_then(|diffuse| effect.value(diffuse, COLORS));
    let reflectance = match color_element {
        Some(element) => clamped_color(doc, element)?,
        None => Spectrum::BLACK,
    };
    if let Some(material) = gloss.material(reflectance) {
        if let Some(diffuse) = diffuse.filter(|_| reflectance.max_channel() > VISIBLE) {
            let title = "the diffuse colour is ignored: the surface is a mirror";
            doc.on(diffuse, title, "weaker than the reflection").warn();
        }
        return Ok(material.into());
    }
    gloss.warn_if_strong(doc);
    if color_element.is_none() {
        let title = format!("{} has no diffuse colour", describe(effect.effect));
        let expected = "expected <color> in <diffuse> of phong, lambert or blinn";
        doc.on(diffuse.or(shader).unwrap_or(effect.effect), title, expected)
            .help("using grey, 0.5 0.5 0.5")
            .warn();
        return Ok(TexturedMaterial::DEFAULT);
    }
    Ok(TexturedMaterial::from(Material::Diffuse { reflectance }))
}

/// The tags of a colour: in a property of a shader, and as the value of a parameter.
const COLORS: &[&str] = &["color", "float4", "float3"];

/// The strength above which a part of a material is visible.
const VISIBLE: f64 = 0.1;

/// What the common profile has beside the diffuse colour: a mirror, and a highlight.
#[derive(Default)]
struct Gloss<'a> {
    mirror: Spectrum,
    highlight: Spectrum,
    shininess: f64,
    /// The elements of the mirror and of the highlight.
    elements: [Option<Element<'a>>; 2],
}

impl<'a> Gloss<'a> {
    fn read(doc: &Document<'a>, effect: &EffectInstance<'a>, shader: Element<'a>) -> Gloss<'a> {
        let ignored = |error: SceneError| doc.warn_of(error, "this property is ignored");
        let property = |name: &str| child(shader, name);
        let [reflective, reflectivity] = ["reflective", "reflectivity"].map(property);
        let [specular, shininess] = ["specular", "shininess"].map(property);
        let colored = |property: Option<Element<'a>>| {
            let property = property?;
            match effect.value(property, COLORS) {
                Some(element) => color(doc, element).map_err(ignored).map(at_most_one).ok(),
                // A texture, such as an environment map, counts as white.
                None => child(property, "texture").map(|_| Spectrum::WHITE),
            }
        };
        let number = |property: Option<Element<'a>>| {
            let element = effect.value(property?, &["float"])?;
            let number = exactly(doc, element, "a number").map_err(ignored);
            number.ok().map(|[number]| number)
        };
        let mirror = match (colored(reflective), number(reflectivity)) {
            (None, None) => Spectrum::BLACK,
            (color, amount) => {
                color.unwrap_or(Spectrum::WHITE) * amount.unwrap_or(1.0).clamp(0.0, 1.0)
            }
        };
        let highlight = colored(specular).unwrap_or(Spectrum::BLACK);
        let shininess = number(shininess).unwrap_or(0.0).max(0.0);
        let is_default = highlight == Spectrum::grey(0.5) && shininess == 50.0;
        Gloss {
            mirror,
            highlight: if is_default {
                Spectrum::BLACK
            } else {
                highlight
            },
            shininess,
            elements: [reflective.or(reflectivity), specular],
        }
    }

    /// The mirror or the glossy surface that reflects more than a surface of this diffuse
    /// `reflectance`, if either does.
    fn material(&self, reflectance: Spectrum) -> Option<Material> {
        let strength = self.mirror.max_channel();
        if strength > VISIBLE && strength > reflectance.max_channel() {
            return Some(Material::Mirror {
                reflectance: self.mirror,
            });
        }
        let is_glossy = reflectance.is_black() && self.highlight.max_channel() > VISIBLE;
        is_glossy.then_some(Material::Glossy {
            reflectance: self.highlight,
            shininess: self.shininess,
        })
    }

    /// Warns if the mirror or the highlight is visible: the surface is diffuse.
    fn warn_if_strong(&self, doc: &Document<'a>) {
        let [mirror, highlight] = self.elements;
        let parts = [
            (self.mirror, mirror, "the reflection"),
            (self.highlight, highlight, "the highlight"),
        ];
        let mut strong = parts
            .iter()
            .filter(|(color, ..)| color.max_channel() > VISIBLE);
        if let Some((_, Some(element), what)) = strong.next() {
            let title = format!("{what} of the common profile is ignored");
            doc.on(*element, title, "this surface is diffuse")
                .help("write <extra><technique profile=\"CGL\"> with <mirror> or <glossy> in the effect")
                .warn();
        }
    }
}

/// Warns if a surface emits light, with a colour or a texture.
fn warn_of_emission<'a>(doc: &Document<'a>, effect: &EffectInstance<'a>, shader: Element<'a>) {
    let Some(emission) = child(shader, "emission") else {
        return;
    };
    let of_color = effect.value(emission, COLORS).filter(|element| {
        let color = color(doc, *element);
        color.map_or(true, |color| !color.is_black())
    });
    if let Some(place) = of_color.or(child(emission, "texture")) {
        let title = "the emission of the common profile is ignored";
        doc.on(place, title, "this surface emits no light")
            .help("write <extra><technique profile=\"CGL\"><emission><radiance> in the effect")
            .warn();
    }
}

/// Warns if a surface is transparent: in parts, to some degree, or as a whole by the standard.
/// Exporters do not agree whether an opaque surface has the opacity 0 or 1, so a surface without
/// opacity is shown opaque, too.
fn warn_of_transparency<'a>(doc: &Document<'a>, effect: &EffectInstance<'a>, shader: Element<'a>) {
    let transparent = child(shader, "transparent");
    let texture = transparent.and_then(|transparent| child(transparent, "texture"));
    let numbers = |element: Option<Element<'a>>, tags: &[&str]| {
        let number = element.and_then(|element| effect.value(element, tags));
        number.and_then(|number| floats(doc, number).ok())
    };
    let transparency = child(shader, "transparency");
    let amount = numbers(transparency, &["float"]).and_then(|list| list.first().copied());
    let color = numbers(transparent, COLORS).filter(|list| list.len() == 4);
    let written = transparent.and_then(|transparent| transparent.attribute("opaque"));
    let mode = written.unwrap_or("A_ONE");
    let strengths = match &color {
        None => &[1.0][..],
        Some(color) if mode.starts_with("A_") => &color[3..],
        Some(color) => &color[..3],
    };
    let opacities = strengths.iter().map(|strength| {
        let given = strength * amount.unwrap_or(1.0);
        // Without a colour it is not known which of them the number is.
        if mode.ends_with("_ZERO") && color.is_some() {
            1.0 - given
        } else {
            given
        }
    });
    let mut is_partial = texture.is_some();
    let mut is_invisible = true;
    for opacity in opacities {
        is_partial |= (0.01..=0.99).contains(&opacity);
        is_invisible &= opacity < 0.01;
    }
    let title = match (is_partial, is_invisible) {
        (true, _) => "the transparency of the common profile is ignored",
        (false, true) => "a surface without opacity is shown opaque",
        (false, false) => return,
    };
    let place = texture.or(transparent).or(transparency).unwrap_or(shader);
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
    Ok(at_most_one(given))
}

fn at_most_one(color: Spectrum) -> Spectrum {
    Spectrum::new(color.r.min(1.0), color.g.min(1.0), color.b.min(1.0))
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
        Some(element) => {
            let roughness = number(doc, material, "roughness", 0.0)?;
            if roughness > 1.0 {
                let title = format!("roughness is {roughness}");
                doc.on(element, title, "expected 0 to 1; using 1").warn();
            }
            Ok(roughness.min(1.0))
        }
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
