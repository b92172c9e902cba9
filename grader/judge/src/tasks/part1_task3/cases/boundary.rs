//! Edges, ends of the range and planes with small integer coordinates, which textbook formulas do
//! not round.

use crate::tools::questions::probes::{Probes, within};
use kit::{Ray, Triangle, Vec3};
use wire::work::TriangleWork;

/// A right triangle with legs of 8 on two of the axes, moved by `offset` along the third, `axis`.
fn right_triangle(axis: usize, offset: f64, flipped: bool) -> Triangle {
    let corner = |x: f64, y: f64| on_axes(axis, x, y, offset);
    let [a, b, c] = [corner(0.0, 0.0), corner(8.0, 0.0), corner(0.0, 8.0)];
    if flipped {
        Triangle::flat(a, c, b)
    } else {
        Triangle::flat(a, b, c)
    }
}

/// The point with `x`, `y` on the two axes after `axis`, and `z` on `axis`.
fn on_axes(axis: usize, x: f64, y: f64, z: f64) -> Vec3 {
    let mut p = [0.0; 3];
    p[(axis + 1) % 3] = x;
    p[(axis + 2) % 3] = y;
    p[axis] = z;
    p.into()
}

pub(super) fn range_ends() -> TriangleWork {
    let mut probes = Probes::default();
    for (axis, flipped) in [(0, false), (1, false), (2, false), (2, true)] {
        probes.triangle(&right_triangle(axis, 1.0, flipped));
        for (height, length) in [(5.0, 1.0), (-3.0, 1.0), (9.0, 2.0)] {
            let o = on_axes(axis, 2.0, 3.0, height);
            let d = on_axes(axis, 0.0, 0.0, length * f64::signum(1.0 - height));
            let t = (1.0 - height).abs() / length;
            let ranges = [
                (t, f64::INFINITY),
                (0.0, t),
                (t, t),
                (t.next_up(), f64::INFINITY),
                (0.0, t.next_down()),
            ];
            for (min_t, max_t) in ranges {
                probes.ray(within(Ray::new(o, d), min_t, max_t));
            }
        }
    }
    probes.of_triangles()
}

pub(super) fn edges_and_vertices() -> TriangleWork {
    let mut probes = Probes::default();
    for (axis, flipped) in [(0, false), (1, true), (2, false), (2, true)] {
        probes.triangle(&right_triangle(axis, -1.0, flipped));
        let legs = (0..=8).flat_map(|k| [(k, 0), (0, k)]);
        let slope = (1..=7).map(|k| (k, 8 - k));
        for (x, y) in legs.chain(slope) {
            let o = on_axes(axis, f64::from(x), f64::from(y), 4.0);
            probes.ray(Ray::new(o, on_axes(axis, 0.0, 0.0, -1.0)));
            // From the other side.
            let o = on_axes(axis, f64::from(x), f64::from(y), -7.0);
            probes.ray(Ray::new(o, on_axes(axis, 0.0, 0.0, 1.0)));
        }
        for (x, y) in [
            (-0.25, 3.0),
            (3.0, -0.25),
            (4.25, 4.0),
            (-0.25, -0.25),
            (8.25, 0.0),
        ] {
            let o = on_axes(axis, x, y, 4.0);
            probes.ray(Ray::new(o, on_axes(axis, 0.0, 0.0, -1.0)));
        }
    }
    probes.of_triangles()
}

pub(super) fn parallel() -> TriangleWork {
    let mut probes = Probes::default();
    for axis in [0, 1, 2] {
        probes.triangle(&right_triangle(axis, 2.0, false));
        for height in [2.0, 2.5, 3.0, 1.0, -2.0] {
            for (x, y, dx, dy) in [
                (-4.0, 2.0, 1.0, 0.0),
                (2.0, -4.0, 0.0, 1.0),
                (12.0, 1.0, -1.0, 0.0),
                (-3.0, -3.0, 1.0, 1.0),
                (2.0, 2.0, 1.0, 0.0),
                (-5.0, 0.0, 1.0, 0.0),
                (0.0, -5.0, 0.0, 2.0),
                (1.0, 1.0, -1.0, -1.0),
            ] {
                let o = on_axes(axis, x, y, height);
                probes.ray(Ray::new(o, on_axes(axis, dx, dy, 0.0)));
            }
        }
        // A hit, so that a kernel which always misses does not pass.
        let o = on_axes(axis, 2.0, 2.0, 7.0);
        probes.ray(Ray::new(o, on_axes(axis, 0.0, 0.0, -1.0)));
    }
    probes.of_triangles()
}

pub(super) fn no_area() -> TriangleWork {
    let point = |x: f64, y: f64| Vec3::new(x, y, 1.0);
    let flat_to = |p0, p1, p2| Triangle::smooth([p0, p1, p2], [Vec3::Z; 3]);
    let lines = [
        [point(0.0, 0.0), point(4.0, 0.0), point(8.0, 0.0)],
        [point(0.0, 0.0), point(4.0, 4.0), point(2.0, 2.0)],
        [point(1.0, 2.0), point(1.0, 2.0), point(5.0, 2.0)],
        [point(5.0, 2.0), point(1.0, 2.0), point(5.0, 2.0)],
        [point(1.0, 2.0), point(5.0, 2.0), point(5.0, 2.0)],
        [point(2.0, 2.0), point(2.0, 2.0), point(2.0, 2.0)],
    ];
    let mut probes = Probes::default();
    for [p0, p1, p2] in lines {
        probes.triangle(&flat_to(p0, p1, p2));
        for target in [p0, p1, p2, (p0 + p1) / 2.0, (p0 + p2) / 2.0] {
            for d in [
                -Vec3::Z,
                Vec3::new(1.0, 0.0, -1.0),
                Vec3::new(0.0, 2.0, -1.0),
            ] {
                probes.ray(Ray::new(target - 4.0 * d, d));
            }
        }
        probes.ray(Ray::new(Vec3::new(3.0, 3.0, 5.0), -Vec3::Z));
    }
    probes.triangle(&flat_to(point(0.0, 0.0), point(8.0, 0.0), point(0.0, 8.0)));
    probes.ray(Ray::new(Vec3::new(2.0, 2.0, 5.0), -Vec3::Z));
    probes.of_triangles()
}
