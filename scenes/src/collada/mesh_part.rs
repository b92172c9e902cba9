//! One primitive element of a mesh: its index lists become triangles.

use super::document::{Document, Element, describe};
use super::numbers::{check_count, place_of};
use super::polygon::{Effort, triangulate};
use super::primitives::{Polygons, read_polygons};
use super::vertices::{Sources, Vectors, Vertices};
use crate::diagnostic::{Diagnostic, SceneError};
use kit::{Vec2, Vec3};
use std::rc::Rc;

/// A triangle whose corners are still indices into positions, with normals and texture coordinates where the file
/// has them.
pub(super) struct Corners {
    pub(super) positions: [usize; 3],
    pub(super) normals: Option<[Vec3; 3]>,
    pub(super) on_texture: Option<[Vec2; 3]>,
}

/// Where in a group of indices one stands, and what it counts in.
struct IndexInto<'a, T = Vec3> {
    offset: usize,
    vectors: Rc<Vectors<'a, T>>,
}

/// Everything needed to turn the index lists of a primitive element into triangles.
pub(super) struct PartReader<'r, 'a> {
    doc: &'r Document<'a>,
    element: Element<'a>,
    polygons: Polygons<'a>,
    positions: IndexInto<'a>,
    /// From an input of its own or, under the same index as the positions, from `<vertices>`.
    normals: Option<IndexInto<'a>>,
    /// The first set, if the file has textures at all.
    on_texture: Option<IndexInto<'a, Vec2>>,
}

impl<'r, 'a> PartReader<'r, 'a> {
    /// Reads inputs and index lists; `None` if there is nothing in the element.
    pub(super) fn new(
        doc: &'r Document<'a>,
        element: Element<'a>,
        vertices: &Vertices<'a>,
        sources: &mut Sources<'a>,
    ) -> Result<Option<PartReader<'r, 'a>>, SceneError> {
        let polygons = read_polygons(doc, element)?;
        let mut vertex_offset = None;
        let mut normals = None;
        let mut on_texture = None;
        for input in &polygons.inputs {
            let offset = input.offset;
            match doc.attribute(input.element, "semantic")? {
                "VERTEX" => {
                    same_mesh(doc, input.element, vertices)?;
                    vertex_offset = Some(offset);
                }
                "NORMAL" => {
                    let vectors = sources.of(doc, input.element)?;
                    normals = Some(IndexInto { offset, vectors });
                }
                "TEXCOORD" if on_texture.is_none() && doc.has_textures() => {
                    let vectors = sources.pairs_of(doc, input.element)?;
                    on_texture = Some(IndexInto { offset, vectors });
                }
                _ => {}
            }
        }
        let Some(offset) = vertex_offset else {
            if polygons.is_empty() {
                return Ok(None);
            }
            return Err(doc
                .on(
                    element,
                    format!("{} has no vertices", describe(element)),
                    "expected <input semantic=\"VERTEX\" source=\"#...\" offset=\"0\"/>",
                )
                .help("name the <vertices> of the mesh")
                .into());
        };
        let index_into = |vectors: &Rc<Vectors<'a>>| IndexInto {
            offset,
            vectors: Rc::clone(vectors),
        };
        Ok(Some(PartReader {
            doc,
            element,
            polygons,
            positions: index_into(&vertices.positions),
            normals: normals.or_else(|| vertices.normals.as_ref().map(index_into)),
            on_texture,
        }))
    }

    /// The triangles of all polygons.
    pub(super) fn corners(&self, effort: &mut Effort) -> Result<Vec<Corners>, SceneError> {
        let doc = self.doc;
        let element = self.element;
        check_count(
            doc,
            element,
            self.polygons.declared as u64,
            self.polygons.what,
        )?;
        let mut corners = Vec::with_capacity(self.polygons.triangle_count());
        for polygon in self.polygons.iter() {
            let positions = polygon
                .groups()
                .map(|group| self.index(polygon.list, group, &self.positions))
                .collect::<Result<Vec<usize>, SceneError>>()?;
            let points: Vec<Vec3> = positions
                .iter()
                .map(|i| self.positions.vectors.values[*i])
                .collect();
            let cut = triangulate(&points, effort).map_err(|_| {
                let title = format!(
                    "the polygons of {} are too winding to be cut into triangles",
                    describe(element)
                );
                doc.on(
                    element,
                    title,
                    "expected triangles, or polygons of fewer corners",
                )
                .help("let the modelling program triangulate the mesh before it exports")
            })?;
            if !cut.simple {
                doc.warn(|| self.crossing(polygon.list, polygon.first));
            }
            for [a, b, c] in cut.triangles {
                // A strip's second triangle, its fourth, ...: the winding alternates.
                let triangle = if polygon.reversed {
                    [a, c, b]
                } else {
                    [a, b, c]
                };
                let groups = triangle.map(|corner| polygon.group(corner));
                corners.push(Corners {
                    positions: triangle.map(|corner| positions[corner]),
                    normals: self.at_corners(polygon.list, groups, &self.normals)?,
                    on_texture: self.at_corners(polygon.list, groups, &self.on_texture)?,
                });
            }
        }
        Ok(corners)
    }

    fn crossing(&self, list: usize, first: usize) -> Diagnostic {
        let p = self.polygons.lists[list].element;
        let place = place_of(self.doc, p, first * self.polygons.stride);
        let expected = "the polygon that starts here; its triangles may overlap";
        self.doc
            .at(place, "a polygon crosses itself or has no area", expected)
    }

    /// What three corners index, if the file has it.
    fn at_corners<T: Copy + Default>(
        &self,
        list: usize,
        groups: [usize; 3],
        into: &Option<IndexInto<'a, T>>,
    ) -> Result<Option<[T; 3]>, SceneError> {
        let Some(into) = into else {
            return Ok(None);
        };
        let mut values = [T::default(); 3];
        for (value, group) in values.iter_mut().zip(groups) {
            *value = into.vectors.values[self.index(list, group, into)?];
        }
        Ok(Some(values))
    }

    /// An index in a group of a `<p>`, checked against what it counts in.
    fn index<T>(
        &self,
        list: usize,
        group: usize,
        into: &IndexInto<'a, T>,
    ) -> Result<usize, SceneError> {
        let word = group * self.polygons.stride + into.offset;
        let list = &self.polygons.lists[list];
        let index = list.indices[word] as usize;
        let count = into.vectors.values.len();
        if index < count {
            return Ok(index);
        }
        let source = describe(into.vectors.element);
        let title = format!("index {index} is out of range: {source} has {count} entries");
        let expected = match count {
            0 => "the source is empty".to_owned(),
            _ => format!("expected 0 to {}", count - 1),
        };
        let place = place_of(self.doc, list.element, word);
        let help = "the source or the index list is damaged: export the file again";
        Err(self.doc.at(place, title, expected).help(help).into())
    }
}

/// The input VERTEX must refer to the vertices of the same mesh.
fn same_mesh<'a>(
    doc: &Document<'a>,
    input: Element<'a>,
    vertices: &Vertices<'a>,
) -> Result<(), SceneError> {
    let target = doc.target(input, "source", "vertices")?;
    if target == vertices.element {
        return Ok(());
    }
    let title = format!(
        "VERTEX refers to the vertices of another mesh, {}",
        describe(target)
    );
    let expected = format!("expected {}", describe(vertices.element));
    Err(doc
        .on_attribute(input, "source", title, expected)
        .help("refer to the <vertices> of the same mesh")
        .into())
}
