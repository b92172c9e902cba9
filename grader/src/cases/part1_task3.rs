//! Triangles: what a textbook kernel in `f64` gets right.
//!
//! Where an answer hangs on an edge or on an end of the range, all numbers are short integers: textbook formulas
//! do not round them.

use super::probes::{Dice, Probes, brute_force, through, within};
use super::{Spec, part1_pictures, part1_task3_hard};
use crate::judge::tally::Aspect::{
    Barycentrics, Decision, GeometricNormal, Normal, Position, Primitive, RayAfter, T,
};
use kit::{Ray, Triangle, Vec3};
use wire::Work;

/// The cases of `part1.task3`.
pub(super) fn cases(seed: u64) -> Vec<Spec> {
    let mut cases =
        vec![
        case(
            "front_face",
            "Rays that meet the side towards which the normal points.",
            from_side("front_face", 1.0),
        ),
        case(
            "back_face",
            "Rays that meet the other side: walls and open meshes have two. Normals stay as \
             they are.",
            from_side("back_face", -1.0),
        ),
        case(
            "beside_the_triangle",
            "Rays that pass each edge on the outside, from far off to a hundred-thousandth of \
             the triangle's size. A miss leaves max_t alone.",
            beside(),
        ).only(&[Decision, RayAfter]),
        case(
            "behind_the_origin",
            "The triangle lies behind the ray: t would be negative.",
            behind(),
        ).only(&[Decision, RayAfter]),
        case(
            "range",
            "Only min_t <= t <= max_t counts, whatever min_t is; a hit sets max_t, a miss does \
             not.",
            range(),
        ).only(&[Decision, RayAfter]),
        case(
            "range_ends",
            "t is exactly min_t or exactly max_t: both ends count. The next float beyond does \
             not.",
            range_ends(),
        ).only(&[Decision]),
        case(
            "edges_and_vertices",
            "Rays exactly through edges and vertices, in small integers: they count as hits. \
             Strict comparisons leave cracks between neighbours.",
            edges_and_vertices(),
        ).only(&[Decision]),
        case(
            "parallel_rays",
            "Rays parallel to the triangle, above it and inside its plane: all miss. Dividing \
             by their determinant, 0, makes NaN, and NaN passes every test that asks for < and \
             >.",
            parallel(),
        ).only(&[Decision, RayAfter]),
        case(
            "no_area",
            "Triangles that are a line or a point: always a miss.",
            no_area(),
        ).only(&[Decision]),
        case(
            "length_of_direction",
            "d need not have length 1: t counts lengths of d, so a d twice as long makes t half \
             as large.",
            length_of_direction(),
        ).only(&[Decision, T, Position, RayAfter]),
        case(
            "interpolated_normals",
            "Every vertex has a normal of its own: n mixes them by the barycentric weights and \
             has length 1, on both sides the same.",
            interpolated_normals(),
        ).only(&[Normal, GeometricNormal, Barycentrics]),
        case(
            "close_up",
            "Hits from 0.0001 to 0.01 away. A minimal t of one's own makes holes close to the \
             camera; min_t says where to begin.",
            close_up(),
        ).only(&[Decision, T]),
        case(
            "nearest_of_many",
            "A ray through a heap of triangles in any order: max_t must shorten with every hit \
             and only with hits.",
            nearest_of_many(),
        ).only(&[Decision, Primitive, T, RayAfter]),
        case(
            "fresh_triangles",
            "Triangles and rays that differ for each seed.",
            fresh(seed),
        ),
        part1_pictures::torus(),
    ];
    cases.extend(part1_task3_hard::cases(seed));
    cases
}

pub(super) fn case(name: &'static str, about: &'static str, work: Work) -> Spec {
    Spec::new("part1.task3", name, about, work)
}

/// Large enough to stay inside the triangle for every sound kernel.
const MARGIN: f64 = 0.02;

fn from_side(name: &str, side: f64) -> Work {
    let mut dice = Dice::new(name, 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let triangle = dice.triangle();
        probes.triangle(&triangle);
        for _ in 0..8 {
            let (b, distance) = (dice.inside(MARGIN), dice.range(0.5, 20.0));
            probes.ray(dice.ray_to(&triangle, b, side, distance));
        }
    }
    probes.work()
}

fn beside() -> Work {
    let mut dice = Dice::new("beside_the_triangle", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let triangle = dice.triangle();
        probes.triangle(&triangle);
        for outside in [1e-5, 1e-4, 1e-2, 0.1, 0.4, 3.0] {
            let along = dice.range(0.1, 0.45);
            let beyond_third = [along + outside, 1.0 - along];
            for b in [[-outside, along], [along, -outside], beyond_third] {
                let (side, distance) = (dice.one_of(&[1.0, -1.0]), dice.range(0.5, 20.0));
                let ray = dice.ray_to(&triangle, b, side, distance);
                probes.ray(within(
                    ray,
                    0.0,
                    dice.one_of(&[f64::INFINITY, 2.0 * distance]),
                ));
            }
        }
    }
    probes.work()
}

fn behind() -> Work {
    let mut dice = Dice::new("behind_the_origin", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let triangle = dice.triangle();
        probes.triangle(&triangle);
        for side in [1.0, -1.0] {
            for _ in 0..3 {
                let (b, distance) = (dice.inside(MARGIN), dice.range(0.01, 20.0));
                let ray = dice.ray_to(&triangle, b, side, distance);
                probes.ray(Ray { d: -ray.d, ..ray });
            }
        }
        // One that it does hit, so that a kernel which never hits does not pass.
        let b = dice.inside(MARGIN);
        probes.ray(dice.ray_to(&triangle, b, 1.0, 3.0));
    }
    probes.work()
}

fn range() -> Work {
    let mut dice = Dice::new("range", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        let triangle = dice.triangle();
        probes.triangle(&triangle);
        let (b, t) = (dice.inside(MARGIN), dice.range(0.5, 20.0));
        let side = dice.one_of(&[1.0, -1.0]);
        let ray = dice.ray_to(&triangle, b, side, t);
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
        // The plane is behind the origin, but min_t is farther back.
        let turned = Ray { d: -ray.d, ..ray };
        probes.ray(within(turned, -2.0 * t, 5.0));
        probes.ray(within(turned, -2.0 * t, -0.5 * t));
        probes.ray(within(turned, -0.5 * t, 5.0));
    }
    probes.work()
}

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

fn range_ends() -> Work {
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
    probes.work()
}

fn edges_and_vertices() -> Work {
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
    probes.work()
}

fn parallel() -> Work {
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
        // One that it does hit, so that a kernel which never hits does not pass.
        let o = on_axes(axis, 2.0, 2.0, 7.0);
        probes.ray(Ray::new(o, on_axes(axis, 0.0, 0.0, -1.0)));
    }
    probes.work()
}

fn no_area() -> Work {
    let point = |x: f64, y: f64| Vec3::new(x, y, 1.0);
    let flat_to = |p0, p1, p2| Triangle {
        n0: Vec3::Z,
        n1: Vec3::Z,
        n2: Vec3::Z,
        ..Triangle::flat(p0, p1, p2)
    };
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
    probes.work()
}

fn length_of_direction() -> Work {
    let mut dice = Dice::new("length_of_direction", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let triangle = dice.triangle();
        probes.triangle(&triangle);
        for length in [0.05, 0.25, 0.7, 1.5, 3.0, 40.0] {
            let (b, distance) = (dice.inside(MARGIN), dice.range(0.5, 20.0));
            let side = dice.one_of(&[1.0, -1.0]);
            let ray = dice.ray_to(&triangle, b, side, distance);
            let longer = Ray {
                d: length * ray.d,
                ..ray
            };
            probes.ray(longer);
            // In range only if t counts lengths of d.
            let t = distance / length;
            probes.ray(within(longer, 0.9 * t, 1.1 * t));
        }
    }
    probes.work()
}

fn interpolated_normals() -> Work {
    let mut dice = Dice::new("interpolated_normals", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let mut triangle = dice.triangle();
        // Normals up to 80 degrees apart: what is mixed and not normalised is a quarter too short.
        triangle.n1 = (triangle.n1 + 0.8 * dice.direction()).normalize();
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
                let distance = dice.range(0.5, 20.0);
                probes.ray(dice.ray_to(&triangle, b, side, distance));
            }
        }
    }
    probes.work()
}

fn close_up() -> Work {
    let mut dice = Dice::new("close_up", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let triangle = dice.triangle();
        probes.triangle(&triangle);
        for distance in [1e-4, 3e-4, 1e-3, 3e-3, 1e-2] {
            let (b, side) = (dice.inside(MARGIN), dice.one_of(&[1.0, -1.0]));
            probes.ray(dice.ray_to(&triangle, b, side, distance));
        }
    }
    probes.work()
}

/// A heap of triangles, and rays through it from all around.
fn heap(dice: &mut Dice, triangles: usize, rays: usize) -> Work {
    let triangles: Vec<Triangle> = (0..triangles)
        .map(|_| {
            let (t, offset) = (dice.triangle(), 1.2 * dice.in_cube());
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
            let (o, target) = (6.0 * dice.direction(), 1.5 * dice.in_cube());
            let ray = through(o, target);
            let max_t = dice.one_of(&[f64::INFINITY, f64::INFINITY, 6.0]);
            within(ray, dice.one_of(&[0.0, 0.0, 5.0]), max_t)
        })
        .collect();
    brute_force(&triangles, &[], &rays)
}

fn nearest_of_many() -> Work {
    heap(&mut Dice::new("nearest_of_many", 0), 40, 600)
}

fn fresh(seed: u64) -> Work {
    heap(&mut Dice::new("fresh_triangles", seed), 40, 400)
}
