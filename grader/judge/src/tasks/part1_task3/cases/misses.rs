//! Rays that pass beside the triangle, end before it, or point away from it.

use super::hits::MARGIN;
use crate::tools::questions::probes::{ProbeRng, Probes, within};
use kit::Ray;
use wire::work::TriangleWork;

pub(super) fn beside() -> TriangleWork {
    let mut rng = ProbeRng::new("beside_the_triangle", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let triangle = rng.triangle();
        probes.triangle(&triangle);
        for outside in [1e-5, 1e-4, 1e-2, 0.1, 0.4, 3.0] {
            let along = rng.range(0.1, 0.45);
            let beyond_third = [along + outside, 1.0 - along];
            for b in [[-outside, along], [along, -outside], beyond_third] {
                let (side, distance) = (rng.one_of(&[1.0, -1.0]), rng.range(0.5, 20.0));
                let ray = rng.ray_to(&triangle, b, side, distance);
                probes.ray(within(
                    ray,
                    0.0,
                    rng.one_of(&[f64::INFINITY, 2.0 * distance]),
                ));
            }
        }
        // Hits, so that a kernel which always misses does not pass.
        for b in [[0.01, 0.4], [0.4, 0.01], [0.5, 0.49]] {
            probes.ray(rng.ray_to(&triangle, b, 1.0, 3.0));
        }
    }
    probes.of_triangles()
}

pub(super) fn behind() -> TriangleWork {
    let mut rng = ProbeRng::new("behind_the_origin", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let triangle = rng.triangle();
        probes.triangle(&triangle);
        for side in [1.0, -1.0] {
            for _ in 0..3 {
                let (b, distance) = (rng.inside(MARGIN), rng.range(0.01, 20.0));
                let ray = rng.ray_to(&triangle, b, side, distance);
                probes.ray(Ray { d: -ray.d, ..ray });
            }
        }
        // A hit, so that a kernel which always misses does not pass.
        let b = rng.inside(MARGIN);
        probes.ray(rng.ray_to(&triangle, b, 1.0, 3.0));
    }
    for _ in 0..10 {
        let triangle = rng.triangle();
        probes.triangle(&triangle);
        for side in [1.0, -1.0] {
            for _ in 0..3 {
                // Mirrored at p0: without the sign of the determinant or of the origin, weights and
                // t are positive.
                let (b, distance) = (rng.inside(MARGIN), rng.range(0.01, 20.0));
                let ray = rng.ray_to(&triangle, b.map(|weight| -weight), side, distance);
                probes.ray(Ray { d: -ray.d, ..ray });
            }
        }
    }
    probes.of_triangles()
}

pub(super) fn range() -> TriangleWork {
    let mut rng = ProbeRng::new("range", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let triangle = rng.triangle();
        probes.triangle(&triangle);
        let (b, t) = (rng.inside(MARGIN), rng.range(0.5, 20.0));
        let side = rng.one_of(&[1.0, -1.0]);
        let ray = rng.ray_to(&triangle, b, side, t);
        let ranges = [
            (0.0, 0.9 * t),
            (1.1 * t, f64::INFINITY),
            (1.1 * t, 2.0 * t),
            (0.5 * t, 1.5 * t),
            (0.999 * t, 1.001 * t),
            (0.0, 1e-3),
            (-10.0, 1.01 * t),
        ];
        for (min_t, max_t) in ranges {
            probes.ray(within(ray, min_t, max_t));
        }
        // Behind the origin, with t below a negative min_t.
        probes.ray(within(Ray { d: -ray.d, ..ray }, -0.5 * t, 5.0));
    }
    probes.of_triangles()
}
