//! `<geometry>`: a mesh, or a sphere of the course's extension.

use super::document::{Document, Element, child, children, course_technique, describe, tag};
use super::mesh::{MeshPart, MeshReader};
use super::numbers::exactly;
use crate::diagnostic::SceneError;

/// The shape of a geometry, in local space.
#[derive(Debug)]
pub(super) enum Shape<'a> {
    /// Triangles, grouped by material.
    Mesh(Vec<MeshPart<'a>>),
    /// A sphere around the origin.
    Sphere { radius: f64 },
    /// No supported shape; a warning was added.
    Nothing,
}

/// Reads a geometry. A `<sphere>` in `<extra>`, the course's extension, has priority.
pub(super) fn read<'a>(
    doc: &Document<'a>,
    geometry: Element<'a>,
    meshes: &mut MeshReader<'a>,
) -> Result<Shape<'a>, SceneError> {
    if let Some(technique) = course_technique(geometry) {
        if let Some(sphere) = child(technique, "sphere") {
            return read_sphere(doc, sphere);
        }
        if let Some(other) = children(technique).next() {
            let title = format!("<{}> is not a shape", tag(other));
            doc.on(other, title, "expected <sphere>; it is ignored")
                .warn();
        }
    }
    if let Some(mesh) = child(geometry, "mesh") {
        return Ok(Shape::Mesh(meshes.read(doc, mesh)?));
    }
    let other = children(geometry).find(|shape| !matches!(tag(*shape), "asset" | "extra"));
    let title = match other {
        Some(other) => format!("<{}> is not supported", tag(other)),
        None => format!("{} has no shape", describe(geometry)),
    };
    let expected = "expected <mesh>, or <sphere> in the profile CGL; it is ignored";
    doc.on(other.unwrap_or(geometry), title, expected).warn();
    Ok(Shape::Nothing)
}

fn read_sphere<'a>(doc: &Document<'a>, sphere: Element<'a>) -> Result<Shape<'a>, SceneError> {
    let element = doc.child(sphere, "radius")?;
    let [radius] = exactly(doc, element, "the radius")?;
    if radius < 0.0 {
        return Err(doc
            .on(
                element,
                format!("the radius is {radius}"),
                "expected a radius >= 0",
            )
            .help("remove the minus sign")
            .into());
    }
    Ok(Shape::Sphere { radius })
}
