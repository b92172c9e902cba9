//! `<controller>`: a mesh that joints or blend shapes deform. It is read without the deformation.

use super::document::{Document, Element, child, children, describe, tag};
use super::transform::{self, Affine};
use crate::diagnostic::SceneError;

/// Longest chain of controllers, such as the skin of a morph.
const MAX_CHAIN: usize = 8;

/// The mesh of a controller.
pub(super) struct ControlledMesh<'a> {
    pub(super) geometry: Element<'a>,
    /// For a skin: from the coordinates of the mesh to those of the visual scene.
    ///
    /// A vertex of a skin is placed by its joints alone, so the node of the instance does not
    /// transform it. In the bind pose the matrices of each joint and its inverse cancel out, and
    /// `<bind_shape_matrix>` is left.
    pub(super) bind_shape: Option<Affine>,
}

/// Follows the sources of a controller to its `<geometry>`. `None`, with a warning, if it has none.
pub(super) fn read<'a>(
    doc: &Document<'a>,
    controller: Element<'a>,
) -> Result<Option<ControlledMesh<'a>>, SceneError> {
    let mut bind_shape = None;
    let mut current = controller;
    for _ in 0..MAX_CHAIN {
        let Some(deformer) = children(current).find(|e| matches!(tag(*e), "skin" | "morph")) else {
            break;
        };
        if tag(deformer) == "skin" && bind_shape.is_none() {
            bind_shape = Some(bind_shape_matrix(doc, deformer)?);
        }
        let title = format!("<{}> does not deform its mesh", tag(deformer));
        let result = match tag(deformer) {
            "skin" => "joints are not supported; the mesh is shown in the bind pose",
            _ => "blend shapes are not supported; the mesh is shown without them",
        };
        doc.on(deformer, title, result).warn();
        let source = doc.attribute(deformer, "source")?;
        if let Some(geometry) = doc.find(source, "geometry") {
            return Ok(Some(ControlledMesh {
                geometry,
                bind_shape,
            }));
        }
        match doc.find(source, "controller") {
            Some(next) => current = next,
            None => return Err(doc.unresolved(deformer, "source", "geometry").into()),
        }
    }
    let title = format!("{} has no mesh", describe(controller));
    doc.on(
        controller,
        title,
        "expected <skin> or <morph> with a mesh; it is ignored",
    )
    .warn();
    Ok(None)
}

fn bind_shape_matrix<'a>(doc: &Document<'a>, skin: Element<'a>) -> Result<Affine, SceneError> {
    match child(skin, "bind_shape_matrix") {
        Some(matrix) => transform::matrix(doc, matrix),
        None => Ok(Affine::IDENTITY),
    }
}
