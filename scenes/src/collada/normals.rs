//! Normals of meshes without normals in the file.

use kit::Vec3;

/// `(p1-p0) x (p2-p0)` divided by the square of `size`, which is the largest component of the two
/// edges, so that it neither underflows nor overflows. Zero if the triangle has no area.
fn scaled_cross(p0: Vec3, p1: Vec3, p2: Vec3) -> (Vec3, f64) {
    let (e1, e2) = (p1 - p0, p2 - p0);
    let size = e1.abs().max(e2.abs()).max_element();
    if !(size > 0.0 && size.is_finite()) {
        return (Vec3::ZERO, 0.0);
    }
    ((e1 / size).cross(e2 / size), size)
}

/// The unit geometric normal of a triangle; `None` if it has no area.
pub(crate) fn face_normal(p0: Vec3, p1: Vec3, p2: Vec3) -> Option<Vec3> {
    scaled_cross(p0, p1, p2).0.try_normalize()
}

/// The cosine of the largest angle between a normal of a vertex and that of the triangle at which a
/// smoothed mesh still looks like its triangles: 30 degrees. At the corners of a cube it is 55.
const MIN_SMOOTH_COS: f64 = 0.866;

/// Whether a normal at a vertex of a triangle is so far from `face`, that of its plane, that a box
/// looks round.
pub(crate) fn looks_round(face: Vec3, normals: [Vec3; 3]) -> bool {
    normals.iter().any(|n| n.dot(face) < MIN_SMOOTH_COS)
}

/// A sum cancels if along a triangle's normal it has less than this fraction of what the triangle
/// itself adds. With neighbours that turn by at most a right angle it has all of that. Where the
/// same vertices have faces of both sides, what remains is no direction: roundings of 1e-16, or a
/// fifth across the normal where the polygons of the sides have different diagonals. On a cone of
/// 32 triangles the sum is larger unless the apex is narrower than 8 degrees.
const LEAST_SUM: f64 = 0.125;

/// It cancels, too, if it is shorter than this fraction of the sum of the lengths. On cloth with
/// faces of both sides, whose diagonals differ, what remains points anywhere. Faces around the apex
/// of a cone add up to more if that is wider than 29 degrees.
const LEAST_LENGTH: f64 = 0.25;

/// Vertex normals: the area-weighted mean of the normals of all adjacent triangles (H. Gouraud,
/// "Continuous shading of curved surfaces", 1971).
///
/// One is used for all meshes of a file, which may share a long list of positions: of each only the
/// sums at its own vertices are set to zero again ([`SmoothNormals::forget`]).
#[derive(Default)]
pub(crate) struct SmoothNormals {
    /// For each position, the sum of the weighted normals, and that of their lengths.
    sums: Vec<(Vec3, f64)>,
}

impl SmoothNormals {
    /// Adds the weighted normal of a triangle to its three vertices.
    pub(crate) fn add(&mut self, positions: &[Vec3], corners: [usize; 3]) {
        let [p0, p1, p2] = corners.map(|i| positions[i]);
        let (cross, size) = scaled_cross(p0, p1, p2);
        if self.sums.len() < positions.len() {
            self.sums.resize(positions.len(), Default::default());
        }
        let weighted = cross * size * size;
        for corner in corners {
            let (sum, length) = &mut self.sums[corner];
            *sum += weighted;
            *length += weighted.length();
        }
    }

    /// The normals at the vertices of a triangle that was added, not normalised. Its own, `face`,
    /// is in place of a sum that its neighbours cancel: see [`LEAST_SUM`] and [`LEAST_LENGTH`].
    pub(crate) fn at(&self, positions: &[Vec3], corners: [usize; 3], face: Vec3) -> [Vec3; 3] {
        let [p0, p1, p2] = corners.map(|i| positions[i]);
        let least = LEAST_SUM * (p1 - p0).cross(p2 - p0).dot(face);
        corners.map(|corner| match self.sums.get(corner) {
            Some((sum, length))
                if sum.dot(face) > least && sum.length() > LEAST_LENGTH * length =>
            {
                *sum
            }
            _ => face,
        })
    }

    /// Ends the mesh of a triangle that was added.
    pub(crate) fn forget(&mut self, corners: [usize; 3]) {
        for corner in corners {
            self.sums[corner] = Default::default();
        }
    }
}
