//! `<mesh>`: sources and primitives become triangles in the mesh's own space.

use super::document::{Document, Element, children, tag};
use super::mesh_part::{Corners, PartReader};
use super::normals::{SmoothNormals, face_normal};
use super::polygon::Effort;
use super::vertices::{Sources, Vertices};
use crate::diagnostic::SceneError;
use kit::{Triangle, Vec2, Vec3};

/// The triangles of a mesh that have one material.
#[derive(Debug)]
pub(super) struct MeshPart<'a> {
    /// What the file calls its material, to be bound where the mesh is placed.
    pub(super) symbol: Option<&'a str>,
    /// In the mesh's own space.
    pub(super) triangles: Vec<Triangle>,
    /// For each triangle, the texture coordinates of its vertices; empty if the file has none.
    pub(super) on_texture: Vec<[Vec2; 3]>,
}

/// What meshes of one file share.
#[derive(Default)]
pub(super) struct MeshReader<'a> {
    pub(super) sources: Sources<'a>,
    pub(super) effort: Effort,
}

impl<'a> MeshReader<'a> {
    /// Reads a mesh. Inputs that mean nothing here, such as colours, are passed over.
    pub(super) fn read(
        &mut self,
        doc: &Document<'a>,
        mesh: Element<'a>,
    ) -> Result<Vec<MeshPart<'a>>, SceneError> {
        let vertices = Vertices::read(doc, doc.child(mesh, "vertices")?, &mut self.sources)?;
        let mut parts: Vec<(Option<&'a str>, Vec<Corners>)> = Vec::new();
        for element in children(mesh) {
            match tag(element) {
                "source" | "vertices" | "extra" => {}
                "triangles" | "polylist" | "polygons" | "tristrips" | "trifans" => {
                    let corners = match PartReader::new(doc, element, &vertices, &mut self.sources)?
                    {
                        Some(reader) => reader.corners(&mut self.effort)?,
                        None => Vec::new(),
                    };
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
        let mut smooth = SmoothNormals::default();
        for corners in parts.iter().flat_map(|(_, corners)| corners) {
            if corners.normals.is_none() {
                smooth.add(positions, corners.positions);
            }
        }
        let mut flat = 0_usize;
        let mut finished = Vec::with_capacity(parts.len());
        for (symbol, corners) in parts {
            let mut part = MeshPart {
                symbol,
                triangles: Vec::with_capacity(corners.len()),
                on_texture: Vec::new(),
            };
            for corners in &corners {
                match finish(corners, positions, &smooth) {
                    Some(triangle) => {
                        part.triangles.push(triangle);
                        part.on_texture.extend(corners.on_texture);
                    }
                    None => flat += 1,
                }
            }
            finished.push(part);
        }
        if flat > 0 {
            doc.warn(|| {
                let title = format!("triangles without area: {flat}");
                doc.on(mesh, title, "they cannot be seen and are left out")
            });
        }
        Ok(finished)
    }
}

/// The triangle with its normals; `None` if it has no area.
fn finish(corners: &Corners, positions: &[Vec3], smooth: &SmoothNormals) -> Option<Triangle> {
    let [p0, p1, p2] = corners.positions.map(|i| positions[i]);
    let face = face_normal(p0, p1, p2)?;
    let normals = corners
        .normals
        .unwrap_or_else(|| smooth.at(corners.positions));
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
