//! `<vertices>`: the inputs that share one index; and the sources that inputs refer to.

use super::document::{Document, Element, children, describe, tag};
use super::numbers::integer_attribute;
use super::source::{pairs, vectors};
use crate::diagnostic::SceneError;
use kit::{Vec2, Vec3};
use roxmltree::NodeId;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

/// Points, directions or texture coordinates, and the element from which they were read.
pub(super) struct Vectors<'a, T = Vec3> {
    pub(super) element: Element<'a>,
    pub(super) values: Vec<T>,
}

impl<T> Vectors<'_, T> {
    /// The valid indices, for messages.
    pub(super) fn expected_index(&self) -> String {
        match self.values.len() {
            0 => "the source is empty".to_owned(),
            count => format!("expected 0 to {}", count - 1),
        }
    }
}

/// A set of texture coordinates and its number.
pub(super) type NumberedSet<'a> = (u64, Rc<Vectors<'a, Vec2>>);

/// The sources that were read so far. Several inputs may refer to the same source.
#[derive(Default)]
pub(super) struct Sources<'a> {
    vectors: HashMap<NodeId, Rc<Vectors<'a>>>,
    pairs: HashMap<NodeId, Rc<Vectors<'a, Vec2>>>,
    /// References to sources of normals or texture coordinates that cannot be read.
    unreadable: HashSet<&'a str>,
}

impl<'a> Sources<'a> {
    /// The positions that an `<input>` refers to.
    pub(super) fn positions(
        &mut self,
        doc: &Document<'a>,
        input: Element<'a>,
    ) -> Result<Rc<Vectors<'a>>, SceneError> {
        let element = doc.target(input, "source", "source")?;
        get_or_read(&mut self.vectors, element, || vectors(doc, element))
    }

    /// The normals that an `<input>` refers to. `None`, with a warning, if they cannot be read.
    pub(super) fn normals(
        &mut self,
        doc: &Document<'a>,
        input: Element<'a>,
    ) -> Option<Rc<Vectors<'a>>> {
        let result = "normals are computed from the triangles";
        self.readable(doc, input, result, |sources| sources.positions(doc, input))
    }

    /// The texture coordinates that an `<input>` refers to, and the number of their set. `None` if
    /// the file has no textures, and with a warning, if the coordinates cannot be read.
    pub(super) fn tex_coords(
        &mut self,
        doc: &Document<'a>,
        input: Element<'a>,
    ) -> Result<Option<NumberedSet<'a>>, SceneError> {
        if !doc.has_textures() {
            return Ok(None);
        }
        let number = integer_attribute(doc, input, "set")?.unwrap_or(0);
        let result = "the texture coordinates are ignored";
        let values = self.readable(doc, input, result, |sources| {
            let element = doc.target(input, "source", "source")?;
            get_or_read(&mut sources.pairs, element, || pairs(doc, element))
        });
        Ok(values.map(|values| (number, values)))
    }

    /// What `read` returns. If that is an error: `None`, and a warning with the `result`.
    fn readable<T>(
        &mut self,
        doc: &Document<'a>,
        input: Element<'a>,
        result: &str,
        read: impl FnOnce(&mut Self) -> Result<T, SceneError>,
    ) -> Option<T> {
        let source = input.attribute("source").unwrap_or_default();
        if self.unreadable.contains(source) {
            return None;
        }
        let values = read(self);
        let warn = |error| {
            doc.warn_of(error, result);
            self.unreadable.insert(source);
        };
        values.map_err(warn).ok()
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
    /// The sets, if the file has textures.
    pub(super) tex_coords: Vec<NumberedSet<'a>>,
}

impl<'a> Vertices<'a> {
    pub(super) fn read(
        doc: &Document<'a>,
        element: Element<'a>,
        sources: &mut Sources<'a>,
    ) -> Result<Vertices<'a>, SceneError> {
        let mut positions = None;
        let mut normals = None;
        let mut tex_coords = Vec::new();
        for input in children(element).filter(|child| tag(*child) == "input") {
            match doc.attribute(input, "semantic")? {
                "POSITION" => positions = Some(sources.positions(doc, input)?),
                "NORMAL" => normals = sources.normals(doc, input),
                "TEXCOORD" => tex_coords.extend(sources.tex_coords(doc, input)?),
                _ => {}
            }
        }
        match positions {
            Some(positions) => Ok(Vertices {
                element,
                positions,
                normals,
                tex_coords,
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
