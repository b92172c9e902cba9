//! Triangle meshes with shared vertices.

use kit::{Triangle, Vec3};

/// A list of vertices, and triangles that are indices into it. Triangles that share a vertex have
/// exactly the same position for it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IndexedMesh {
    /// Positions of the vertices.
    pub positions: Vec<Vec3>,
    /// Three vertex indices per triangle, counter-clockwise seen from outside.
    pub faces: Vec<[u32; 3]>,
}

impl IndexedMesh {
    /// Returns the positions of the vertices of a face.
    pub fn corners(&self, face: [u32; 3]) -> [Vec3; 3] {
        face.map(|vertex| self.positions[vertex as usize])
    }

    /// Divides faces into three at their centroid, evenly spread over the mesh, until there are
    /// `wanted` faces or one less: each division adds two faces, and a face is divided once at
    /// most. A mesh that has enough faces already is returned unchanged.
    pub(super) fn cut_to(mut self, wanted: usize) -> IndexedMesh {
        let faces = self.faces.len();
        let cuts = (wanted.saturating_sub(faces) / 2).min(faces);
        for i in 0..faces {
            if (i + 1) * cuts / faces == i * cuts / faces {
                continue;
            }
            let [a, b, c] = self.faces[i];
            let [p0, p1, p2] = self.corners([a, b, c]);
            let middle = self.positions.len() as u32;
            self.positions.push((p0 + p1 + p2) / 3.0);
            self.faces[i] = [a, b, middle];
            self.faces.extend([[b, c, middle], [c, a, middle]]);
        }
        self
    }

    /// Returns the triangles. Each vertex normal is the area-weighted mean of the normals of its
    /// faces.
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
            let [p0, p1, p2] = self.corners(*face);
            let [n0, n1, n2] = face.map(|vertex| normals[vertex as usize]);
            Triangle {
                p0,
                p1,
                p2,
                n0,
                n1,
                n2,
            }
        };
        self.faces.iter().map(triangle).collect()
    }

    /// Returns the triangles, each with the normal of its plane.
    pub fn flat_triangles(&self) -> Vec<Triangle> {
        let triangle = |face: &[u32; 3]| {
            let [p0, p1, p2] = self.corners(*face);
            Triangle::flat(p0, p1, p2)
        };
        self.faces.iter().map(triangle).collect()
    }
}
