//! The hard cases: each is a mesh with rays, from a seed.
//!
//! Every coordinate is rounded to single precision before the truth is computed, so a library that
//! works in `f32` loses nothing when it reads the case. Rays at edges start inside a closed mesh, or
//! above a closed terrain: whatever a library rounds, a miss is wrong. So no ray is undecidable,
//! apart from those of [`Measure::Found`], where libraries have different conventions.

use super::case::{Case, Rounded};
use super::shape::{icosphere, plane, slivers, smooth, terrain, uv_sphere};
use Measure::{Count, Found, Ulps, Wrong};
use judge::cases::probes::{ProbeRng, at};
use kit::{Ray, Triangle, Vec3};
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
    make: fn(&mut ProbeRng, usize) -> Case,
}

impl Column {
    /// The case of this column with at most `rays` rays. More rays begin with the same ones.
    pub fn case(&self, seed: u64, rays: usize) -> Case {
        (self.make)(&mut ProbeRng::new(self.name, seed), rays)
    }
}

const fn column(
    name: &'static str,
    measure: Measure,
    title: &'static str,
    make: fn(&mut ProbeRng, usize) -> Case,
) -> Column {
    Column {
        name,
        measure,
        title,
        make,
    }
}

/// All columns, in the order of the table.
pub static COLUMNS: [Column; 24] = [
    column("round_edge", Wrong, "round mesh, at edges", |dice, n| {
        from_inside(dice, icosphere(3), n, Aim::Edge)
    }),
    column(
        "round_vertex",
        Wrong,
        "round mesh, at vertices",
        |dice, n| from_inside(dice, icosphere(3), n, Aim::Vertex),
    ),
    column("needle_edge", Wrong, "needles, at edges", |dice, n| {
        from_inside(dice, uv_sphere(400, 8), n, Aim::Edge)
    }),
    column("needle_vertex", Wrong, "needles, at vertices", |dice, n| {
        from_inside(dice, uv_sphere(400, 8), n, Aim::Vertex)
    }),
    column(
        "grid_vertex",
        Wrong,
        "integer terrain, at vertices",
        |dice, n| down(dice, n, 0.0, 0.0),
    ),
    column(
        "grid_edge",
        Wrong,
        "integer terrain, at edges",
        |dice, n| down(dice, n, 0.5, 0.0),
    ),
    column(
        "grid_diagonal",
        Wrong,
        "integer terrain, at diagonals",
        |dice, n| down(dice, n, 0.5, 0.5),
    ),
    column(
        "grid_inside",
        Wrong,
        "integer terrain, inside triangles",
        |dice, n| down(dice, n, 0.5, 0.25),
    ),
    column(
        "grid_slanted",
        Wrong,
        "integer terrain, in a plane of box faces",
        slanted,
    ),
    column("far_1e4", Wrong, "start 2^14 (1.6e4) away", |dice, n| {
        from_afar(dice, n, 14)
    }),
    column("far_1e6", Wrong, "start 2^20 (1e6) away", |dice, n| {
        from_afar(dice, n, 20)
    }),
    column("far_1e8", Wrong, "start 2^27 (1.3e8) away", |dice, n| {
        from_afar(dice, n, 27)
    }),
    column("small", Wrong, "a mesh of 2^-20 (1e-6)", |dice, n| {
        scaled(dice, n, -20, 0)
    }),
    column("large", Wrong, "a mesh of 2^20 (1e6)", |dice, n| {
        scaled(dice, n, 20, 0)
    }),
    column(
        "short_direction",
        Wrong,
        "directions of 2^-20 (1e-6)",
        |dice, n| scaled(dice, n, 0, -20),
    ),
    column(
        "long_direction",
        Wrong,
        "directions of 2^20 (1e6)",
        |dice, n| scaled(dice, n, 0, 20),
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
    column(
        "at_start",
        Found,
        "the hit is at the range's start",
        |dice, n| ends(dice, n, |t| (t, 2.0 * t)),
    ),
    column(
        "at_end",
        Found,
        "the hit is at the range's end",
        |dice, n| ends(dice, n, |t| (0.0, t)),
    ),
    column(
        "on_surface",
        Found,
        "the ray starts on the surface",
        |dice, n| {
            let mut case = ends(dice, n, |_| (0.0, f64::INFINITY));
            for ray in &mut case.rays {
                ray.o.z = 0.0;
            }
            case
        },
    ),
    column("parity", Count, "hits counted through edges", through),
    column("inner", Ulps, "error of t, inside triangles", |dice, n| {
        from_inside(dice, icosphere(3), n, Aim::Inner)
    }),
];

/// The case that is timed: 51,200 triangles, rays from around the mesh towards random points of its
/// bounding box. Rays of 8 x 8 that follow each other start at one point, as those of a camera.
pub(super) fn speed(seed: u64, rays: usize) -> Case {
    let dice = &mut ProbeRng::new("speed", seed);
    let mesh = smooth(51_200);
    let tiles = (0..rays / 64).flat_map(|_| {
        let o = (3.0 * dice.direction()).rounded();
        let target = 0.5 * dice.in_cube();
        let across = (target - o).any_orthonormal_vector();
        let up = (target - o).normalize().cross(across);
        (0..64).map(move |i| {
            let [x, y] = [i % 8, i / 8].map(|k| 0.004 * f64::from(k));
            Ray::new(o, (target + x * across + y * up - o).rounded())
        })
    });
    let rays = tiles.collect();
    Case { mesh, rays }
}

/// What a ray aims at.
#[derive(Clone, Copy, PartialEq)]
enum Aim {
    Edge,
    Vertex,
    Inner,
}

/// The mesh with `count` rays.
fn aimed(mesh: IndexedMesh, count: usize, mut ray: impl FnMut(&IndexedMesh) -> Ray) -> Case {
    let rays = (0..count).map(|_| ray(&mesh)).collect();
    Case { mesh, rays }
}

/// Rays from near the centre of a closed mesh around the origin.
fn from_inside(dice: &mut ProbeRng, mesh: IndexedMesh, count: usize, aim: Aim) -> Case {
    aimed(mesh, count, |mesh| {
        let o = (dice.range(0.0, 0.3) * dice.direction()).rounded();
        Ray::new(o, (target(dice, mesh, aim) - o).rounded())
    })
}

/// A random point of a random triangle.
fn target(dice: &mut ProbeRng, mesh: &IndexedMesh, aim: Aim) -> Vec3 {
    let face = mesh.faces[dice.below(mesh.faces.len())];
    let first = dice.below(3);
    let [a, b, c] = mesh.corners([0, 1, 2].map(|i| face[(first + i) % 3]));
    match aim {
        Aim::Vertex => a,
        Aim::Edge => (a + dice.range(0.0, 1.0) * (b - a)).rounded(),
        // Each weight is at least 1/10, so a rounded direction still hits this triangle.
        Aim::Inner => at(&Triangle::flat(a, b, c), dice.inside(0.1)).rounded(),
    }
}

/// Squares of the terrain along each axis.
const SIZE: usize = 100;

/// Rays downwards at integer points of a terrain, moved by less than a square. Every number is a
/// small integer or a quarter.
fn down(dice: &mut ProbeRng, count: usize, x: f64, y: f64) -> Case {
    let mesh = terrain(dice, SIZE);
    aimed(mesh, count.min(SIZE * SIZE), |_| {
        let mut inner = || 1.0 + dice.below(SIZE - 2) as f64;
        Ray::new(Vec3::new(inner() + x, inner() + y, 64.0), Vec3::NEG_Z)
    })
}

/// Rays that slant downwards in a plane x = integer, which is full of edges and of faces of bounding
/// boxes: one component of the direction is 0, and the planes of many boxes contain the ray.
fn slanted(dice: &mut ProbeRng, count: usize) -> Case {
    let mesh = terrain(dice, SIZE);
    aimed(mesh, count.min(SIZE * SIZE), |_| {
        let mut integer = |first: usize, end: usize| (first + dice.below(end - first)) as f64;
        let o = Vec3::new(integer(1, SIZE), integer(1, 50), 64.0);
        Ray::new(o, Vec3::new(0.0, integer(0, 2), -4.0))
    })
}

/// Rays along an axis that start 2^`exponent` away from a closed mesh and aim at the inside of a
/// triangle that faces them.
fn from_afar(dice: &mut ProbeRng, count: usize, exponent: i32) -> Case {
    let distance = 2_f64.powi(exponent);
    aimed(icosphere(3), count, |mesh| {
        let p = target(dice, mesh, Aim::Inner);
        // The axis that the surface faces most: the triangle is not seen from its edge.
        let axis = p.abs().max_position();
        let (mut o, mut d) = (p, Vec3::ZERO);
        o[axis] = distance * p[axis].signum();
        d[axis] = -p[axis].signum();
        Ray::new(o, d)
    })
}

/// Rays at the inside of triangles, with lengths multiplied by 2^`size` and directions by
/// 2^`direction` as well: no digit changes.
fn scaled(dice: &mut ProbeRng, count: usize, size: i32, direction: i32) -> Case {
    let mut case = from_inside(dice, icosphere(3), count, Aim::Inner);
    let (size, direction) = (2_f64.powi(size), 2_f64.powi(direction));
    for p in &mut case.mesh.positions {
        *p *= size;
    }
    for ray in &mut case.rays {
        ray.o *= size;
        ray.d *= size * direction;
    }
    case
}

/// Rays at right angles to slivers that are 4,096 times as long as wide, halfway between their long
/// edges at their middle: as far from edges as possible. Every number is an integer or a quarter.
fn at_slivers(dice: &mut ProbeRng, count: usize) -> Case {
    aimed(slivers(64), count, |_| {
        let y = dice.below(64) as f64 + dice.one_of(&[0.25, 0.75]);
        Ray::new(Vec3::new(2048.0, y, 8.0), Vec3::NEG_Z)
    })
}

/// Rays at edges of a mesh with a second copy of every triangle.
fn duplicates(dice: &mut ProbeRng, count: usize) -> Case {
    let mut case = from_inside(dice, icosphere(3), count, Aim::Edge);
    case.mesh.faces.extend(case.mesh.faces.clone());
    case
}

/// Rays at triangles of a mesh in which one vertex is NaN, none of them at a triangle of that
/// vertex.
fn nan_vertex(dice: &mut ProbeRng, count: usize) -> Case {
    let spoilt = 5;
    let mut mesh = icosphere(3);
    let mut whole = mesh.clone();
    whole.faces.retain(|face| !face.contains(&spoilt));
    let rays = from_inside(dice, whole, count, Aim::Inner).rays;
    mesh.positions[spoilt as usize] = Vec3::NAN;
    Case { mesh, rays }
}

/// Rays down at a plane, at inner points of its triangles, with ranges made from the exact `t` of
/// the hit.
fn ends(dice: &mut ProbeRng, count: usize, range: fn(f64) -> (f64, f64)) -> Case {
    aimed(plane(16), count, |_| {
        let mut integer = |count| dice.below(count) as f64;
        let o = Vec3::new(integer(16) + 0.5, integer(16) + 0.25, 1.0 + integer(8));
        let (min_t, max_t) = range(o.z);
        Ray {
            o,
            d: Vec3::NEG_Z,
            min_t,
            max_t,
        }
    })
}

/// Rays from outside through an edge of a closed mesh: they cross the surface at two points.
fn through(dice: &mut ProbeRng, count: usize) -> Case {
    aimed(icosphere(3), count, |mesh| {
        let p = target(dice, mesh, Aim::Edge);
        let inner = 0.3 * dice.direction();
        let o = (p + 2.0 * (p - inner)).rounded();
        Ray::new(o, (p - o).rounded())
    })
}
