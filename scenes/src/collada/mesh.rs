//! `<mesh>`: sources and primitives become triangles in the mesh's own space.

use super::document::{Document, Element, children, describe, tag};
use super::normals::{add_corner_normals, face_normal};
use super::numbers::{check_count, place_of};
use super::polygon::{Effort, triangulate};
use super::primitives::{Polygons, read_polygons};
use super::source::vectors;
use crate::diagnostic::{Diagnostic, SceneError};
use kit::{Triangle, Vec3};

/// The triangles of a mesh that have one material.
#[derive(Debug)]
pub(super) struct MeshPart<'a> {
    /// What the file calls its material, to be bound where the mesh is placed.
    pub(super) symbol: Option<&'a str>,
    /// In the mesh's own space. A corner normal is zero where there is none to be had.
    pub(super) triangles: Vec<Triangle>,
}

/// An `<input>`: which source, and where in each group of indices its index stands.
struct Input<T> {
    offset: usize,
    source: T,
}

/// Points or directions, and the element they were read from.
struct Vectors<'a> {
    element: Element<'a>,
    values: Vec<Vec3>,
}

/// What `<vertices>` binds together under one index.
struct Vertices<'a> {
    positions: Vectors<'a>,
    normals: Option<Vectors<'a>>,
}

/// A triangle whose corners are still indices into positions and, where the file has them, normals.
struct Corners {
    positions: [usize; 3],
    normals: Option<[Vec3; 3]>,
}

/// Reads a mesh. Texture coordinates and other inputs are passed over.
pub(super) fn read<'a>(
    doc: &Document<'a>,
    mesh: Element<'a>,
    effort: &mut Effort,
) -> Result<Vec<MeshPart<'a>>, SceneError> {
    let vertices_element = doc.child(mesh, "vertices")?;
    let vertices = read_vertices(doc, vertices_element)?;
    let mut parts: Vec<(Option<&'a str>, Vec<Corners>)> = Vec::new();
    for element in children(mesh) {
        match tag(element) {
            "source" | "vertices" | "extra" => {}
            "triangles" | "polylist" | "polygons" | "tristrips" | "trifans" => {
                let corners = read_part(doc, element, vertices_element, &vertices, effort)?;
                parts.push((element.attribute("material"), corners));
            }
            other => doc.warn(|| {
                let expected =
                    "only triangles, polylist, polygons, tristrips and trifans have a surface";
                doc.on(element, format!("<{other}> is passed over"), expected)
            }),
        }
    }
    let positions = &vertices.positions.values;
    let mut smooth = vec![Vec3::ZERO; positions.len()];
    for corners in parts.iter().flat_map(|(_, corners)| corners) {
        if corners.normals.is_none() {
            add_corner_normals(&mut smooth, positions, corners.positions);
        }
    }
    let mut flat = 0_usize;
    let finished = parts.into_iter().map(|(symbol, corners)| {
        let triangles = corners.into_iter().filter_map(|corners| {
            let triangle = finish(&corners, positions, &smooth);
            flat += usize::from(triangle.is_none());
            triangle
        });
        MeshPart {
            symbol,
            triangles: triangles.collect(),
        }
    });
    let finished = finished.collect();
    if flat > 0 {
        doc.warn(|| {
            let title = format!("{flat} triangles have no area");
            doc.on(mesh, title, "they cannot be seen and are left out")
        });
    }
    Ok(finished)
}

/// The triangle with its normals; `None` if it has no area.
fn finish(corners: &Corners, positions: &[Vec3], smooth: &[Vec3]) -> Option<Triangle> {
    let [p0, p1, p2] = corners.positions.map(|i| positions[i]);
    let face = face_normal(p0, p1, p2)?;
    let normals = corners
        .normals
        .unwrap_or_else(|| corners.positions.map(|i| smooth[i]));
    // A normal that cancels out, or that the file gives as zero: the plane's own.
    let [n0, n1, n2] = normals.map(|n| n.try_normalize().unwrap_or(face));
    Some(Triangle {
        p0,
        p1,
        p2,
        n0,
        n1,
        n2,
    })
}

fn read_vertices<'a>(doc: &Document<'a>, element: Element<'a>) -> Result<Vertices<'a>, SceneError> {
    let mut positions = None;
    let mut normals = None;
    for input in children(element).filter(|child| tag(*child) == "input") {
        match doc.attribute(input, "semantic")? {
            "POSITION" => positions = Some(read_vectors(doc, input)?),
            "NORMAL" => normals = Some(read_vectors(doc, input)?),
            _ => {}
        }
    }
    match positions {
        Some(positions) => Ok(Vertices { positions, normals }),
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

fn read_vectors<'a>(doc: &Document<'a>, input: Element<'a>) -> Result<Vectors<'a>, SceneError> {
    let element = doc.target(input, "source", "source")?;
    let values = vectors(doc, element)?;
    Ok(Vectors { element, values })
}

/// The triangles of one primitive element.
fn read_part<'a>(
    doc: &Document<'a>,
    element: Element<'a>,
    vertices_element: Element<'a>,
    vertices: &Vertices<'a>,
    effort: &mut Effort,
) -> Result<Vec<Corners>, SceneError> {
    let polygons = read_polygons(doc, element)?;
    let mut vertex = None;
    let mut normal: Option<Input<Vectors<'a>>> = None;
    for input in &polygons.inputs {
        match doc.attribute(input.element, "semantic")? {
            "VERTEX" => {
                let target = doc.target(input.element, "source", "vertices")?;
                if target != vertices_element {
                    let title = format!(
                        "VERTEX refers to the vertices of another mesh, {}",
                        describe(target)
                    );
                    let expected = format!("expected {}", describe(vertices_element));
                    return Err(doc
                        .on_attribute(input.element, "source", title, expected)
                        .help("refer to the <vertices> of the same mesh")
                        .into());
                }
                vertex = Some(input.offset);
            }
            "NORMAL" => {
                let source = read_vectors(doc, input.element)?;
                normal = Some(Input {
                    offset: input.offset,
                    source,
                });
            }
            _ => {}
        }
    }
    let Some(vertex) = vertex else {
        if polygons.is_empty() {
            return Ok(Vec::new());
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
    let reader = PartReader {
        doc,
        polygons,
        vertex,
        normal,
        vertices,
    };
    reader.corners(element, effort)
}

/// Everything needed to turn the index lists of a primitive element into triangles.
struct PartReader<'r, 'a> {
    doc: &'r Document<'a>,
    polygons: Polygons<'a>,
    vertex: usize,
    normal: Option<Input<Vectors<'a>>>,
    vertices: &'r Vertices<'a>,
}

impl<'a> PartReader<'_, 'a> {
    fn corners(
        &self,
        element: Element<'a>,
        effort: &mut Effort,
    ) -> Result<Vec<Corners>, SceneError> {
        let doc = self.doc;
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
                .map(|group| self.index(polygon.list, group, self.vertex, &self.vertices.positions))
                .collect::<Result<Vec<usize>, SceneError>>()?;
            let points: Vec<Vec3> = positions
                .iter()
                .map(|i| self.vertices.positions.values[*i])
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
                let [b, c] = if polygon.reversed { [c, b] } else { [b, c] };
                corners.push(Corners {
                    positions: [positions[a], positions[b], positions[c]],
                    normals: self
                        .normals(polygon.list, [a, b, c].map(|corner| polygon.group(corner)))?,
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

    /// The normals of three corners, from an input of their own or from `<vertices>`.
    fn normals(&self, list: usize, groups: [usize; 3]) -> Result<Option<[Vec3; 3]>, SceneError> {
        let (offset, source) = match (&self.normal, &self.vertices.normals) {
            (Some(input), _) => (input.offset, &input.source),
            (None, Some(source)) => (self.vertex, source),
            (None, None) => return Ok(None),
        };
        let mut normals = [Vec3::ZERO; 3];
        for (normal, group) in normals.iter_mut().zip(groups) {
            *normal = source.values[self.index(list, group, offset, source)?];
        }
        Ok(Some(normals))
    }

    /// The index at `offset` in a group of a `<p>`, checked against its source.
    fn index(
        &self,
        list: usize,
        group: usize,
        offset: usize,
        source: &Vectors<'a>,
    ) -> Result<usize, SceneError> {
        let word = group * self.polygons.stride + offset;
        let list = &self.polygons.lists[list];
        let index = list.indices[word] as usize;
        if index < source.values.len() {
            return Ok(index);
        }
        let count = source.values.len();
        let title = format!(
            "index {index} is out of range: {} has {count} entries",
            describe(source.element)
        );
        let expected = match count {
            0 => "the source is empty".to_owned(),
            _ => format!("expected 0 to {}", count - 1),
        };
        let place = place_of(self.doc, list.element, word);
        let help = "the source or the index list is damaged: export the file again";
        Err(self.doc.at(place, title, expected).help(help).into())
    }
}
