//! Rays that start on the triangle, slanted triangles in integers, NaN, and normals that cancel.

use crate::tools::questions::probes::{ProbeRng, Probes, at, within};
use kit::{Ray, Triangle, Vec3};
use wire::work::TriangleWork;

/// Right triangles with legs of 8 in the three coordinate planes through (1, 1, 1).
fn in_coordinate_planes() -> [Triangle; 3] {
    [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| {
        let first = Vec3::new(axis.z, axis.x, axis.y);
        let second = Vec3::new(axis.y, axis.z, axis.x);
        let corner = Vec3::ONE;
        Triangle::flat(corner, corner + 8.0 * first, corner + 8.0 * second)
    })
}

pub(super) fn origin_on_the_plane() -> TriangleWork {
    let mut probes = Probes::default();
    for t in in_coordinate_planes() {
        probes.triangle(&t);
        let [inside, edge, outside] = [[0.25, 0.25], [0.5, 0.5], [0.75, 0.5]].map(|b| at(&t, b));
        let normal = t.n0;
        let slanted = 2.0 * normal + (t.p1 - t.p0) / 8.0;
        for o in [inside, edge, outside, t.p0, t.p1, t.p2] {
            for d in [normal, -normal, slanted, -slanted] {
                for (min_t, max_t) in [
                    (0.0, f64::INFINITY),
                    (-1.0, 1.0),
                    (1.0 / 1024.0, f64::INFINITY),
                    (0.0, 0.0),
                    (-1.0, -1.0 / 1024.0),
                ] {
                    probes.ray(within(Ray::new(o, d), min_t, max_t));
                }
            }
        }
    }
    probes.of_triangles()
}

pub(super) fn exact_slants() -> TriangleWork {
    let mut rng = ProbeRng::new("exact_slants", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        // Even coordinates: the midpoints of the edges are also integers.
        let mut corner = || (8.0 * rng.in_cube()).round() * 2.0;
        let t = Triangle::flat(corner(), corner(), corner());
        if t.n0 == Vec3::ZERO {
            continue;
        }
        probes.triangle(&t);
        let middles = [
            (t.p0 + t.p1) / 2.0,
            (t.p1 + t.p2) / 2.0,
            (t.p2 + t.p0) / 2.0,
        ];
        for target in [t.p0, t.p1, t.p2].into_iter().chain(middles) {
            let d = rng.one_of(&[
                Vec3::new(1.0, 2.0, -4.0),
                Vec3::new(-2.0, 1.0, 1.0),
                Vec3::new(3.0, -4.0, 1.0),
                Vec3::new(-1.0, -1.0, -1.0),
            ]);
            let o = target - rng.one_of(&[1.0, 2.0, 3.0, 5.0]) * d;
            probes.ray(Ray::new(o, d));
            // Moved by up to an eighth.
            probes.ray(Ray::new(o + (8.0 * rng.direction()).round() / 64.0, d));
        }
    }
    probes.of_triangles()
}

pub(super) fn not_a_number() -> TriangleWork {
    let mut probes = Probes::default();
    let [sound, ..] = in_coordinate_planes();
    let (inside, d) = (at(&sound, [0.25, 0.25]), -sound.n0);
    let ray = Ray::new(inside - 4.0 * d, d);
    let with = |v: Vec3, axis: usize, x: f64| {
        let mut v = v.to_array();
        v[axis] = x;
        Vec3::from(v)
    };
    let spoilt = |v: Vec3, axis: usize| with(v, axis, f64::NAN);
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for axis in 0..3 {
            for vertex in 0..3 {
                let mut t = sound;
                let p = [&mut t.p0, &mut t.p1, &mut t.p2]
                    .into_iter()
                    .nth(vertex)
                    .expect("three vertices");
                *p = with(*p, axis, x);
                probes.triangle(&t);
                probes.ray(ray);
            }
        }
    }
    probes.triangle(&sound);
    for axis in 0..3 {
        probes.ray(Ray {
            o: spoilt(ray.o, axis),
            ..ray
        });
        probes.ray(Ray {
            d: spoilt(ray.d, axis),
            ..ray
        });
    }
    for (min_t, max_t) in [
        (f64::NAN, 10.0),
        (0.0, f64::NAN),
        (f64::NAN, f64::NAN),
        (6.0, 3.0),
    ] {
        probes.ray(within(ray, min_t, max_t));
    }
    for o in [ray.o, inside, sound.p0] {
        probes.ray(Ray::new(o, Vec3::ZERO));
    }
    probes.ray(ray);
    probes.of_triangles()
}

pub(super) fn cancelling_normals() -> TriangleWork {
    let mut rng = ProbeRng::new("cancelling_normals", 0);
    let mut probes = Probes::default();
    let mut aim = |t: Triangle, targets: &[[f64; 2]]| {
        probes.triangle(&t);
        for b in targets {
            for side in [1.0, -1.0] {
                probes.ray(rng.ray_to(&t, *b, side, 4.0));
            }
        }
    };
    for t in in_coordinate_planes() {
        // Opposite normals at both ends of an edge cancel at its midpoint; for this triangle also
        // at points inside it.
        let opposite = Triangle { n1: -t.n0, ..t };
        aim(
            opposite,
            &[[0.5, 0.0], [0.5, 0.25], [0.375, 0.25], [0.25, 0.5]],
        );
        let crossed = Triangle {
            n0: (t.p1 - t.p0) / 8.0,
            n1: (t.p0 - t.p1) / 8.0,
            n2: (t.p1 - t.p0) / 8.0,
            ..t
        };
        aim(crossed, &[[0.5, 0.25], [0.5, 0.125], [0.25, 0.25]]);
    }
    probes.of_triangles()
}
