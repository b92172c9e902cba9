//! Rays that hit triangles in the interior.

use crate::tools::questions::probes::{
    ProbeRng, Probes, brute_force, through, wire_triangle, within,
};
use kit::{Ray, Triangle, Vec3};
use wire::work::{BruteForceWork, TriangleWork};

/// The smallest barycentric weight of a target: large enough that every correct kernel hits.
pub(super) const MARGIN: f64 = 0.02;

pub(super) fn from_side(name: &str, side: f64) -> TriangleWork {
    let mut rng = ProbeRng::new(name, 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let triangle = rng.triangle();
        probes.triangle(&triangle);
        for _ in 0..8 {
            let (b, distance) = (rng.inside(MARGIN), rng.range(0.5, 20.0));
            probes.ray(rng.ray_to(&triangle, b, side, distance));
        }
    }
    probes.of_triangles()
}

pub(super) fn length_of_direction() -> TriangleWork {
    let mut rng = ProbeRng::new("length_of_direction", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let triangle = rng.triangle();
        probes.triangle(&triangle);
        for length in [0.05, 0.25, 0.7, 1.5, 3.0, 40.0] {
            let (b, distance) = (rng.inside(MARGIN), rng.range(0.5, 20.0));
            let side = rng.one_of(&[1.0, -1.0]);
            let ray = rng.ray_to(&triangle, b, side, distance);
            let longer = Ray {
                d: length * ray.d,
                ..ray
            };
            probes.ray(longer);
            // In range only if t is in units of the length of d.
            let t = distance / length;
            probes.ray(within(longer, 0.9 * t, 1.1 * t));
        }
    }
    probes.of_triangles()
}

pub(super) fn interpolated_normals() -> TriangleWork {
    let mut rng = ProbeRng::new("interpolated_normals", 0);
    let mut probes = Probes::default();
    for i in 0..30 {
        let mut triangle = rng.triangle();
        // Normals up to 80 degrees apart: their weighted sum is up to a quarter too short.
        triangle.n1 = (triangle.n1 + 0.8 * rng.direction()).normalize();
        if i % 3 == 0 {
            // Files contain triangles whose winding contradicts their normals.
            std::mem::swap(&mut triangle.p1, &mut triangle.p2);
        }
        probes.triangle(&triangle);
        for b in [
            [0.3, 0.3],
            [0.05, 0.9],
            [0.9, 0.05],
            [0.05, 0.05],
            [0.2, 0.5],
            [0.5, 0.2],
        ] {
            for side in [1.0, -1.0] {
                let distance = rng.range(0.5, 20.0);
                probes.ray(rng.ray_to(&triangle, b, side, distance));
            }
        }
    }
    probes.of_triangles()
}

pub(super) fn close_up() -> TriangleWork {
    let mut rng = ProbeRng::new("close_up", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let triangle = rng.triangle();
        probes.triangle(&triangle);
        for distance in [1e-4, 3e-4, 1e-3, 3e-3, 1e-2] {
            let (b, side) = (rng.inside(MARGIN), rng.one_of(&[1.0, -1.0]));
            probes.ray(rng.ray_to(&triangle, b, side, distance));
        }
    }
    for _ in 0..10 {
        let triangle = small(&rng.triangle());
        probes.triangle(&triangle);
        for _ in 0..5 {
            let (b, side) = (rng.inside(MARGIN), rng.one_of(&[1.0, -1.0]));
            let distance = rng.range(0.05, 5.0);
            probes.ray(rng.ray_to(&triangle, b, side, distance));
        }
    }
    probes.of_triangles()
}

/// The triangle a hundred times as small, like one of 100,000 in a mesh of size 1: its determinant
/// is about 1e-4, far above the 1e-7 or 1e-8 that textbooks take for a ray in its plane.
fn small(triangle: &Triangle) -> Triangle {
    let [p0, p1, p2] = [triangle.p0, triangle.p1, triangle.p2].map(|p| 0.01 * p);
    Triangle {
        p0,
        p1,
        p2,
        ..*triangle
    }
}

/// A heap of triangles, and rays through it from all directions.
fn heap(rng: &mut ProbeRng, triangles: usize, rays: usize) -> BruteForceWork {
    let triangles: Vec<Triangle> = (0..triangles)
        .map(|_| {
            let (t, offset) = (rng.triangle(), 1.2 * rng.in_cube());
            Triangle {
                p0: t.p0 + offset,
                p1: t.p1 + offset,
                p2: t.p2 + offset,
                ..t
            }
        })
        .collect();
    let rays: Vec<Ray> = (0..rays)
        .map(|_| {
            let (o, target) = (6.0 * rng.direction(), 1.5 * rng.in_cube());
            let ray = through(o, target);
            let max_t = rng.one_of(&[f64::INFINITY, f64::INFINITY, 6.0]);
            within(ray, rng.one_of(&[0.0, 0.0, 5.0]), max_t)
        })
        .collect();
    brute_force(&triangles, &[], &rays)
}

/// Behind the heap are a floor and two walls, each parallel to two axes.
pub(super) fn nearest_of_many() -> BruteForceWork {
    let mut work = heap(&mut ProbeRng::new("nearest_of_many", 0), 40, 600);
    let corner = Vec3::splat(-2.5);
    for (a, b) in [(Vec3::X, Vec3::Y), (Vec3::Y, Vec3::Z), (Vec3::Z, Vec3::X)] {
        let wall = Triangle::flat(corner, corner + 9.0 * a, corner + 9.0 * b);
        work.triangles.push(wire_triangle(&wall));
    }
    work
}

pub(super) fn fresh(seed: u64) -> BruteForceWork {
    heap(&mut ProbeRng::new("fresh_triangles", seed), 40, 400)
}
