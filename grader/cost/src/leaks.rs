//! Leaks: rays from inside a closed mesh, aimed at its edges and vertices, that leave without a
//! hit.
//!
//! A ray from inside must hit, so the oracle is not needed. A leak is a property of adjacent
//! triangles: each may return a hit or a miss for a ray through a common edge, but at least one of
//! them must return a hit.

use super::rays::{Target, stored_ray};
use judge::cases::probes::{ProbeRng, at, through};
use kernels::{HitF64, Kernel, Precision};
use kit::{Primitive, Ray, Triangle};
use meshes::{MeshKind, generate};
use oracle::{KernelClass, may_touch};

/// The closed meshes: one with ordinary triangles, one with needles.
const MESHES: [MeshKind; 2] = [MeshKind::Smooth, MeshKind::Needles];

/// Triangles in each mesh.
const TRIANGLES: usize = 600;

/// Largest coordinate of a ray's origin: inside both meshes.
const INNER: f64 = 0.1;

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
                ClosedMesh::new(triangles, rays)
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
            let triangles: Vec<Triangle> = mesh
                .triangles
                .iter()
                // From inside every ray sees a back face, which a culling kernel misses on purpose.
                .map(|tri| {
                    if kernel.info.culls {
                        flipped(tri)
                    } else {
                        *tri
                    }
                })
                .collect();
            let hits = |ray: &Ray, near: &[u32]| {
                let mut near = near.iter();
                near.any(|i| kernel.answer(&triangles[*i as usize], ray).is_some())
            };
            let rays = mesh.rays.iter();
            rays.filter(|(ray, near)| !hits(ray, near)).count()
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
    fn new(triangles: Vec<Triangle>, rays: Vec<Ray>) -> ClosedMesh {
        let near = |ray: &Ray| {
            let numbered = (0..).zip(&triangles);
            numbered
                // Kernels in f32 need the wide bound.
                .filter(|(_, tri)| may_touch(&Primitive::Triangle(tri), ray, KernelClass::Textbook))
                .map(|(i, _)| i)
                .collect()
        };
        ClosedMesh {
            rays: rays.into_iter().map(|ray| (ray, near(&ray))).collect(),
            triangles,
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
