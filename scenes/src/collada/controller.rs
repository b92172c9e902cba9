//! `<controller>`: a mesh that joints or blend shapes deform. It is read without the deformation,
//! where the first joint of a skin places it.

use super::document::{Document, Element, child, children, describe, tag, text};
use super::numbers::floats;
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
    /// transform it: `<bind_shape_matrix>`, then the inverse matrix of a joint, then the joint. In
    /// the bind pose all joints place it alike. Without joints, `<bind_shape_matrix>` is left.
    pub(super) bind_shape: Option<Affine>,
}

/// Follows the sources of the controller of `instance` to its `<geometry>`. `None`, with a warning,
/// if it has none.
pub(super) fn read<'a>(
    doc: &Document<'a>,
    instance: Element<'a>,
    controller: Element<'a>,
) -> Result<Option<ControlledMesh<'a>>, SceneError> {
    let (mut bind_shape, mut has_joint) = (None, false);
    let mut current = controller;
    for _ in 0..MAX_CHAIN {
        let Some(deformer) = children(current).find(|e| matches!(tag(*e), "skin" | "morph")) else {
            break;
        };
        if tag(deformer) == "skin" && bind_shape.is_none() {
            let joint = first_joint(doc, deformer, instance);
            has_joint = joint.is_some();
            bind_shape = Some(
                joint
                    .unwrap_or(Affine::IDENTITY)
                    .after(&bind_shape_matrix(doc, deformer)?),
            );
        }
        let title = format!("<{}> does not deform its mesh", tag(deformer));
        let result = match tag(deformer) {
            "skin" if has_joint => {
                "joints are not supported; the mesh is placed as a whole by its first joint"
            }
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

/// The path from the bind pose to the visual scene by the first joint of a skin. `None` if its
/// name, its node or its inverse matrix cannot be found.
fn first_joint<'a>(doc: &Document<'a>, skin: Element<'a>, instance: Element<'a>) -> Option<Affine> {
    let list = |semantic: &str| {
        let mut inputs = children(child(skin, "joints")?);
        let input = inputs.find(|input| input.attribute("semantic") == Some(semantic))?;
        let source = doc.find(input.attribute("source")?, "source")?;
        children(source).find(|list| tag(*list).ends_with("_array"))
    };
    let names = text(list("JOINT")?);
    let name = names.split_whitespace().next()?;
    let inverse = floats(doc, list("INV_BIND_MATRIX")?).ok()?;
    let skeletons = children(instance).filter(|part| tag(*part) == "skeleton");
    let roots = skeletons.filter_map(|skeleton| doc.find(&text(skeleton), "node"));
    let mut nodes = roots.flat_map(|root| root.descendants());
    let joint =
        nodes.find(|node| [node.attribute("sid"), node.attribute("id")].contains(&Some(name)))?;
    let path = joint.ancestors().take_while(|node| tag(*node) == "node");
    let transforms = path.map(|node| transform::of_node(doc, node));
    let to_scene = transforms
        .reduce(|inner, outer| Ok(outer?.after(&inner?)))?
        .ok()?;
    (inverse.len() >= 16).then(|| to_scene.after(&Affine::of_rows(&inverse)))
}
