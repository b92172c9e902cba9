//! A closed mesh seen from outside, with rays that are aimed at its edges.
//!
//! Each pixel close to an edge traces a ray aimed at that edge, up to rounding; at least one of its
//! two triangles must be hit. If neither is, the ray passes through the mesh. Rays through the
//! centres of pixels hit edges so rarely that no leak would be visible; in an animation they are
//! flickering dots.

use kernels::{HitF64, Kernel};
use kit::{Ray, Triangle, Vec3};
use meshes::{MeshKind, generate};
use pictures::Image;
use pictures::image::Rgb;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::LazyLock;

pub(crate) const SIZE: [u32; 2] = [300, 240];
pub(crate) const TRIANGLES: usize = 600;

/// Position of the camera, which looks at the origin; the mesh is in the cube from -1 to 1.
const EYE: Vec3 = Vec3::new(1.6, 1.4, 2.4);

/// Width of the picture at the origin.
const WIDTH: f64 = 2.1;

/// Pixels at most this far from an edge, in pixels, aim at it.
pub(crate) const NEAR: f64 = 0.8;

/// A hit farther away than this multiple of the edge's distance is on another side of the mesh.
pub(crate) const FARTHEST: f64 = 1.0 + 1e-3;

/// No surface has this colour.
const MAGENTA: Rgb = [255, 0, 255];

/// A test of triangles.
pub(crate) type TriangleKernel = Kernel<Triangle, HitF64>;

/// The visible triangles of the mesh, and the rays of the pixels.
pub(crate) struct MeshView {
    mesh: Vec<Triangle>,
    /// The visible triangle and the ray of each pixel, in rows from the top; `None` for the
    /// background.
    pixels: Vec<Option<PixelHit>>,
}

struct PixelHit {
    ray: Ray,
    triangle: usize,
    at_edge: bool,
}

impl MeshView {
    /// Returns the picture, which the textbook's kernel traces once, the first of
    /// [`kernels::triangles`]. `None` if there are no known kernels.
    pub(crate) fn traced() -> Option<&'static MeshView> {
        static VIEW: LazyLock<Option<MeshView>> =
            LazyLock::new(|| kernels::triangles().first().map(MeshView::trace));
        VIEW.as_ref()
    }

    fn trace(textbook: &TriangleKernel) -> MeshView {
        let mesh = generate(MeshKind::Smooth, TRIANGLES);
        let edges = inner_edges(&mesh);
        let [w, h] = SIZE;
        let pixels = (0..w * h)
            .into_par_iter()
            .map(|i| {
                let ray = camera_ray(i % w, i / w);
                let (triangle, hit) = closest(textbook, &mesh, &ray)?;
                let aimed = aim_at_edge(&mesh[triangle], &edges[triangle], &ray, hit.t);
                Some(PixelHit {
                    ray: aimed.unwrap_or(ray),
                    triangle,
                    at_edge: aimed.is_some(),
                })
            })
            .collect();
        MeshView { mesh, pixels }
    }

    /// The number of pixels whose rays are aimed at an edge.
    pub(crate) fn at_edges(&self) -> usize {
        self.pixels
            .iter()
            .flatten()
            .filter(|hit| hit.at_edge)
            .count()
    }

    /// The pixels whose rays pass through the mesh with `kernel`, in order.
    pub(crate) fn leaks(&self, kernel: &TriangleKernel) -> Vec<u32> {
        let pixels = self.pixels.par_iter().enumerate();
        let leaks = pixels.filter(|(_, hit)| {
            hit.as_ref()
                .is_some_and(|hit| hit.at_edge && self.is_leak(kernel, hit))
        });
        leaks.map(|(pixel, _)| pixel as u32).collect()
    }

    /// The rays that are aimed at an edge, with their pixels, and the mesh: for code that runs
    /// elsewhere.
    pub(crate) fn rays_at_edges(&self) -> (Vec<u32>, Vec<Ray>, &[Triangle]) {
        let pixels = (0..).zip(&self.pixels);
        let aimed = pixels.filter_map(|(pixel, hit)| {
            let hit = hit.as_ref().filter(|hit| hit.at_edge)?;
            Some((pixel, hit.ray))
        });
        let (pixels, rays) = aimed.unzip();
        (pixels, rays, &self.mesh)
    }

    /// Renders the picture with these pixels, in order, in magenta.
    pub(crate) fn picture(&self, leaks: &[u32]) -> Image {
        let [w, _] = SIZE;
        Image::from_fn(SIZE, |x, y| {
            let pixel = y * w + x;
            match &self.pixels[pixel as usize] {
                _ if leaks.binary_search(&pixel).is_ok() => MAGENTA,
                None => [255; 3],
                Some(hit) => shade(&self.mesh[hit.triangle]),
            }
        })
    }

    /// Whether the ray misses all triangles at the distance of its edge.
    fn is_leak(&self, kernel: &TriangleKernel, hit: &PixelHit) -> bool {
        let hits = self
            .mesh
            .iter()
            .filter_map(|tri| kernel.answer(tri, &hit.ray));
        // The ray reaches its edge at t = 1.
        !hits.map(|hit| hit.t).any(|t| t <= FARTHEST)
    }
}

/// Returns the ray through the centre of the pixel in column `x` and row `y` from the top left.
fn camera_ray(x: u32, y: u32) -> Ray {
    let [w, h] = SIZE.map(f64::from);
    let backward = EYE.normalize();
    let right = Vec3::Y.cross(backward).normalize();
    let up = backward.cross(right);
    let across = (f64::from(x) + 0.5) / w - 0.5;
    let along = (0.5 * h - f64::from(y) - 0.5) / w;
    let target = WIDTH * (across * right + along * up);
    Ray::new(EYE, (target - EYE).normalize())
}

fn closest(kernel: &TriangleKernel, mesh: &[Triangle], ray: &Ray) -> Option<(usize, HitF64)> {
    let hits = mesh.iter().enumerate();
    hits.filter_map(|(i, tri)| Some((i, kernel.answer(tri, ray)?)))
        .min_by(|a, b| a.1.t.total_cmp(&b.1.t))
}

/// For each triangle, whether the edges opposite to its first, second and third vertex are shared
/// with another triangle that faces the camera: a ray that misses the mesh at its silhouette is no
/// leak.
fn inner_edges(mesh: &[Triangle]) -> Vec<[bool; 3]> {
    let corner = |v: Vec3| v.to_array().map(f64::to_bits);
    let key = |a: Vec3, b: Vec3| {
        let (a, b) = (corner(a), corner(b));
        (a.min(b), a.max(b))
    };
    let edges = |tri: &Triangle| {
        [
            key(tri.p1, tri.p2),
            key(tri.p2, tri.p0),
            key(tri.p0, tri.p1),
        ]
    };
    let mut facing: HashMap<_, u32> = HashMap::new();
    for tri in mesh.iter().filter(|tri| faces_eye(tri)) {
        for edge in edges(tri) {
            *facing.entry(edge).or_default() += 1;
        }
    }
    let both = |edge| facing.get(&edge).is_some_and(|count| *count >= 2);
    mesh.iter().map(|tri| edges(tri).map(both)).collect()
}

fn faces_eye(tri: &Triangle) -> bool {
    // The mesh is star-shaped about the origin, so its outside faces away from the origin.
    let n = normal(tri);
    n.dot(tri.p0) * n.dot(EYE - tri.p0) > 0.0
}

fn normal(tri: &Triangle) -> Vec3 {
    (tri.p1 - tri.p0).cross(tri.p2 - tri.p0)
}

/// Returns the ray from the same origin to the nearest point of an edge, if it is closer than
/// [`NEAR`] pixels. The ray reaches the edge at `t = 1`.
fn aim_at_edge(tri: &Triangle, inner: &[bool; 3], ray: &Ray, t: f64) -> Option<Ray> {
    let p = ray.at(t);
    let pixel = NEAR * WIDTH / f64::from(SIZE[0]) * t / EYE.length();
    let corners = [tri.p0, tri.p1, tri.p2];
    let on_edge = |i: usize| {
        let (a, b) = (corners[(i + 1) % 3], corners[(i + 2) % 3]);
        let along = (b - a) * ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        a + along
    };
    let nearest = (0..3)
        .filter(|i| inner[*i])
        .map(on_edge)
        .min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))?;
    (nearest.distance(p) < pixel).then(|| Ray::new(ray.o, nearest - ray.o))
}

/// Shades a triangle in grey, brightest if it faces a light above the camera.
fn shade(tri: &Triangle) -> Rgb {
    let n = normal(tri).normalize();
    let lamp = (EYE + Vec3::Y).normalize();
    [(90.0 + 140.0 * n.dot(lamp).abs()) as u8; 3]
}
