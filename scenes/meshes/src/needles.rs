//! A closed mesh of needles, like a sea urchin.

use super::indexed_mesh::IndexedMesh;
use super::noise::uniform;
use super::octasphere::octasphere;
use kit::Vec3;

/// Radius of the sphere under the needles.
const BODY: f64 = 0.35;

/// The largest mesh of at most `triangles` triangles: 24f². Each triangle of an octasphere is
/// replaced by the three sides of a needle, so adjacent needles share edges.
pub(super) fn mesh(triangles: usize) -> IndexedMesh {
    let f = ((triangles as f64 / 24.0).sqrt() as u32).max(1);
    let body = octasphere(f, |direction| BODY * direction);
    let mut mesh = IndexedMesh {
        faces: Vec::with_capacity(3 * body.faces.len()),
        positions: body.positions.clone(),
    };
    for (i, face) in body.faces.iter().enumerate() {
        let [p0, p1, p2] = body.corners(*face);
        let tip = mesh.positions.len() as u32;
        // Tips are between 0.65 and 1 from the centre.
        let length = 0.65 + 0.35 * uniform(i as u64);
        mesh.positions
            .push(length * (p0 + p1 + p2).normalize_or(Vec3::Y));
        let [a, b, c] = *face;
        mesh.faces.extend([[a, b, tip], [b, c, tip], [c, a, tip]]);
    }
    mesh
}
