//! Leaks: rays from inside a closed mesh, aimed at its edges and vertices, that leave without a
//! hit.
//!
//! A ray from inside must hit, so the oracle is not needed. A leak is a property of adjacent
//! triangles: each may return a hit or a miss for a ray through a common edge, but at least one of
//! them must return a hit. On a terrain with integer coordinates, rays go exactly through vertices,
//! edges and diagonals, and the hits of all its triangles are counted, too.

use super::rays::{Target, stored_ray};
use super::report::GridCounts;
use super::world::{Random, may_contain, terrain};
use judge::cases::probes::{ProbeRng, at, through};
use kernels::{HitF64, Kernel, Precision};
use kit::{Primitive, Ray, Triangle, Vec3};
use meshes::{MeshKind, generate};
use oracle::{KernelClass, may_touch};

/// The closed meshes: one with ordinary triangles, one with needles.
const MESHES: [MeshKind; 2] = [MeshKind::Smooth, MeshKind::Needles];

/// Triangles in each mesh.
const TRIANGLES: usize = 600;

/// Largest coordinate of a ray's origin: inside both meshes.
const INNER: f64 = 0.1;

/// Squares of the integer terrain along each axis, and rays at it.
const GRID: usize = 32;
const GRID_RAYS: usize = 3_000;

/// Meshes and rays, rounded to a precision.
pub(crate) struct ClosedMeshes {
    precision: Precision,
    meshes: Vec<ClosedMesh>,
}

/// One mesh with its rays, each with the triangles that it may hit.
pub(crate) struct ClosedMesh {
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) rays: Vec<(Ray, Vec<u32>)>,
}

impl ClosedMeshes {
    /// Generates both meshes, with `rays` rays in all. Triangles still share their vertices
    /// after rounding: a mesh that is stored in `f32` is still closed.
    pub(crate) fn new(seed: u64, rays: usize, precision: Precision) -> ClosedMeshes {
        let mut dice = ProbeRng::new("cost leaks", seed);
        let meshes = MESHES
            .map(|kind| {
                let exact = generate(kind, TRIANGLES);
                let rays: Vec<Ray> = (0..rays / MESHES.len())
                    .map(|_| stored_ray(&outward(&exact, &mut dice), precision))
                    .collect();
                let triangles = exact.iter().map(|tri| tri.stored(precision)).collect();
                // Kernels in f32 need the wide bound.
                ClosedMesh::new(triangles, rays, |tri, ray| {
                    may_touch(&Primitive::Triangle(tri), ray, KernelClass::Textbook)
                })
            })
            .into();
        ClosedMeshes { precision, meshes }
    }

    /// Returns the meshes.
    pub(crate) fn meshes(&self) -> &[ClosedMesh] {
        &self.meshes
    }

    /// Whether these meshes are rounded for kernels of `precision`.
    pub(crate) fn is_for(&self, precision: Precision) -> bool {
        // The precision of storage matters, not that of the computation.
        self.precision.stored(0.1) == precision.stored(0.1)
    }

    /// Returns the number of rays per million that leave without a hit.
    pub(crate) fn leaks(&self, kernel: &Kernel<Triangle, HitF64>) -> f64 {
        let leaks = self.meshes.iter().map(|mesh| {
            let hits = mesh.hits(kernel).into_iter();
            hits.filter(|hits| *hits == 0).count()
        });
        self.per_million(leaks.sum())
    }

    /// Scales `leaks` to a million rays.
    pub(crate) fn per_million(&self, leaks: usize) -> f64 {
        let rays: usize = self.meshes.iter().map(|mesh| mesh.rays.len()).sum();
        1e6 * leaks as f64 / rays.max(1) as f64
    }
}

impl ClosedMesh {
    /// An integer terrain, a closed block, and rays from inside it, straight up: exactly at
    /// vertices, edges and diagonals. Nothing is rounded, and planes of bounding boxes contain the
    /// rays, whose zeros have both signs.
    pub(crate) fn grid(seed: u64) -> ClosedMesh {
        let triangles = terrain(&mut Random(seed), GRID).flat_triangles();
        let mut dice = ProbeRng::new("cost grid", seed);
        let rays = (0..GRID_RAYS).map(|i| {
            let off = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5]][i % 3];
            let [x, y] = off.map(|off| 1.0 + dice.below(GRID - 2) as f64 + off);
            let [dx, dy] = [0; 2].map(|_| dice.one_of(&[0.0, -0.0]));
            Ray::new(Vec3::new(x, y, 0.5), Vec3::new(dx, dy, 1.0))
        });
        // Other triangles are at least half a square away.
        let near = |tri: &Triangle, ray: &Ray| may_contain(&tri.bounds(), ray);
        ClosedMesh::new(triangles, rays.collect(), near)
    }

    fn new(
        triangles: Vec<Triangle>,
        rays: Vec<Ray>,
        is_near: impl Fn(&Triangle, &Ray) -> bool,
    ) -> ClosedMesh {
        let near = |ray: &Ray| {
            let numbered = (0..).zip(&triangles);
            let near = numbered.filter(|(_, tri)| is_near(tri, ray));
            near.map(|(i, _)| i).collect()
        };
        ClosedMesh {
            rays: rays.into_iter().map(|ray| (ray, near(&ray))).collect(),
            triangles,
        }
    }

    /// The number of triangles that each ray hits.
    pub(crate) fn hits(&self, kernel: &Kernel<Triangle, HitF64>) -> Vec<usize> {
        let triangle = |i: &u32| {
            let tri = &self.triangles[*i as usize];
            // From inside every ray sees a back face, which a culling kernel misses on purpose.
            match kernel.info.culls {
                true => flipped(tri),
                false => *tri,
            }
        };
        let count = |(ray, near): &(Ray, Vec<u32>)| {
            let triangles = near.iter().map(triangle);
            let hits = triangles.filter_map(|tri| kernel.answer(&tri, ray));
            hits.count()
        };
        self.rays.iter().map(count).collect()
    }

    /// Each ray with each triangle that it may hit.
    pub(crate) fn pairs(&self) -> Vec<(Triangle, Ray)> {
        let rays = self.rays.iter();
        let pairs = rays.flat_map(|(ray, near)| {
            let triangles = near.iter().map(|i| self.triangles[*i as usize]);
            triangles.map(|tri| (tri, *ray))
        });
        pairs.collect()
    }
}

impl GridCounts {
    /// From the number of triangles that each ray hits: each crosses the surface once.
    pub(crate) fn of(hits: &[usize]) -> GridCounts {
        let per_million = |is: fn(&usize) -> bool| {
            let count = hits.iter().filter(|hits| is(hits)).count();
            1e6 * count as f64 / hits.len().max(1) as f64
        };
        GridCounts {
            rays: hits.len(),
            lost_per_million: per_million(|hits| *hits == 0),
            miscounted_per_million: per_million(|hits| *hits != 1),
        }
    }
}

/// Returns a ray from near the middle to an edge, or in one of eight cases to a vertex.
fn outward(mesh: &[Triangle], dice: &mut ProbeRng) -> Ray {
    let tri = mesh[dice.below(mesh.len())];
    let along = match dice.below(8) {
        0 => 0.0,
        _ => dice.range(0.0, 1.0),
    };
    let b = dice.one_of(&[[along, 0.0], [0.0, along], [along, 1.0 - along]]);
    through(INNER * dice.in_cube(), at(&tri, b))
}

/// Returns the triangle with its front and back face exchanged.
fn flipped(tri: &Triangle) -> Triangle {
    Triangle {
        p1: tri.p2,
        p2: tri.p1,
        ..*tri
    }
}
