//! A closed grid on the sphere: the octahedron |x|+|y|+|z| = f, with vertices at its integer
//! points.

use super::indexed_mesh::IndexedMesh;
use kit::Vec3;

/// Marks a grid point that is not on the octahedron.
const NONE: u32 = u32::MAX;

/// The vertex numbers of the integer points of the octahedron. The upper and the lower half are two
/// squares over the same (x, y), which share their boundaries.
struct Numbering {
    f: i64,
    upper: Vec<u32>,
    lower: Vec<u32>,
}

impl Numbering {
    fn slot(&self, x: i64, y: i64) -> usize {
        ((x + self.f) * (2 * self.f + 1) + (y + self.f)) as usize
    }

    fn number(&self, x: i64, y: i64, above: bool) -> u32 {
        let half = if above { &self.upper } else { &self.lower };
        half[self.slot(x, y)]
    }
}

/// The octasphere with 8f² triangles, `f >= 1`. `place` returns the position of the vertex in a
/// unit direction.
pub(super) fn octasphere(f: u32, mut place: impl FnMut(Vec3) -> Vec3) -> IndexedMesh {
    let f = i64::from(f);
    let squares = ((2 * f + 1) * (2 * f + 1)) as usize;
    let mut numbering = Numbering {
        f,
        upper: vec![NONE; squares],
        lower: vec![NONE; squares],
    };
    let mut mesh = IndexedMesh::default();
    mesh.positions.reserve(4 * (f * f) as usize + 2);
    mesh.faces.reserve(8 * (f * f) as usize);
    for x in -f..=f {
        let reach = f - x.abs();
        for y in -reach..=reach {
            let z = reach - y.abs();
            let slot = numbering.slot(x, y);
            let mut add = |z: i64| {
                let number = mesh.positions.len() as u32;
                let direction = Vec3::new(x as f64, y as f64, z as f64).normalize();
                mesh.positions.push(place(direction));
                number
            };
            numbering.upper[slot] = add(z);
            // On the boundary both halves share the vertex.
            numbering.lower[slot] = if z == 0 {
                numbering.upper[slot]
            } else {
                add(-z)
            };
        }
    }
    for above in [true, false] {
        for x in -f..f {
            for y in -f..f {
                add_square(&mut mesh, &numbering, [x, y], above);
            }
        }
    }
    mesh
}

/// Adds the triangles over the unit square at (x, y): both if all four corners are on the
/// octahedron, one at the boundary. The diagonal is parallel to the boundary of its quadrant.
fn add_square(mesh: &mut IndexedMesh, numbering: &Numbering, [x, y]: [i64; 2], above: bool) {
    let at = |dx: i64, dy: i64| numbering.number(x + dx, y + dy, above);
    let (a, b, c, d) = (at(0, 0), at(1, 0), at(1, 1), at(0, 1));
    let rising = (x >= 0) != (y >= 0);
    let halves = if rising {
        [[a, b, c], [a, c, d]]
    } else {
        [[a, b, d], [b, c, d]]
    };
    for [p, q, r] in halves {
        if p != NONE && q != NONE && r != NONE {
            mesh.faces.push(if above { [p, q, r] } else { [p, r, q] });
        }
    }
}
