//! `<vertices>`: the inputs that share one index; and the sources that inputs refer to.

use super::document::{Document, Element, children, describe, tag};
use super::source::{pairs, vectors};
use crate::diagnostic::SceneError;
use kit::{Vec2, Vec3};
use roxmltree::NodeId;
use std::collections::HashMap;
use std::rc::Rc;

/// Points, directions or texture coordinates, and the element from which they were read.
pub(super) struct Vectors<'a, T = Vec3> {
    pub(super) element: Element<'a>,
    pub(super) values: Vec<T>,
}

/// The sources that were read so far. Several inputs may refer to the same source.
#[derive(Default)]
pub(super) struct Sources<'a> {
    vectors: HashMap<NodeId, Rc<Vectors<'a>>>,
    pairs: HashMap<NodeId, Rc<Vectors<'a, Vec2>>>,
}

impl<'a> Sources<'a> {
    /// The vectors that an `<input>` refers to.
    pub(super) fn of(
        &mut self,
        doc: &Document<'a>,
        input: Element<'a>,
    ) -> Result<Rc<Vectors<'a>>, SceneError> {
        let element = doc.target(input, "source", "source")?;
        get_or_read(&mut self.vectors, element, || vectors(doc, element))
    }

    /// The texture coordinates that an `<input>` refers to.
    pub(super) fn pairs_of(
        &mut self,
        doc: &Document<'a>,
        input: Element<'a>,
    ) -> Result<Rc<Vectors<'a, Vec2>>, SceneError> {
        let element = doc.target(input, "source", "source")?;
        get_or_read(&mut self.pairs, element, || pairs(doc, element))
    }
}

/// The cached values of `element`, or the result of `read`, which is then cached.
fn get_or_read<'a, T>(
    cache: &mut HashMap<NodeId, Rc<Vectors<'a, T>>>,
    element: Element<'a>,
    read: impl FnOnce() -> Result<Vec<T>, SceneError>,
) -> Result<Rc<Vectors<'a, T>>, SceneError> {
    if let Some(vectors) = cache.get(&element.id()) {
        return Ok(Rc::clone(vectors));
    }
    let values = read()?;
    let vectors = Rc::new(Vectors { element, values });
    cache.insert(element.id(), Rc::clone(&vectors));
    Ok(vectors)
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
                .help("refer to the source with the coordinates of the vertices")
                .into()),
        }
    }
}
