//! Leaks: rays from inside a closed mesh, aimed where its triangles meet, that get out without a hit.
//!
//! A ray from inside must hit; so this needs no oracle. It is a matter of triangles together: each may decide a ray
//! through a common edge one way or the other, if only they never both let it pass.

use super::rays::{Target, stored_ray};
use judge::cases::probes::{Dice, at, through};
use kernels::{Found, Kernel, Precision};
use kit::{Primitive, Ray, Triangle};
use meshes::{MeshKind, generate};
use oracle::may_touch;

/// The closed meshes: one of ordinary triangles, one of needles.
const MESHES: [MeshKind; 2] = [MeshKind::Smooth, MeshKind::Needles];

/// Triangles in each.
const TRIANGLES: usize = 600;

/// Rays start this close to the middle at most: inside of both meshes.
const INNER: f64 = 0.1;

/// Meshes and rays, as a precision stores them.
pub(crate) struct Closed {
    precision: Precision,
    meshes: Vec<Mesh>,
}

/// One mesh with its rays, each with the triangles that it may touch.
pub(crate) struct Mesh {
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) rays: Vec<(Ray, Vec<u32>)>,
}

impl Closed {
    /// Both meshes, with `rays` rays in all. Rounded vertices stay common to their triangles: a mesh that is stored
    /// in single is closed, too.
    pub(crate) fn new(seed: u64, rays: usize, precision: Precision) -> Closed {
        let mut dice = Dice::new("cost leaks", seed);
        let meshes = MESHES
            .map(|kind| {
                let exact = generate(kind, TRIANGLES);
                let rays: Vec<Ray> = (0..rays / MESHES.len())
                    .map(|_| stored_ray(&outward(&exact, &mut dice), precision))
                    .collect();
                let triangles = exact.iter().map(|tri| tri.stored(precision)).collect();
                Mesh::new(triangles, rays)
            })
            .into();
        Closed { precision, meshes }
    }

    /// The meshes.
    pub(crate) fn meshes(&self) -> &[Mesh] {
        &self.meshes
    }

    /// Whether this is what a kernel of that precision is asked.
    pub(crate) fn is_for(&self, precision: Precision) -> bool {
        // What is stored decides, not what is computed in.
        self.precision.stored(0.1) == precision.stored(0.1)
    }

    /// Rays a million that find no way to hit anything.
    pub(crate) fn leaks(&self, kernel: &Kernel<Triangle, Found>) -> f64 {
        let leaks = self.meshes.iter().map(|mesh| {
            let triangles: Vec<Triangle> = mesh
                .triangles
                .iter()
                // Seen from inside every triangle shows its back, which a culling kernel means to miss.
                .map(|tri| {
                    if kernel.about.culls {
                        turned(tri)
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

    /// `leaks` of all rays, scaled to a million.
    pub(crate) fn per_million(&self, leaks: usize) -> f64 {
        let rays: usize = self.meshes.iter().map(|mesh| mesh.rays.len()).sum();
        1e6 * leaks as f64 / rays.max(1) as f64
    }
}

impl Mesh {
    fn new(triangles: Vec<Triangle>, rays: Vec<Ray>) -> Mesh {
        let near = |ray: &Ray| {
            let numbered = (0..).zip(&triangles);
            numbered
                .filter(|(_, tri)| may_touch(&Primitive::Triangle(tri), ray))
                .map(|(i, _)| i)
                .collect()
        };
        Mesh {
            rays: rays.into_iter().map(|ray| (ray, near(&ray))).collect(),
            triangles,
        }
    }
}

/// A ray from near the middle to an edge, or in one of eight cases to a vertex.
fn outward(mesh: &[Triangle], dice: &mut Dice) -> Ray {
    let tri = mesh[dice.below(mesh.len())];
    let along = match dice.below(8) {
        0 => 0.0,
        _ => dice.range(0.0, 1.0),
    };
    let b = dice.one_of(&[[along, 0.0], [0.0, along], [along, 1.0 - along]]);
    through(INNER * dice.in_cube(), at(&tri, b))
}

/// The same triangle, its other face in front.
fn turned(tri: &Triangle) -> Triangle {
    Triangle {
        p1: tri.p2,
        p2: tri.p1,
        ..*tri
    }
}
