//! Normals that a mesh does not bring along.

use kit::Vec3;

/// `(p1-p0) x (p2-p0)`, in units of the longer of the two edges squared, so that it neither under- nor
/// overflows; zero if the triangle has no area.
fn scaled_cross(p0: Vec3, p1: Vec3, p2: Vec3) -> (Vec3, f64) {
    let (e1, e2) = (p1 - p0, p2 - p0);
    let size = e1.abs().max(e2.abs()).max_element();
    if !(size > 0.0 && size.is_finite()) {
        return (Vec3::ZERO, 0.0);
    }
    ((e1 / size).cross(e2 / size), size)
}

/// The unit normal of a triangle's plane; `None` if it has no area.
pub(super) fn face_normal(p0: Vec3, p1: Vec3, p2: Vec3) -> Option<Vec3> {
    scaled_cross(p0, p1, p2).0.try_normalize()
}

/// Adds a triangle's normal, weighted by its area, to those of its three vertices
/// (H. Gouraud, "Continuous shading of curved surfaces", 1971).
pub(super) fn add_corner_normals(sums: &mut [Vec3], positions: &[Vec3], corners: [usize; 3]) {
    let [p0, p1, p2] = corners.map(|i| positions[i]);
    let (cross, size) = scaled_cross(p0, p1, p2);
    for corner in corners {
        sums[corner] += cross * size * size;
    }
}
