//! One primitive element of a mesh: converts its index lists to triangles.

use super::document::{Document, Element, describe};
use super::numbers::{check_count, token_range};
use super::polygon::{TestCounter, triangulate};
use super::primitives::{Polygons, read_polygons};
use super::vertices::{Sources, Vectors, Vertices};
use crate::diagnostic::{Diagnostic, SceneError};
use kit::{Vec2, Vec3};
use std::rc::Rc;

/// A triangle whose vertices are indices of positions, with the normals and texture coordinates of
/// the file, if any.
pub(super) struct Corners {
    pub(super) positions: [usize; 3],
    pub(super) normals: Option<[Vec3; 3]>,
    pub(super) tex_coords: Option<[Vec2; 3]>,
}

/// The offset of an input in a group of indices, and the list that its index refers to.
struct IndexInto<'a, T = Vec3> {
    offset: usize,
    vectors: Rc<Vectors<'a, T>>,
}

/// Converts the index lists of a primitive element to triangles.
pub(super) struct PartReader<'r, 'a> {
    doc: &'r Document<'a>,
    element: Element<'a>,
    polygons: Polygons<'a>,
    positions: IndexInto<'a>,
    /// From a separate input, or from `<vertices>` with the index of the positions.
    normals: Option<IndexInto<'a>>,
    /// The first set of texture coordinates, if the file has textures.
    tex_coords: Option<IndexInto<'a, Vec2>>,
}

impl<'r, 'a> PartReader<'r, 'a> {
    /// Reads the inputs and index lists. `None` if the element is empty.
    pub(super) fn new(
        doc: &'r Document<'a>,
        element: Element<'a>,
        vertices: &Vertices<'a>,
        sources: &mut Sources<'a>,
    ) -> Result<Option<PartReader<'r, 'a>>, SceneError> {
        let polygons = read_polygons(doc, element)?;
        let mut vertex_offset = None;
        let mut normals = None;
        let mut tex_coords = None;
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
                "TEXCOORD" if tex_coords.is_none() && doc.has_textures() => {
                    let vectors = sources.pairs_of(doc, input.element)?;
                    tex_coords = Some(IndexInto { offset, vectors });
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
                .help("refer to the <vertices> of the mesh")
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
            tex_coords,
        }))
    }

    /// The triangles of all polygons.
    pub(super) fn corners(&self, counter: &mut TestCounter) -> Result<Vec<Corners>, SceneError> {
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
            let triangulation = triangulate(&points, counter).map_err(|_| {
                let title = format!(
                    "the polygons of {} are too complex to triangulate",
                    describe(element)
                );
                doc.on(
                    element,
                    title,
                    "expected triangles, or polygons of fewer corners",
                )
                .help("triangulate the mesh in the modelling program before the export")
            })?;
            if !triangulation.simple {
                doc.warn(|| self.self_intersection(polygon.list, polygon.first));
            }
            for [a, b, c] in triangulation.triangles {
                // The winding order of a strip alternates: every second triangle is reversed.
                let triangle = if polygon.reversed {
                    [a, c, b]
                } else {
                    [a, b, c]
                };
                let groups = triangle.map(|corner| polygon.group(corner));
                corners.push(Corners {
                    positions: triangle.map(|corner| positions[corner]),
                    normals: self.at_corners(polygon.list, groups, &self.normals)?,
                    tex_coords: self.at_corners(polygon.list, groups, &self.tex_coords)?,
                });
            }
        }
        Ok(corners)
    }

    fn self_intersection(&self, list: usize, first: usize) -> Diagnostic {
        let p = self.polygons.lists[list].element;
        let range = token_range(self.doc, p, first * self.polygons.stride);
        let expected = "in the polygon that starts here; its triangles may overlap";
        self.doc.at(
            range,
            "a polygon intersects itself or has no area",
            expected,
        )
    }

    /// The values at three corners, if the file has this input.
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

    /// The index of an input in a group of a `<p>`. Checks that it is in range.
    fn index<T>(
        &self,
        list: usize,
        group: usize,
        into: &IndexInto<'a, T>,
    ) -> Result<usize, SceneError> {
        let position = group * self.polygons.stride + into.offset;
        let list = &self.polygons.lists[list];
        let index = list.indices[position] as usize;
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
        let range = token_range(self.doc, list.element, position);
        let help = "the source or the index list is damaged: export the file again";
        Err(self.doc.at(range, title, expected).help(help).into())
    }
}

/// Checks that the input VERTEX refers to the vertices of the same mesh.
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
