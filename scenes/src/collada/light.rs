//! `<light>`: the lights of COLLADA, and the area light of the course's extension.
//!
//! Colours are used without conversion: they are the radiance of an area light and of the sky
//! (`ambient`), the radiant intensity of a point or spot light, and the irradiance of a directional
//! light. Attenuation elements are ignored: intensity falls with the squared distance anyway.

use super::document::{Document, Element, child, children, course_technique, describe, tag};
use super::material::color;
use super::numbers::exactly;
use super::transform::Affine;
use crate::diagnostic::SceneError;
use kit::{Light, Spectrum, Vec3};

/// A light in local space: at the origin, emitting along -z.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalLight {
    kind: Kind,
    color: Spectrum,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// The square |x|, |y| <= 1/2 in the plane z = 0, emitting to -z only.
    Area,
    Point,
    Spot {
        falloff_angle: f64,
        falloff_exponent: f64,
    },
    Directional,
    Ambient,
}

/// Opening angle of a spot light without `<falloff_angle>`, in degrees (COLLADA 1.4.1).
const DEFAULT_FALLOFF_ANGLE: f64 = 180.0;

/// Reads a light. `None`, with a warning, if its type is unknown.
pub(super) fn read<'a>(
    doc: &Document<'a>,
    light: Element<'a>,
) -> Result<Option<LocalLight>, SceneError> {
    let technique = course_technique(light).or_else(|| child(light, "technique_common"));
    let expected = "expected area, point, spot, directional or ambient; it is ignored";
    let Some(element) = technique.and_then(|technique| children(technique).next()) else {
        let title = format!("{} has no light type", describe(light));
        doc.on(light, title, expected).warn();
        return Ok(None);
    };
    let kind = match tag(element) {
        "area" => Kind::Area,
        "point" => Kind::Point,
        "spot" => Kind::Spot {
            falloff_angle: falloff_angle(doc, element)?,
            falloff_exponent: falloff_exponent(doc, element)?,
        },
        "directional" => Kind::Directional,
        "ambient" => Kind::Ambient,
        other => {
            let title = format!("<{other}> is not a light type");
            doc.on(element, title, expected).warn();
            return Ok(None);
        }
    };
    let color = color(doc, doc.child(element, "color")?)?;
    Ok(Some(LocalLight { kind, color }))
}

fn falloff_angle<'a>(doc: &Document<'a>, spot: Element<'a>) -> Result<f64, SceneError> {
    let Some(element) = child(spot, "falloff_angle") else {
        return Ok(DEFAULT_FALLOFF_ANGLE);
    };
    let [angle] = exactly(doc, element, "degrees")?;
    if angle > 0.0 && angle <= DEFAULT_FALLOFF_ANGLE {
        return Ok(angle);
    }
    let title = format!("the opening angle is {angle} degrees");
    let finding = doc.on(element, title, "expected more than 0 and at most 180");
    if angle > DEFAULT_FALLOFF_ANGLE {
        // assimp writes 360 for a light that it does not know the angle of.
        finding.help("using 180").warn();
        return Ok(DEFAULT_FALLOFF_ANGLE);
    }
    Err(finding
        .help("write the full opening angle of the cone, in degrees")
        .into())
}

fn falloff_exponent<'a>(doc: &Document<'a>, spot: Element<'a>) -> Result<f64, SceneError> {
    let Some(element) = child(spot, "falloff_exponent") else {
        return Ok(0.0);
    };
    let [exponent] = exactly(doc, element, "the exponent")?;
    if exponent >= 0.0 {
        return Ok(exponent);
    }
    Err(doc
        .on(
            element,
            format!("the exponent is {exponent}"),
            "expected a number >= 0",
        )
        .help("0 gives a uniform cone, larger exponents a narrower one")
        .into())
}

impl LocalLight {
    /// The light in world space. `None` if it has no direction or no area after the transform.
    ///
    /// An area light emits to the side of the transformed -z, also if the transform shears or
    /// mirrors.
    pub(super) fn place(&self, to_world: &Affine) -> Option<Light> {
        let axis = to_world.direction(Vec3::NEG_Z);
        let position = to_world.t;
        Some(match self.kind {
            Kind::Area => {
                let edge_x = to_world.direction(Vec3::X);
                let edge_y = to_world.direction(Vec3::Y);
                let normal = edge_x
                    .try_normalize()?
                    .cross(edge_y.try_normalize()?)
                    .try_normalize()?;
                Light::Area {
                    center: position,
                    edge_x,
                    edge_y,
                    direction: if normal.dot(axis) >= 0.0 {
                        normal
                    } else {
                        -normal
                    },
                    radiance: self.color,
                }
            }
            Kind::Point => Light::Point {
                position,
                intensity: self.color,
            },
            Kind::Spot {
                falloff_angle,
                falloff_exponent,
            } => Light::Spot {
                position,
                direction: axis.try_normalize()?,
                intensity: self.color,
                falloff_angle,
                falloff_exponent,
            },
            Kind::Directional => Light::Directional {
                direction: axis.try_normalize()?,
                irradiance: self.color,
            },
            Kind::Ambient => Light::Hemisphere {
                radiance: self.color,
            },
        })
    }
}
