//! Indexed meshes, whose triangles share vertices.

use kit::{Triangle, Vec3};

/// Vertices, and triangles as indices of vertices. Shared vertices are identical to the last bit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IndexedMesh {
    /// Vertices.
    pub positions: Vec<Vec3>,
    /// Three indices of vertices each, counter-clockwise as seen from outside.
    pub faces: Vec<[u32; 3]>,
}

impl IndexedMesh {
    /// The vertices of a face.
    pub fn corners(&self, face: [u32; 3]) -> [Vec3; 3] {
        face.map(|vertex| self.positions[vertex as usize])
    }

    /// Splits faces into three at their centroid, evenly distributed over the mesh, until there are
    /// `target` faces, or one fewer, because each split adds two. A mesh with at least `target`
    /// faces is returned unchanged.
    pub(super) fn split_to(mut self, target: usize) -> IndexedMesh {
        let faces = self.faces.len();
        let splits = (target.saturating_sub(faces) / 2).min(faces);
        for i in 0..faces {
            if (i + 1) * splits / faces == i * splits / faces {
                continue;
            }
            let [a, b, c] = self.faces[i];
            let [p0, p1, p2] = self.corners([a, b, c]);
            let centroid = self.positions.len() as u32;
            self.positions.push((p0 + p1 + p2) / 3.0);
            self.faces[i] = [a, b, centroid];
            self.faces.extend([[b, c, centroid], [c, a, centroid]]);
        }
        self
    }

    /// The triangles with smooth normals: at each vertex the area-weighted mean of the normals of
    /// its faces.
    pub fn smooth_triangles(&self) -> Vec<Triangle> {
        let mut normals = vec![Vec3::ZERO; self.positions.len()];
        for face in &self.faces {
            let [p0, p1, p2] = self.corners(*face);
            let weighted = (p1 - p0).cross(p2 - p0);
            for vertex in face {
                normals[*vertex as usize] += weighted;
            }
        }
        for normal in &mut normals {
            *normal = normal.normalize_or_zero();
        }
        let triangle = |face: &[u32; 3]| {
            Triangle::smooth(
                self.corners(*face),
                face.map(|vertex| normals[vertex as usize]),
            )
        };
        self.faces.iter().map(triangle).collect()
    }

    /// The triangles with their geometric normals.
    pub fn flat_triangles(&self) -> Vec<Triangle> {
        let triangle = |face: &[u32; 3]| {
            let [p0, p1, p2] = self.corners(*face);
            Triangle::flat(p0, p1, p2)
        };
        self.faces.iter().map(triangle).collect()
    }
}
