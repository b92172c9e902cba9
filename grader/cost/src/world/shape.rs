//! The meshes of the hard cases, with vertices in single precision.

use super::case::Rounded;
use judge::cases::probes::ProbeRng;
use kit::{Vec3, math};
use meshes::IndexedMesh;
use std::collections::HashMap;

/// The mesh with its vertices rounded.
fn rounded(mut positions: Vec<Vec3>, faces: Vec<[u32; 3]>) -> IndexedMesh {
    for p in &mut positions {
        *p = p.rounded();
    }
    IndexedMesh { positions, faces }
}

/// A sphere of about `triangles` triangles with bumps: vertices that triangles share are one.
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
    let triangles = meshes::generate(meshes::MeshKind::Smooth, triangles);
    let faces = triangles
        .iter()
        .map(|t| [t.p0, t.p1, t.p2].map(&mut number));
    let faces = faces.collect();
    rounded(positions, faces)
}

/// The faces of an icosahedron.
const FACES: [[u32; 3]; 20] = [
    [0, 2, 1],
    [0, 1, 6],
    [0, 8, 2],
    [0, 6, 4],
    [0, 4, 8],
    [1, 2, 7],
    [1, 5, 6],
    [1, 7, 5],
    [2, 3, 7],
    [2, 8, 3],
    [3, 9, 7],
    [3, 8, 10],
    [3, 10, 9],
    [4, 6, 11],
    [4, 10, 8],
    [4, 11, 10],
    [5, 11, 6],
    [5, 7, 9],
    [5, 9, 11],
    [9, 10, 11],
];

/// The unit icosahedron, each triangle divided into four `levels` times: 20 · 4^`levels` triangles.
pub(super) fn icosphere(levels: u32) -> IndexedMesh {
    let golden = (1.0 + 5_f64.sqrt()) / 2.0;
    // Three rectangles at right angles to each other.
    let corners = [-1.0, 1.0].into_iter().flat_map(|a| {
        let pairs = [-golden, golden].into_iter();
        pairs.flat_map(move |b| [[a, b, 0.0], [0.0, a, b], [b, 0.0, a]])
    });
    let corners = corners.map(|p| Vec3::from_array(p).normalize());
    let mut positions: Vec<Vec3> = corners.collect();
    let mut faces = FACES.to_vec();
    for _ in 0..levels {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let sum = positions[a as usize] + positions[b as usize];
                positions.push(sum.normalize());
                positions.len() as u32 - 1
            })
        };
        let divide = |[a, b, c]: [u32; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        };
        faces = faces.into_iter().flat_map(divide).collect();
    }
    rounded(positions, faces)
}

/// A unit sphere of `slices` slices around the z axis and `stacks` stacks: long triangles if there
/// are many more slices.
pub(super) fn uv_sphere(slices: u32, stacks: u32) -> IndexedMesh {
    let mut positions = vec![Vec3::Z];
    for stack in 1..stacks {
        let theta = std::f64::consts::PI * f64::from(stack) / f64::from(stacks);
        for slice in 0..slices {
            let phi = std::f64::consts::TAU * f64::from(slice) / f64::from(slices);
            let across = math::sin(theta);
            let (x, y) = (across * math::cos(phi), across * math::sin(phi));
            positions.push(Vec3::new(x, y, math::cos(theta)));
        }
    }
    positions.push(Vec3::NEG_Z);
    let south = positions.len() as u32 - 1;
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
    rounded(positions, faces)
}

/// The squares of a grid of `size` by `size` squares, each as two triangles around the diagonal
/// from its first corner.
fn squares(size: usize) -> Vec<[u32; 3]> {
    let n = size as u32;
    let at = |i: u32, j: u32| i * (n + 1) + j;
    let square = |(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let places = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    places.flat_map(square).collect()
}

/// The points of that grid, at `height`.
fn points(size: usize, mut height: impl FnMut() -> f64) -> Vec<Vec3> {
    let places = (0..=size).flat_map(|i| (0..=size).map(move |j| (i as f64, j as f64)));
    places.map(|(x, y)| Vec3::new(x, y, height())).collect()
}

/// The square from 0 to `size` in the plane z = 0, of two triangles for each unit square.
pub(super) fn plane(size: usize) -> IndexedMesh {
    rounded(points(size, || 0.0), squares(size))
}

/// A closed block over `size` by `size` squares: heights from 1 to 20 at integer points above, the
/// plane z = 0 below.
pub(crate) fn terrain(random: &mut ProbeRng, size: usize) -> IndexedMesh {
    let mut positions = points(size, || 1.0 + random.below(20) as f64);
    let below = positions.len() as u32;
    positions.extend(points(size, || 0.0));
    let mut faces = squares(size);
    let floor = faces
        .iter()
        .map(|[a, b, c]| [a + below, c + below, b + below]);
    let floor: Vec<[u32; 3]> = floor.collect();
    faces.extend(floor);
    let n = size as u32;
    let at = |i: u32, j: u32| i * (n + 1) + j;
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
    rounded(positions, faces)
}

/// `count` rectangles in the plane z = 0, 4,096 long and 1 wide, of two triangles each.
pub(super) fn slivers(count: u32) -> IndexedMesh {
    let rows = 0..=count;
    let ends = rows.flat_map(|y| [0.0, 4096.0].map(|x| Vec3::new(x, f64::from(y), 0.0)));
    let firsts = (0..count).map(|row| 2 * row);
    let faces = firsts.flat_map(|a| [[a, a + 1, a + 3], [a, a + 3, a + 2]]);
    rounded(ends.collect(), faces.collect())
}
