//! The hard cases: each is a mesh with rays, from a seed.
//!
//! Every coordinate is rounded to single precision before the truth is computed, so a library that
//! works in `f32` loses nothing when it reads the case. Rays at edges start inside a closed mesh,
//! or above a closed terrain: whatever a library rounds, a miss is wrong. Those of `beside` miss by
//! far more than single precision rounds: a hit is wrong. So no ray is undecidable, apart from
//! those of [`Measure::Found`], where libraries have different conventions, and from one in 25 of
//! `grid_slanted`, which grazes the terrain at a vertex.

use super::case::{Case, Rounded};
use super::random::Random;
use super::shape::{Edge, icosphere, open_pyramid, slivers, smooth, terrain, uv_sphere};
use Measure::{Count, Found, Ulps, Wrong};
use kit::{Ray, Vec3};
use meshes::IndexedMesh;
use serde::{Deserialize, Serialize};

/// What a column measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Measure {
    /// Answers in a million that lose a hit, invent one or have a wrong `t`: wrong for every
    /// library.
    Wrong,
    /// How many rays find the hit, in per cent: libraries agree on no convention.
    Found,
    /// In how many per cent of the rays the number of hits differs from the number of points at
    /// which the ray crosses the surface.
    Count,
    /// The largest error of `t`, in units in the last place of the library's precision.
    Ulps,
}

/// A hard case.
pub struct Column {
    /// The name, as in the stored table.
    pub name: &'static str,
    /// What it measures.
    pub measure: Measure,
    /// What the rays do, for the heads of tables and plots.
    pub title: &'static str,
    make: fn(&mut Random, usize) -> Case,
}

impl Column {
    /// The case of this column with at most `rays` rays. More rays begin with the same ones.
    pub fn case(&self, seed: u64, rays: usize) -> Case {
        // Each column has its own random numbers, so a new column changes no other.
        let hash = self.name.bytes().fold(seed, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
        });
        (self.make)(&mut Random(hash), rays)
    }
}

const fn column(
    name: &'static str,
    measure: Measure,
    title: &'static str,
    make: fn(&mut Random, usize) -> Case,
) -> Column {
    Column {
        name,
        measure,
        title,
        make,
    }
}

/// All columns, in the order of the table.
pub static COLUMNS: [Column; 25] = [
    column("round_edge", Wrong, "round mesh, at edges", |random, n| {
        from_inside(random, icosphere(3), n, Aim::Edge)
    }),
    column(
        "round_vertex",
        Wrong,
        "round mesh, at vertices",
        |random, n| from_inside(random, icosphere(3), n, Aim::Vertex),
    ),
    column("needle_edge", Wrong, "needles, at edges", |random, n| {
        from_inside(random, uv_sphere(400, 8), n, Aim::Edge)
    }),
    column(
        "needle_vertex",
        Wrong,
        "needles, at vertices",
        |random, n| from_inside(random, uv_sphere(400, 8), n, Aim::Vertex),
    ),
    column(
        "grid_vertex",
        Wrong,
        "integer terrain, at vertices",
        |random, n| down(random, n, 0.0, 0.0),
    ),
    column(
        "grid_edge",
        Wrong,
        "integer terrain, at edges",
        |random, n| down(random, n, 0.5, 0.0),
    ),
    column(
        "grid_diagonal",
        Wrong,
        "integer terrain, at diagonals",
        |random, n| down(random, n, 0.5, 0.5),
    ),
    column(
        "grid_inside",
        Wrong,
        "integer terrain, inside triangles",
        |random, n| down(random, n, 0.5, 0.25),
    ),
    column(
        "grid_slanted",
        Wrong,
        "integer terrain, in a plane of box faces",
        slanted,
    ),
    column("far_1e4", Wrong, "start 2^14 (1.6e4) away", |random, n| {
        from_afar(random, n, 14)
    }),
    column("far_1e6", Wrong, "start 2^20 (1e6) away", |random, n| {
        from_afar(random, n, 20)
    }),
    column("far_1e8", Wrong, "start 2^27 (1.3e8) away", |random, n| {
        from_afar(random, n, 27)
    }),
    column("small", Wrong, "a mesh of 2^-20 (1e-6)", |random, n| {
        scaled(random, n, -20, 0)
    }),
    column("large", Wrong, "a mesh of 2^20 (1e6)", |random, n| {
        scaled(random, n, 20, 0)
    }),
    column(
        "short_direction",
        Wrong,
        "directions of 2^-20 (1e-6)",
        |random, n| scaled(random, n, 0, -20),
    ),
    column(
        "long_direction",
        Wrong,
        "directions of 2^20 (1e6)",
        |random, n| scaled(random, n, 0, 20),
    ),
    column("sliver", Wrong, "slivers, inside", at_slivers),
    column(
        "duplicates",
        Wrong,
        "every triangle twice, at edges",
        duplicates,
    ),
    column(
        "nan_vertex",
        Wrong,
        "one vertex is NaN, at the others",
        nan_vertex,
    ),
    column("beside", Wrong, "open mesh, just beside its edges", beside),
    column(
        "at_start",
        Found,
        "the hit is at the range's start",
        |random, n| ends(random, n, |t| (t, 2.0 * t)),
    ),
    column(
        "at_end",
        Found,
        "the hit is at the range's end",
        |random, n| ends(random, n, |t| (0.0, t)),
    ),
    column(
        "on_surface",
        Found,
        "the ray starts on the surface",
        |random, n| {
            let mut case = ends(random, n, |_| (0.0, f64::INFINITY));
            for ray in &mut case.rays {
                ray.o.z = 0.0;
            }
            case
        },
    ),
    column("parity", Count, "hits counted through edges", through),
    column(
        "inner",
        Ulps,
        "error of t, inside triangles",
        |random, n| from_inside(random, icosphere(3), n, Aim::Inner),
    ),
];

/// The case that is timed: 51,200 triangles, rays from around the mesh towards random points in its
/// bounding box.
pub(super) fn speed(seed: u64, rays: usize) -> Case {
    let random = &mut Random(seed);
    let mesh = smooth(51_200);
    let at_mesh = (0..rays).map(|_| {
        let o = (3.0 * random.direction()).rounded();
        let target = Vec3::new(random.signed(), random.signed(), random.signed());
        Ray::new(o, (0.6 * target - o).rounded())
    });
    let rays = at_mesh.collect();
    Case { mesh, rays }
}

/// What a ray aims at.
#[derive(Clone, Copy, PartialEq)]
enum Aim {
    Edge,
    Vertex,
    Inner,
}

/// Rays from near the centre of a closed mesh around the origin.
fn from_inside(random: &mut Random, mesh: IndexedMesh, rays: usize, aim: Aim) -> Case {
    let rays = (0..rays).map(|_| {
        let o = (0.3 * random.unit() * random.direction()).rounded();
        Ray::new(o, (target(random, &mesh, aim) - o).rounded())
    });
    let rays = rays.collect();
    Case { mesh, rays }
}

/// A random point of a random triangle.
fn target(random: &mut Random, mesh: &IndexedMesh, aim: Aim) -> Vec3 {
    let face = mesh.faces[random.below(mesh.faces.len())];
    let first = random.below(3);
    let [a, b, c] = mesh.corners([0, 1, 2].map(|i| face[(first + i) % 3]));
    match aim {
        Aim::Vertex => a,
        Aim::Edge => (a + random.unit() * (b - a)).rounded(),
        // Each weight is at least 1/10, so a rounded direction still hits this triangle.
        Aim::Inner => {
            let [s, t] = [random.unit(), random.unit()].map(|u| 0.1 + 0.35 * u);
            (a + s * (b - a) + t * (c - a)).rounded()
        }
    }
}

/// Rays downwards at integer points of a terrain, moved by less than a square. Every number is a
/// small integer or a quarter.
fn down(random: &mut Random, rays: usize, x: f64, y: f64) -> Case {
    let mesh = terrain(random, SIZE);
    let rays = rays.min(SIZE * SIZE);
    let mut inner = || 1.0 + random.below(SIZE - 2) as f64;
    let rays = (0..rays).map(|_| {
        let o = Vec3::new(inner() + x, inner() + y, 64.0);
        Ray::new(o, Vec3::NEG_Z)
    });
    let rays = rays.collect();
    Case { mesh, rays }
}

/// Squares of the terrain along each axis.
const SIZE: usize = 100;

/// Rays that slant downwards in a plane x = integer, which is full of edges and of faces of
/// bounding boxes: one component of the direction is 0, and the planes of many boxes contain the
/// ray.
fn slanted(random: &mut Random, rays: usize) -> Case {
    let mesh = terrain(random, SIZE);
    let rays = (0..rays.min(SIZE * SIZE)).map(|_| {
        let mut integer = |first: usize, last: usize| (first + random.below(last - first)) as f64;
        let o = Vec3::new(integer(1, SIZE), integer(1, 50), 64.0);
        Ray::new(o, Vec3::new(0.0, integer(0, 2), -4.0))
    });
    let rays = rays.collect();
    Case { mesh, rays }
}

/// Rays along an axis that start 2^`exponent` away from a closed mesh and aim at the inside of a
/// triangle that faces them, as far from its edges as a tenth of its weights.
fn from_afar(random: &mut Random, rays: usize, exponent: i32) -> Case {
    let mesh = icosphere(3);
    let distance = 2_f64.powi(exponent);
    let rays = (0..rays).map(|_| {
        let p = target(random, &mesh, Aim::Inner);
        // The axis that the surface faces most: the triangle is not seen from its edge.
        let axis = p.abs().max_position();
        let mut o = p;
        o[axis] = distance * p[axis].signum();
        let mut d = Vec3::ZERO;
        d[axis] = -p[axis].signum();
        Ray::new(o, d)
    });
    let rays = rays.collect();
    Case { mesh, rays }
}

/// Rays at insides of triangles, with lengths multiplied by 2^`size` and directions by
/// 2^`direction` as well: no digit changes.
fn scaled(random: &mut Random, rays: usize, size: i32, direction: i32) -> Case {
    let mut case = from_inside(random, icosphere(3), rays, Aim::Inner);
    let (size, direction) = (2_f64.powi(size), 2_f64.powi(direction));
    for vertex in &mut case.mesh.positions {
        *vertex *= size;
    }
    for ray in &mut case.rays {
        ray.o *= size;
        ray.d *= size * direction;
    }
    case
}

/// Rays at right angles to slivers that are 4,096 times as long as wide, at inner points. Every
/// number is a small integer or a half.
fn at_slivers(random: &mut Random, rays: usize) -> Case {
    let mesh = slivers(64);
    let rays = (0..rays).map(|_| {
        // Half of the height of a sliver, at its middle: as far from its edges as possible.
        let (x, y) = (
            2048.0,
            random.below(64) as f64 + [0.25, 0.75][random.below(2)],
        );
        Ray::new(Vec3::new(x, y, 8.0), Vec3::NEG_Z)
    });
    let rays = rays.collect();
    Case { mesh, rays }
}

/// `round_edge` with a second copy of every triangle.
fn duplicates(random: &mut Random, rays: usize) -> Case {
    let mut case = from_inside(random, icosphere(3), rays, Aim::Edge);
    case.mesh.faces.extend(case.mesh.faces.clone());
    case
}

/// Rays at triangles of a mesh in which one vertex is NaN, none of them at a triangle of that
/// vertex.
fn nan_vertex(random: &mut Random, rays: usize) -> Case {
    let mut mesh = icosphere(3);
    let spoilt = 5;
    let whole = |face: &[u32; 3]| !face.contains(&spoilt);
    let faces = mesh.faces.iter().copied().filter(whole).collect();
    let positions = mesh.positions.clone();
    let aimed = from_inside(random, IndexedMesh { positions, faces }, rays, Aim::Inner);
    mesh.positions[spoilt as usize] = Vec3::NAN;
    let rays = aimed.rays;
    Case { mesh, rays }
}

/// Rays that miss an open pyramid by 2^-8 to 2^-16, beside its rim or beside another edge. Three of
/// four directions are along an axis. Single precision rounds coordinates up to 8 by at most 2^-22.
fn beside(random: &mut Random, rays: usize) -> Case {
    let (mesh, edges) = open_pyramid();
    let mut miss = || loop {
        let d = match random.below(4) {
            axis @ 0..3 => [Vec3::X, Vec3::Y, Vec3::Z][axis] * random.signed().signum(),
            _ => random.direction(),
        };
        let Edge { ends, normals } = &edges[random.below(edges.len())];
        let ([a, b], [m, n]) = (*ends, *normals);
        let ([x, y], along) = ([m.dot(d), n.dot(d)], (b - a).normalize().dot(d));
        // The edge is a silhouette, and the ray is almost in the plane of neither face, nor almost
        // parallel to the edge.
        if x * y < 0.0 && x.abs().min(y.abs()) > 0.1 && along.abs() < 0.8 {
            // The normal of the plane through edge and direction, which has the mesh on one side.
            let outward = (y.abs() * m + x.abs() * n).normalize();
            let distance = 2_f64.powi(-8 - random.below(9) as i32);
            let at_edge = a + (0.1 + 0.8 * random.unit()) * (b - a);
            let o = at_edge + distance * outward - (2.0 + 2.0 * random.unit()) * d;
            return Ray::new(o.rounded(), d.rounded());
        }
    };
    let rays = (0..rays).map(|_| miss()).collect();
    Case { mesh, rays }
}

/// Rays down at a terrain without height, at inner points, with ranges made from the exact `t` of
/// the hit.
fn ends(random: &mut Random, rays: usize, range: fn(f64) -> (f64, f64)) -> Case {
    let mut mesh = terrain(random, 16);
    for vertex in &mut mesh.positions {
        vertex.z = 0.0;
    }
    let top = mesh.positions.len() as u32 / 2;
    mesh.faces
        .retain(|face| face.iter().all(|vertex| *vertex < top));
    let rays = (0..rays).map(|_| {
        let mut integer = |count| random.below(count) as f64;
        let o = Vec3::new(integer(16) + 0.5, integer(16) + 0.25, 1.0 + integer(8));
        let (min_t, max_t) = range(o.z);
        Ray {
            o,
            d: Vec3::NEG_Z,
            min_t,
            max_t,
        }
    });
    let rays = rays.collect();
    Case { mesh, rays }
}

/// Rays from outside through an edge of a closed mesh: they cross the surface at two points.
fn through(random: &mut Random, rays: usize) -> Case {
    let mesh = icosphere(3);
    let rays = (0..rays).map(|_| {
        let p = target(random, &mesh, Aim::Edge);
        let inner = 0.3 * random.direction();
        let o = (p + 2.0 * (p - inner)).rounded();
        Ray::new(o, (p - o).rounded())
    });
    let rays = rays.collect();
    Case { mesh, rays }
}
