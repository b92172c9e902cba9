//! `<light>`: the lights of COLLADA, and the area light of the course's extension.
//!
//! Colours are used without conversion: they are the radiance of an area light and of the sky
//! (`ambient`), the radiant intensity of a point or spot light, and the irradiance of a directional
//! light. Attenuation elements are ignored: intensity falls with the squared distance anyway.
//!
//! Blender 2.80 and later write watts as the colour, and area lights as point lights; what they
//! were is in `<technique profile="blender">`. These lights are as in Cycles (`kernel/light`): of
//! *P* watts, a point or spot light has the radiant intensity *P*/(4π), an area light of area *A*
//! the radiance *P*/(4*A*), and a sun of strength *E* has the irradiance *E*.

use super::document::{
    Document, Element, child, children, course_technique, descendant, describe, tag, technique,
    text,
};
use super::material::color;
use super::numbers::exactly;
use super::transform::Affine;
use crate::diagnostic::SceneError;
use kit::{Light, Spectrum, Vec3};
use std::f64::consts::PI;

/// A light in local space: at the origin, emitting along -z.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalLight {
    kind: Kind,
    color: Spectrum,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// The rectangle of this size around the origin in the plane z = 0, emitting to -z only.
    Area {
        size: [f64; 2],
        /// Whether the colour is its power, as in Cycles, not its radiance.
        is_power: bool,
    },
    Point,
    Spot {
        falloff_angle: f64,
        falloff_exponent: f64,
    },
    Directional,
    Ambient,
}

/// Numbers of Blender for a type of light, and for shapes of area lights (`DNA_light_types.h`).
const AREA: f64 = 4.0;
const RECTANGLE: f64 = 1.0;
const DISK: f64 = 4.0;
const ELLIPSE: f64 = 5.0;

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
        "area" => Kind::Area {
            size: [1.0; 2],
            is_power: false,
        },
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
    Ok(Some(as_in_blender(doc, light, LocalLight { kind, color })))
}

/// A light of Blender as Cycles shows it; any other light as it is.
fn as_in_blender<'a>(doc: &Document<'a>, light: Element<'a>, read: LocalLight) -> LocalLight {
    let Some(technique) = technique(light, &["blender"]).filter(|_| is_in_watts(doc)) else {
        return read;
    };
    let number = |name: &str| child(technique, name).and_then(|value| text(value).parse().ok());
    let warn = |title: &str, result: &str| doc.on(light, title, result).warn();
    let intensity = read.color / (4.0 * PI);
    match read.kind {
        Kind::Point if number("type") == Some(AREA) => {
            let width: f64 = number("area_size").unwrap_or(1.0);
            let height = number("area_sizey").unwrap_or(width);
            let shape = number("area_shape").unwrap_or(0.0);
            let mut size = if [RECTANGLE, ELLIPSE].contains(&shape) {
                [width, height]
            } else {
                [width; 2]
            };
            if [DISK, ELLIPSE].contains(&shape) {
                warn("a round area light", "it is a rectangle of the same area");
                size = size.map(|edge| edge * (PI / 4.0).sqrt());
            }
            let is_power = true;
            LocalLight {
                kind: Kind::Area { size, is_power },
                ..read
            }
        }
        Kind::Point => LocalLight {
            color: intensity,
            ..read
        },
        Kind::Spot { falloff_angle, .. } => {
            if number("spotblend").is_some_and(|blend: f64| blend > 0.0) {
                let result = "it lights its whole cone evenly";
                warn("a spot light with a soft edge", result);
            }
            let kind = Kind::Spot {
                falloff_angle,
                falloff_exponent: 0.0,
            };
            LocalLight {
                kind,
                color: intensity,
            }
        }
        Kind::Area { .. } | Kind::Directional | Kind::Ambient => read,
    }
}

/// Whether the file is of a version of Blender whose lights have watts: 2.80 or later.
fn is_in_watts(doc: &Document<'_>) -> bool {
    let tool = descendant(doc.root(), &["asset", "contributor", "authoring_tool"]).map(text);
    let version = |tool: String| {
        let mut numbers = tool.strip_prefix("Blender ")?.split('.');
        let mut number = || numbers.next()?.parse().ok();
        Some((number()?, number()?))
    };
    tool.and_then(version) >= Some((2_u32, 80_u32))
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
            Kind::Area { size, is_power } => {
                let edge_x = to_world.direction(Vec3::X) * size[0];
                let edge_y = to_world.direction(Vec3::Y) * size[1];
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
                    radiance: match is_power {
                        true => self.color / (4.0 * edge_x.cross(edge_y).length()),
                        false => self.color,
                    },
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
