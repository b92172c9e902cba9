//! Triangles and rays that cost digits: large and small, thin and far, at small angles and close to
//! edges.

use super::hits::MARGIN;
use crate::tools::questions::probes::{ProbeRng, Probes, at, through};
use kit::{Ray, Triangle, Vec3};
use wire::work::TriangleWork;

fn scaled(t: &Triangle, scale: f64) -> Triangle {
    Triangle {
        p0: scale * t.p0,
        p1: scale * t.p1,
        p2: scale * t.p2,
        ..*t
    }
}

fn shifted(t: &Triangle, offset: Vec3) -> Triangle {
    Triangle {
        p0: t.p0 + offset,
        p1: t.p1 + offset,
        p2: t.p2 + offset,
        ..*t
    }
}

/// Adds rays aimed at a triangle; three in four hit it.
fn probe(rng: &mut ProbeRng, probes: &mut Probes, t: &Triangle, size: f64, count: usize) {
    probes.triangle(t);
    for i in 0..count {
        let b = match i % 4 {
            3 => [rng.range(-1.0, -0.01), rng.range(0.0, 1.0)],
            _ => rng.inside(MARGIN),
        };
        let (side, distance) = (rng.one_of(&[1.0, -1.0]), size * rng.range(0.5, 20.0));
        probes.ray(rng.ray_to(t, b, side, distance));
    }
}

pub(super) fn tiny_and_huge() -> TriangleWork {
    let mut rng = ProbeRng::new("tiny_and_huge", 0);
    let mut probes = Probes::default();
    for scale in [1e-30, 1e-15, 1e-9, 1e-6, 1e-4, 1e6, 1e15, 1e30] {
        for _ in 0..5 {
            let t = scaled(&rng.triangle(), scale);
            probe(&mut rng, &mut probes, &t, scale, 8);
        }
    }
    probes.of_triangles()
}

/// A triangle of length 1 and width `width`, in a random orientation.
fn sliver(rng: &mut ProbeRng, width: f64) -> Triangle {
    let along = rng.direction();
    let across = along.any_orthonormal_vector();
    let p0 = rng.in_cube();
    let flat = Triangle::flat(
        p0,
        p0 + along,
        p0 + rng.range(0.1, 0.9) * along + width * across,
    );
    rng.with_normals(flat)
}

pub(super) fn slivers() -> TriangleWork {
    let mut rng = ProbeRng::new("slivers", 0);
    let mut probes = Probes::default();
    for width in [1e-3, 1e-4, 1e-5, 1e-6] {
        for _ in 0..8 {
            let t = sliver(&mut rng, width);
            probe(&mut rng, &mut probes, &t, 1.0, 8);
        }
    }
    probes.of_triangles()
}

pub(super) fn far_from_the_world_origin() -> TriangleWork {
    let mut rng = ProbeRng::new("far_from_the_world_origin", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let t = shifted(&rng.triangle(), 1e6 * rng.direction());
        probe(&mut rng, &mut probes, &t, 1.0, 8);
    }
    probes.of_triangles()
}

/// A ray through the point `b` of the triangle's plane, at an angle of about `angle` radians to the
/// plane.
fn grazing_ray(rng: &mut ProbeRng, t: &Triangle, b: [f64; 2], angle: f64, distance: f64) -> Ray {
    let normal = (t.p1 - t.p0).cross(t.p2 - t.p0).normalize();
    let along = rng.direction().reject_from_normalized(normal).normalize();
    let side = rng.one_of(&[1.0, -1.0]);
    through(
        at(t, b) + distance * (along + side * angle * normal),
        at(t, b),
    )
}

pub(super) fn grazing() -> TriangleWork {
    let mut rng = ProbeRng::new("grazing", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let t = rng.triangle();
        probes.triangle(&t);
        for angle in [1e-2, 1e-3, 1e-4, 1e-6] {
            for _ in 0..2 {
                let (b, distance) = (rng.inside(0.1), rng.range(2.0, 10.0));
                probes.ray(grazing_ray(&mut rng, &t, b, angle, distance));
            }
        }
    }
    probes.of_triangles()
}

pub(super) fn a_million_away() -> TriangleWork {
    let mut rng = ProbeRng::new("a_million_away", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let t = rng.triangle();
        probe(&mut rng, &mut probes, &t, 1e5, 8);
    }
    probes.of_triangles()
}

pub(super) fn by_a_hair() -> TriangleWork {
    let mut rng = ProbeRng::new("by_a_hair", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let t = rng.triangle();
        probes.triangle(&t);
        for hair in [1e-9, -1e-9, 1e-11, -1e-11, 1e-13, -1e-13] {
            let along = rng.range(0.1, 0.8);
            for b in [[hair, along], [along, hair], [along, 1.0 - along - hair]] {
                let (side, distance) = (rng.one_of(&[1.0, -1.0]), rng.range(0.5, 5.0));
                probes.ray(rng.ray_to(&t, b, side, distance));
            }
        }
    }
    probes.of_triangles()
}

pub(super) fn fresh(seed: u64) -> TriangleWork {
    let mut rng = ProbeRng::new("fresh_hard_triangles", seed);
    let mut probes = Probes::default();
    for i in 0..60 {
        let scale = rng.one_of(&[1e-9, 1e-3, 1.0, 1e3, 1e9]);
        let t = match i % 3 {
            0 => sliver(&mut rng, 1e-5),
            _ => rng.triangle(),
        };
        let t = scaled(
            &shifted(&t, rng.one_of(&[0.0, 10.0, 1e4]) * rng.direction()),
            scale,
        );
        probe(&mut rng, &mut probes, &t, scale, 6);
        if i % 3 == 1 {
            let b = rng.inside(0.1);
            probes.ray(grazing_ray(&mut rng, &t, b, 1e-4, 5.0 * scale));
        }
    }
    probes.of_triangles()
}
