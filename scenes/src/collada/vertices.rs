//! `<vertices>`: what a mesh binds together under one index; and the sources that inputs refer to.

use super::document::{Document, Element, children, describe, tag};
use super::source::vectors;
use crate::diagnostic::SceneError;
use kit::Vec3;
use roxmltree::NodeId;
use std::collections::HashMap;
use std::rc::Rc;

/// Points or directions, and the element they were read from.
pub(super) struct Vectors<'a> {
    pub(super) element: Element<'a>,
    pub(super) values: Vec<Vec3>,
}

/// The sources that were read so far: several inputs may refer to one.
#[derive(Default)]
pub(super) struct Sources<'a> {
    read: HashMap<NodeId, Rc<Vectors<'a>>>,
}

impl<'a> Sources<'a> {
    /// The vectors that an `<input>` refers to.
    pub(super) fn of(
        &mut self,
        doc: &Document<'a>,
        input: Element<'a>,
    ) -> Result<Rc<Vectors<'a>>, SceneError> {
        let element = doc.target(input, "source", "source")?;
        if let Some(vectors) = self.read.get(&element.id()) {
            return Ok(Rc::clone(vectors));
        }
        let values = vectors(doc, element)?;
        let vectors = Rc::new(Vectors { element, values });
        self.read.insert(element.id(), Rc::clone(&vectors));
        Ok(vectors)
    }
}

/// A `<vertices>` element.
pub(super) struct Vertices<'a> {
    pub(super) element: Element<'a>,
    pub(super) positions: Rc<Vectors<'a>>,
    pub(super) normals: Option<Rc<Vectors<'a>>>,
}

impl<'a> Vertices<'a> {
    pub(super) fn read(
        doc: &Document<'a>,
        element: Element<'a>,
        sources: &mut Sources<'a>,
    ) -> Result<Vertices<'a>, SceneError> {
        let mut positions = None;
        let mut normals = None;
        for input in children(element).filter(|child| tag(*child) == "input") {
            match doc.attribute(input, "semantic")? {
                "POSITION" => positions = Some(sources.of(doc, input)?),
                "NORMAL" => normals = Some(sources.of(doc, input)?),
                _ => {}
            }
        }
        match positions {
            Some(positions) => Ok(Vertices {
                element,
                positions,
                normals,
            }),
            None => Err(doc
                .on(
                    element,
                    format!("{} has no positions", describe(element)),
                    "expected <input semantic=\"POSITION\" source=\"#...\"/>",
                )
                .help("name the source that holds the vertices' coordinates")
                .into()),
        }
    }
}
