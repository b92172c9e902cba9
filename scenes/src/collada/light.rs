//! `<light>`: the common ones, and the area light of the course's own.
//!
//! Colours are taken as they stand: radiance of an area light and of the sky (`ambient`), radiant intensity
//! of a point and a spot, irradiance of a sun (`directional`). Attenuations are passed over: light falls off
//! with the square of the distance by itself.

use super::document::{Document, Element, child, children, course_technique, describe, tag};
use super::material::color;
use super::numbers::exactly;
use super::transform::Affine;
use crate::diagnostic::SceneError;
use kit::{Light, Spectrum, Vec3};

/// A light in its own space: at the origin, shining along -z.
#[derive(Clone, Copy, Debug)]
pub(super) struct LocalLight {
    kind: Kind,
    color: Spectrum,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// The square |x|, |y| <= 1/2 in the plane z = 0, shining to -z only.
    Area,
    Point,
    Spot {
        falloff_angle: f64,
        falloff_exponent: f64,
    },
    Directional,
    Ambient,
}

/// Opening angle of a spot that does not say, in degrees (COLLADA 1.4.1).
const DEFAULT_FALLOFF_ANGLE: f64 = 180.0;

/// Reads a light; `None`, with a warning, if it is of no known kind.
pub(super) fn read<'a>(
    doc: &Document<'a>,
    light: Element<'a>,
) -> Result<Option<LocalLight>, SceneError> {
    let technique = course_technique(light).or_else(|| child(light, "technique_common"));
    let Some(element) = technique.and_then(|technique| children(technique).next()) else {
        doc.warn(|| {
            let title = format!("{} does not say what kind of light it is", describe(light));
            doc.on(
                light,
                title,
                "expected area, point, spot, directional or ambient; it is passed over",
            )
        });
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
            doc.warn(|| {
                let title = format!("<{other}> is not a kind of light");
                doc.on(
                    element,
                    title,
                    "expected area, point, spot, directional or ambient; it is passed over",
                )
            });
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
    if angle > 0.0 && angle <= 180.0 {
        return Ok(angle);
    }
    let title = format!("the opening angle is {angle} degrees");
    Err(doc
        .on(element, title, "expected more than 0 and at most 180")
        .help("the angle is the full opening of the cone, in degrees")
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
        .help("0 gives an even cone, larger exponents a narrower one")
        .into())
}

impl LocalLight {
    /// The light in world space; `None` if the transform leaves it no direction or no area.
    ///
    /// An area light's parallelogram shines to the side on which the transformed -z lies, also where the
    /// transform shears or mirrors.
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
