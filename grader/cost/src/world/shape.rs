//! The meshes of the hard cases, with vertices in single precision.

use super::case::Rounded;
use super::random::Random;
use kit::{Vec3, math};
use meshes::{IndexedMesh, MeshKind};
use std::collections::HashMap;

/// A mesh with its vertices rounded.
fn mesh(vertices: impl IntoIterator<Item = Vec3>, faces: Vec<[u32; 3]>) -> IndexedMesh {
    let positions = vertices.into_iter().map(Vec3::rounded).collect();
    IndexedMesh { positions, faces }
}

/// A smooth mesh of about `triangles` triangles: vertices that triangles share are one.
pub(super) fn smooth(triangles: usize) -> IndexedMesh {
    let mut numbers: HashMap<[u64; 3], u32> = HashMap::new();
    let mut positions = Vec::new();
    let mut number = |p: Vec3| {
        let key = p.to_array().map(f64::to_bits);
        *numbers.entry(key).or_insert_with(|| {
            positions.push(p);
            positions.len() as u32 - 1
        })
    };
    let triangles = meshes::generate(MeshKind::Smooth, triangles);
    let faces = triangles
        .iter()
        .map(|t| [t.p0, t.p1, t.p2].map(&mut number));
    let faces = faces.collect();
    mesh(positions, faces)
}

/// The unit icosahedron, each triangle divided into four `levels` times: 20 · 4^`levels` triangles.
pub(super) fn icosphere(levels: u32) -> IndexedMesh {
    const FACES: [[u32; 3]; 20] = [
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    let golden = (1.0 + 5_f64.sqrt()) / 2.0;
    let corner = |axis: usize, a: f64, b: f64| {
        let mut p = [0.0; 3];
        p[axis] = a;
        p[(axis + 1) % 3] = b * golden;
        Vec3::from_array(p).normalize()
    };
    // Three rectangles at right angles to each other.
    let corners = [(-1.0, 1.0), (1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let mut vertices: Vec<Vec3> = (0..3)
        .flat_map(|axis| corners.map(|(a, b)| corner(axis, a, b)))
        .collect();
    let mut faces = FACES.to_vec();
    for _ in 0..levels {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let sum = vertices[a as usize] + vertices[b as usize];
                vertices.push(sum.normalize());
                vertices.len() as u32 - 1
            })
        };
        let divide = |[a, b, c]: [u32; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        };
        faces = faces.into_iter().flat_map(divide).collect();
    }
    mesh(vertices, faces)
}

/// A unit sphere of `slices` slices around the z axis and `stacks` stacks: long triangles if there
/// are many more slices.
pub(super) fn uv_sphere(slices: u32, stacks: u32) -> IndexedMesh {
    let mut vertices = vec![Vec3::Z];
    for stack in 1..stacks {
        let theta = std::f64::consts::PI * f64::from(stack) / f64::from(stacks);
        for slice in 0..slices {
            let phi = std::f64::consts::TAU * f64::from(slice) / f64::from(slices);
            let across = math::sin(theta);
            let (x, y) = (across * math::cos(phi), across * math::sin(phi));
            vertices.push(Vec3::new(x, y, math::cos(theta)));
        }
    }
    vertices.push(Vec3::NEG_Z);
    let south = vertices.len() as u32 - 1;
    let at = |stack: u32, slice: u32| 1 + (stack - 1) * slices + slice % slices;
    let mut faces = Vec::new();
    for j in 0..slices {
        faces.push([0, at(1, j), at(1, j + 1)]);
        faces.push([south, at(stacks - 1, j + 1), at(stacks - 1, j)]);
        for i in 1..stacks - 1 {
            let [a, b] = [at(i, j), at(i, j + 1)];
            let [c, d] = [at(i + 1, j), at(i + 1, j + 1)];
            faces.extend([[a, c, d], [a, d, b]]);
        }
    }
    mesh(vertices, faces)
}

/// A closed block over `size` by `size` squares: heights from 1 to 20 at integer points above, the
/// plane z = 0 below.
pub(crate) fn terrain(random: &mut Random, size: usize) -> IndexedMesh {
    let points = || (0..=size).flat_map(|i| (0..=size).map(move |j| (i as f64, j as f64)));
    let top = points().map(|(x, y)| Vec3::new(x, y, 1.0 + random.below(20) as f64));
    let mut vertices: Vec<Vec3> = top.collect();
    let below = vertices.len() as u32;
    vertices.extend(points().map(|(x, y)| Vec3::new(x, y, 0.0)));
    let n = size as u32;
    let at = |i: u32, j: u32| i * (n + 1) + j;
    let mut faces = Vec::new();
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        faces.extend([[a, b, c], [a, c, d]]);
        faces.extend([[a, c, b], [a, d, c]].map(|face| face.map(|vertex| vertex + below)));
    }
    for k in 0..n {
        let sides = [
            (at(k, 0), at(k + 1, 0)),
            (at(n, k), at(n, k + 1)),
            (at(k + 1, n), at(k, n)),
            (at(0, k + 1), at(0, k)),
        ];
        for (p, q) in sides {
            faces.extend([[below + p, below + q, q], [below + p, q, p]]);
        }
    }
    mesh(vertices, faces)
}

/// `count` rectangles in the plane z = 0, 4,096 long and 1 wide, of two triangles each.
pub(super) fn slivers(count: u32) -> IndexedMesh {
    let rows = 0..=count;
    let vertices = rows.flat_map(|y| [0.0, 4096.0].map(|x| Vec3::new(x, f64::from(y), 0.0)));
    let rows = (0..count).map(|row| 2 * row);
    let faces = rows.flat_map(|a| [[a, a + 1, a + 3], [a, a + 3, a + 2]]);
    mesh(vertices, faces.collect())
}

/// An edge of a convex surface.
pub(super) struct Edge {
    /// Its ends.
    pub(super) ends: [Vec3; 2],
    /// The outward normals of the two faces that meet at it.
    pub(super) normals: [Vec3; 2],
}

/// A truncated pyramid over the plane z = 0, 8 wide and 4 high, and its edges. Two edges of the
/// base are parallel to an axis and two are not. The base is open: its edges are the rim of the
/// mesh. Each face is a grid of triangles, with coordinates that are multiples of 1/16.
pub(super) fn open_pyramid() -> (IndexedMesh, Vec<Edge>) {
    let base =
        [[-4.0, -4.0], [4.0, -4.0], [2.0, 4.0], [-4.0, 2.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    let top = base.map(|p| p / 2.0 + 4.0 * Vec3::Z);
    let side = |i: usize| [base[i], base[(i + 1) % 4], top[(i + 1) % 4], top[i]];
    let normal = |i: usize| {
        let [a, b, _, d] = side(i);
        (b - a).cross(d - a).normalize()
    };
    let edges = (0..4).flat_map(|i| {
        let [a, b, c, d] = side(i);
        let edge = |ends, normal_beside| Edge {
            ends,
            normals: [normal(i), normal_beside],
        };
        let rim = edge([a, b], Vec3::NEG_Z);
        [
            rim,
            edge([b, c], normal((i + 1) % 4)),
            edge([c, d], Vec3::Z),
        ]
    });
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for [a, b, c, d] in (0..4).map(side).chain([top]) {
        let first = vertices.len() as u32;
        for (i, j) in (0..=4).flat_map(|i| (0..=4).map(move |j| (i, j))) {
            let (u, v) = (f64::from(i) / 4.0, f64::from(j) / 4.0);
            vertices.push((1.0 - v) * (a + u * (b - a)) + v * (d + u * (c - d)));
        }
        for corner in (0..4).flat_map(|i| (0..4).map(move |j| first + 5 * i + j)) {
            let [p, q, r, s] = [0, 5, 6, 1].map(|step| corner + step);
            faces.extend([[p, q, r], [p, r, s]]);
        }
    }
    (mesh(vertices, faces), edges.collect())
}
