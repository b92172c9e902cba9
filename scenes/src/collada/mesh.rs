//! `<mesh>`: converts sources and primitive elements to triangles in local space.

use super::document::{Document, Element, children, name_of, tag};
use super::mesh_part::PartReader;
use super::normals::{SmoothNormals, face_normal, looks_round};
use super::polygon::TestCounter;
use super::vertices::{Sources, Vertices};
use crate::diagnostic::SceneError;
use kit::{Triangle, Vec2};

/// The triangles of a mesh that have one material.
#[derive(Debug)]
pub(super) struct MeshPart<'a> {
    /// The material symbol, which is bound by each instance of the mesh.
    pub(super) symbol: Option<&'a str>,
    /// In local space.
    pub(super) triangles: Vec<Triangle>,
    /// The sets of texture coordinates, if the file has textures.
    pub(super) tex_coords: Vec<TexCoordSet>,
}

/// A set of texture coordinates.
#[derive(Debug)]
pub(super) struct TexCoordSet {
    /// The number of the set in the file.
    pub(super) number: u64,
    /// For each triangle of the part, those of its vertices.
    pub(super) coordinates: Vec<[Vec2; 3]>,
}

/// State that the meshes of a file share.
#[derive(Default)]
pub(super) struct MeshReader<'a> {
    pub(super) sources: Sources<'a>,
    pub(super) counter: TestCounter,
    smooth: SmoothNormals,
}

impl<'a> MeshReader<'a> {
    /// Reads a mesh. Unused inputs, such as colours, are ignored.
    pub(super) fn read(
        &mut self,
        doc: &Document<'a>,
        mesh: Element<'a>,
    ) -> Result<Vec<MeshPart<'a>>, SceneError> {
        let mut primitives = Vec::new();
        for element in children(mesh) {
            match tag(element) {
                "source" | "vertices" | "extra" => {}
                "triangles" | "polylist" | "polygons" | "tristrips" | "trifans" => {
                    primitives.push(element);
                }
                other => {
                    let expected =
                        "only triangles, polylist, polygons, tristrips and trifans are supported";
                    doc.on(element, format!("<{other}> is ignored"), expected)
                        .warn();
                }
            }
        }
        if primitives.is_empty() {
            return Ok(Vec::new());
        }
        let vertices = Vertices::read(doc, doc.child(mesh, "vertices")?, &mut self.sources)?;
        let mut parts = Vec::new();
        for element in primitives {
            // An empty element needs no material.
            if let Some(reader) = PartReader::new(doc, element, &vertices, &mut self.sources)? {
                let corners = reader.corners(&mut self.counter)?;
                parts.push((element.attribute("material"), reader, corners));
            }
        }
        let positions = &vertices.positions.values;
        let mut smoothed = Vec::new();
        for (_, reader, corners) in &parts {
            let without = corners.iter().filter(|corners| !corners.has_normals);
            smoothed.extend(without.map(|corners| reader.positions_of(corners)));
        }
        for corners in &smoothed {
            self.smooth.add(positions, *corners);
        }
        let mut is_smoothed = false;
        let mut flat = 0_usize;
        let mut finished = Vec::with_capacity(parts.len());
        for (symbol, reader, mut corners) in parts {
            let count = corners.len();
            let mut triangles = Vec::with_capacity(count);
            corners.retain(|corners| {
                let corner_positions = reader.positions_of(corners);
                let [p0, p1, p2] = corner_positions.map(|i| positions[i]);
                let Some(face) = face_normal(p0, p1, p2) else {
                    return false;
                };
                // A normal that is zero in the file is replaced by the geometric normal.
                let normals = (reader.normals_of(corners))
                    .unwrap_or_else(|| self.smooth.at(positions, corner_positions, face))
                    .map(|n| n.try_normalize().unwrap_or(face));
                is_smoothed |= !corners.has_normals && looks_round(face, normals);
                triangles.push(Triangle::smooth([p0, p1, p2], normals));
                true
            });
            flat += count - corners.len();
            finished.push(MeshPart {
                symbol,
                triangles,
                tex_coords: reader.tex_coords(&corners),
            });
        }
        for corners in smoothed {
            self.smooth.forget(corners);
        }
        if is_smoothed {
            doc.add_smoothed(name_of(mesh.parent_element().unwrap_or(mesh)));
        }
        if flat > 0 {
            let title = format!("triangles without area: {flat}");
            doc.on(mesh, title, "they are invisible and are ignored")
                .warn();
        }
        Ok(finished)
    }
}
