//! Simple triangles and rays.

use crate::tools::simple::rays::{self, DIRECTIONS, permuted, through};
use crate::tools::simple::{complexity, sorted};
use wire::work::{Probe, Ray, TriangleWork, Xyz};

/// Points of the triangle (0, 0) (4, 0) (0, 4) in its plane, by a margin inside, or outside beyond
/// one edge or two.
const POINTS: [[f64; 2]; 11] = [
    [1.0, 1.0],
    [2.0, 1.0],
    [1.0, 2.0],
    [-1.0, 1.0],
    [1.0, -1.0],
    [3.0, 3.0],
    [-1.0, -1.0],
    [-1.0, 3.0],
    [5.0, 1.0],
    [1.0, 5.0],
    [6.0, -1.0],
];

/// Points on the edges and vertices.
const EDGES: [[f64; 2]; 6] = [
    [2.0, 0.0],
    [0.0, 2.0],
    [2.0, 2.0],
    [0.0, 0.0],
    [4.0, 0.0],
    [0.0, 4.0],
];

/// The triangles: one in each of the planes z = 0, x = 0 and y = 0, one whose first vertex is not
/// the origin, one that turns the other way, and one with a different normal at each vertex.
fn triangles() -> Vec<[Xyz; 6]> {
    let flat = |vertices: [Xyz; 3], n: Xyz| {
        let [a, b, c] = vertices;
        [a, b, c, n, n, n]
    };
    let upright = |turn| {
        let corners =
            [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]].map(|corner| permuted(corner, turn));
        flat(corners, permuted([0.0, 0.0, 1.0], turn))
    };
    let [a, b, c, n, ..] = upright(0);
    let moved = [a, b, c].map(|[x, y, z]| [x + 1.0, y + 2.0, z + 3.0]);
    vec![
        upright(0),
        flat([a, c, b], [0.0, 0.0, -1.0]),
        [a, b, c, n, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        upright(1),
        upright(2),
        flat(moved, n),
    ]
}

/// The point of `triangle` with the coordinates `at` along its edges from the first vertex.
fn point(triangle: &[Xyz; 6], [u, v]: [f64; 2]) -> Xyz {
    let [a, b, c, ..] = triangle;
    [0, 1, 2].map(|i| a[i] + u / 4.0 * (b[i] - a[i]) + v / 4.0 * (c[i] - a[i]))
}

/// The direction `d` for a triangle in the plane that is perpendicular to its normal's axis.
fn turned(triangle: &[Xyz; 6], d: Xyz) -> Xyz {
    let axis = (0..3).find(|&axis| (0..3).all(|p| triangle[p][axis] == triangle[0][axis]));
    permuted(d, (axis.unwrap_or(2) + 1) % 3)
}

/// The simple questions about single triangles, to `record_triangle` if `by_record`.
pub(crate) fn questions(by_record: bool) -> Vec<TriangleWork> {
    let triangles = triangles();
    let mut decided = Vec::new();
    let mut conventions = Vec::new();
    for (shape, triangle) in triangles.iter().enumerate() {
        let probe = |ray: Ray| Probe {
            shape: shape as u32,
            ray,
        };
        for d in DIRECTIONS.map(|d| turned(triangle, d)) {
            for at in POINTS.map(|at| point(triangle, at)) {
                for t in [1.0, 2.0, -1.0] {
                    let ranges = rays::ranges(t).into_iter();
                    decided.extend(ranges.map(|range| probe(through(at, d, t, range))));
                }
            }
        }
        let up = turned(triangle, [0.0, 0.0, 1.0]);
        let inside = point(triangle, POINTS[0]);
        for range in [[0.0, 1.0], [1.0, 2.0], [1.0, 1.0]] {
            conventions.push(probe(through(inside, up, 1.0, range)));
        }
        for at in EDGES.map(|at| point(triangle, at)) {
            conventions.push(probe(through(at, up, 1.0, [0.0, f64::INFINITY])));
        }
        let level = turned(triangle, [1.0, 0.0, 0.0]);
        let above = [0, 1, 2].map(|i| inside[i] + up[i]);
        for start in [above, inside] {
            conventions.push(probe(through(start, level, 2.0, [0.0, f64::INFINITY])));
        }
    }
    let numbers = |probe: &Probe| {
        let shape = triangles[probe.shape as usize];
        rays::complexity_of(&probe.ray)
            + complexity(shape.into_iter().flatten())
            // A triangle in another plane is as simple; a new one costs a drawing.
            + 2 * probe.shape
    };
    let mut probes = sorted(decided, numbers);
    probes.truncate(MOST);
    probes.extend(sorted(conventions, numbers));
    vec![TriangleWork {
        triangles,
        probes,
        by_record,
    }]
}

/// The most questions in which no convention decides.
const MOST: usize = 600;
