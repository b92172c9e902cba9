//! Triangles: what textbook kernels get wrong.

use super::Spec;
use super::part1_task3::case;
use super::probes::{Dice, Probes, at, brute_force, through, within};
use crate::judge::tally::Aspect::{Barycentrics, Decision, Normal, Position, T};
use kit::{Ray, Triangle, Vec3};
use wire::Work;

/// The robust cases of `part1.task3`.
pub(super) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        Spec {
            enclosed: true,
            ..case(
                "shared_edges",
                "Rays from inside a closed mesh, aimed at its edges and vertices: one of the \
                 faces must be hit. Möller-Trumbore rounds each face differently and lets about \
                 one such ray in ten out.",
                shared_edges(),
            )
            .only(&[Decision])
        },
        Spec {
            enclosed: true,
            ..case(
                "needle_and_pancake",
                "The same in closed meshes a million times as long as wide, and as wide as \
                 thick: no epsilon on t or on the determinant keeps them closed.",
                needle_and_pancake(),
            )
            .only(&[Decision])
        },
        case(
            "tiny_and_huge",
            "Whole scenes from 1e-30 to 1e30 in size: a determinant below an absolute epsilon \
             is no reason to miss.",
            tiny_and_huge(),
        )
        .only(&[Decision, T, Barycentrics]),
        case(
            "slivers",
            "Triangles a million times as long as wide.",
            slivers(),
        )
        .only(&[Decision, T, Barycentrics, Position]),
        case(
            "far_from_the_world_origin",
            "Triangles a million away from the world's origin: subtract the ray's origin first, \
             multiply then.",
            far_from_the_world_origin(),
        )
        .only(&[Decision, T, Barycentrics, Position]),
        case(
            "grazing",
            "Rays that meet the plane at a ten-thousandth of a radian and less.",
            grazing(),
        )
        .only(&[Decision, T]),
        case(
            "a_million_away",
            "Hits at t = 1e6: o + t d drifts off the surface, a mix of the vertices stays on \
             it.",
            a_million_away(),
        )
        .only(&[Position, T]),
        case(
            "origin_on_the_plane",
            "The ray starts on the triangle: t = 0 counts if min_t <= 0, and not otherwise.",
            origin_on_the_plane(),
        )
        .only(&[Decision]),
        case(
            "exact_slants",
            "Slanted rays through edges and vertices of slanted triangles, all in small \
             integers: they count, and what is beside them does not.",
            exact_slants(),
        )
        .only(&[Decision]),
        case(
            "by_a_hair",
            "Rays a billionth of the triangle's size and less inside its edges and outside: an \
             epsilon on the weights is too coarse.",
            by_a_hair(),
        )
        .only(&[Decision]),
        case(
            "not_a_number",
            "NaN in the ray or in a vertex, d = 0, min_t > max_t: a miss. Write tests so that \
             NaN fails them.",
            not_a_number(),
        )
        .only(&[Decision]),
        case(
            "cancelling_normals",
            "Vertex normals that cancel: n is still finite and of length 1 (the geometric \
             normal will do).",
            cancelling_normals(),
        )
        .only(&[Normal]),
        case(
            "fresh_hard_triangles",
            "Slivers, grazing rays, all scales and offsets, differing for each seed.",
            fresh(seed),
        ),
    ]
}

/// A ball of 128 triangles without a gap, its vertices at uneven distances from the centre.
fn closed_ball(dice: &mut Dice, stretch: Vec3) -> Vec<Triangle> {
    let [x, y, z] = [Vec3::X, Vec3::Y, Vec3::Z];
    let mut faces: Vec<[Vec3; 3]> = Vec::new();
    for (sx, sy, sz) in [
        (1.0, 1.0, 1.0),
        (-1.0, 1.0, -1.0),
        (-1.0, -1.0, 1.0),
        (1.0, -1.0, -1.0),
        (-1.0, 1.0, 1.0),
        (1.0, 1.0, -1.0),
        (1.0, -1.0, 1.0),
        (-1.0, -1.0, -1.0),
    ] {
        let outward = f64::signum(sx * sy * sz) > 0.0;
        let [a, b, c] = [sx * x, sy * y, sz * z];
        faces.push(if outward { [a, b, c] } else { [a, c, b] });
    }
    for _ in 0..2 {
        faces = faces.into_iter().flat_map(quartered).collect();
    }
    // A vertex is moved by numbers that depend on where it is, so that neighbours agree on it bit for bit.
    let turn = dice.range(0.0, 1.0);
    let moved = |v: Vec3| {
        let wave = kit::math::sin(40.0 * (v.x + 1.3 * v.y + 1.7 * v.z) + turn);
        (1.0 + 0.2 * wave) * v.normalize() * stretch
    };
    let bent = |face: [Vec3; 3]| {
        let [a, b, c] = face.map(moved);
        Triangle::flat(a, b, c)
    };
    faces.into_iter().map(bent).collect()
}

/// Four triangles for one, by the middles of its edges; halves of sums, the same from both sides.
fn quartered([a, b, c]: [Vec3; 3]) -> [[Vec3; 3]; 4] {
    let [ab, bc, ca] = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

/// Rays from inside at the edges and vertices of `mesh`.
fn at_edges(dice: &mut Dice, mesh: &[Triangle], inner: Vec3, rays: usize) -> Vec<Ray> {
    let mut one = || {
        let t = mesh[dice.below(mesh.len())];
        let fraction = dice.one_of(&[0.0, 0.25, 0.5, -1.0]);
        let fraction = if fraction < 0.0 {
            dice.range(0.0, 1.0)
        } else {
            fraction
        };
        let target = t.p0 + fraction * (t.p1 - t.p0);
        through(dice.in_cube() * inner, target)
    };
    (0..rays).map(|_| one()).collect()
}

fn shared_edges() -> Work {
    let mut dice = Dice::new("shared_edges", 0);
    let mesh = closed_ball(&mut dice, Vec3::ONE);
    let rays = at_edges(&mut dice, &mesh, Vec3::splat(0.2), 600);
    brute_force(&mesh, &[], &rays)
}

fn needle_and_pancake() -> Work {
    let mut dice = Dice::new("needle_and_pancake", 0);
    let needle = closed_ball(&mut dice, Vec3::new(1.0, 1e6, 1.0));
    let pancake = closed_ball(&mut dice, Vec3::new(1e6, 1.0, 1e6));
    let mut rays = at_edges(&mut dice, &needle, Vec3::new(0.2, 2e5, 0.2), 250);
    rays.extend(at_edges(&mut dice, &pancake, Vec3::new(2e5, 0.2, 2e5), 250));
    let both: Vec<Triangle> = needle.into_iter().chain(pancake).collect();
    brute_force(&both, &[], &rays)
}

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

/// Well inside for every sound kernel.
const MARGIN: f64 = 0.02;

/// Rays at a triangle, most of them inside.
fn shots(dice: &mut Dice, probes: &mut Probes, t: &Triangle, size: f64, count: usize) {
    probes.triangle(t);
    for i in 0..count {
        let b = match i % 4 {
            3 => [dice.range(-1.0, -0.01), dice.range(0.0, 1.0)],
            _ => dice.inside(MARGIN),
        };
        let (side, distance) = (dice.one_of(&[1.0, -1.0]), size * dice.range(0.5, 20.0));
        probes.ray(dice.ray_to(t, b, side, distance));
    }
}

fn tiny_and_huge() -> Work {
    let mut dice = Dice::new("tiny_and_huge", 0);
    let mut probes = Probes::default();
    for scale in [1e-30, 1e-15, 1e-9, 1e-6, 1e-4, 1e6, 1e15, 1e30] {
        for _ in 0..5 {
            let t = scaled(&dice.triangle(), scale);
            shots(&mut dice, &mut probes, &t, scale, 8);
        }
    }
    probes.work()
}

/// A triangle of length 1 and width `width`, turned anyhow.
fn sliver(dice: &mut Dice, width: f64) -> Triangle {
    let along = dice.direction();
    let across = along.any_orthonormal_vector();
    let p0 = dice.in_cube();
    let flat = Triangle::flat(
        p0,
        p0 + along,
        p0 + dice.range(0.1, 0.9) * along + width * across,
    );
    dice.with_normals(flat)
}

fn slivers() -> Work {
    let mut dice = Dice::new("slivers", 0);
    let mut probes = Probes::default();
    for width in [1e-3, 1e-4, 1e-5, 1e-6] {
        for _ in 0..8 {
            let t = sliver(&mut dice, width);
            shots(&mut dice, &mut probes, &t, 1.0, 8);
        }
    }
    probes.work()
}

fn far_from_the_world_origin() -> Work {
    let mut dice = Dice::new("far_from_the_world_origin", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let t = shifted(&dice.triangle(), 1e6 * dice.direction());
        shots(&mut dice, &mut probes, &t, 1.0, 8);
    }
    probes.work()
}

/// A ray at the point `b` of the triangle's plane, at the angle `angle` to the plane.
fn grazing_ray(dice: &mut Dice, t: &Triangle, b: [f64; 2], angle: f64, distance: f64) -> Ray {
    let normal = (t.p1 - t.p0).cross(t.p2 - t.p0).normalize();
    let along = dice.direction().reject_from_normalized(normal).normalize();
    let side = dice.one_of(&[1.0, -1.0]);
    through(
        at(t, b) + distance * (along + side * angle * normal),
        at(t, b),
    )
}

fn grazing() -> Work {
    let mut dice = Dice::new("grazing", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let t = dice.triangle();
        probes.triangle(&t);
        for angle in [1e-2, 1e-3, 1e-4, 1e-6] {
            for _ in 0..2 {
                let (b, distance) = (dice.inside(0.1), dice.range(2.0, 10.0));
                probes.ray(grazing_ray(&mut dice, &t, b, angle, distance));
            }
        }
    }
    probes.work()
}

fn a_million_away() -> Work {
    let mut dice = Dice::new("a_million_away", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let t = dice.triangle();
        shots(&mut dice, &mut probes, &t, 1e5, 8);
    }
    probes.work()
}

/// Right triangles with legs of 8 in the three coordinate planes through (1, 1, 1).
fn in_coordinate_planes() -> [Triangle; 3] {
    [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| {
        let first = Vec3::new(axis.z, axis.x, axis.y);
        let second = Vec3::new(axis.y, axis.z, axis.x);
        let corner = Vec3::ONE;
        Triangle::flat(corner, corner + 8.0 * first, corner + 8.0 * second)
    })
}

fn origin_on_the_plane() -> Work {
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
    probes.work()
}

fn exact_slants() -> Work {
    let mut dice = Dice::new("exact_slants", 0);
    let mut probes = Probes::default();
    for _ in 0..40 {
        // Even corners: the middles of the edges are integers, too.
        let mut corner = || (8.0 * dice.in_cube()).round() * 2.0;
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
            let d = dice.one_of(&[
                Vec3::new(1.0, 2.0, -4.0),
                Vec3::new(-2.0, 1.0, 1.0),
                Vec3::new(3.0, -4.0, 1.0),
                Vec3::new(-1.0, -1.0, -1.0),
            ]);
            let o = target - dice.one_of(&[1.0, 2.0, 3.0, 5.0]) * d;
            probes.ray(Ray::new(o, d));
            // An eighth beside.
            probes.ray(Ray::new(o + (8.0 * dice.direction()).round() / 64.0, d));
        }
    }
    probes.work()
}

fn by_a_hair() -> Work {
    let mut dice = Dice::new("by_a_hair", 0);
    let mut probes = Probes::default();
    for _ in 0..30 {
        let t = dice.triangle();
        probes.triangle(&t);
        for hair in [1e-9, -1e-9, 1e-11, -1e-11, 1e-13, -1e-13] {
            let along = dice.range(0.1, 0.8);
            for b in [[hair, along], [along, hair], [along, 1.0 - along - hair]] {
                let (side, distance) = (dice.one_of(&[1.0, -1.0]), dice.range(0.5, 5.0));
                probes.ray(dice.ray_to(&t, b, side, distance));
            }
        }
    }
    probes.work()
}

fn not_a_number() -> Work {
    let mut probes = Probes::default();
    let [sound, ..] = in_coordinate_planes();
    let (inside, d) = (at(&sound, [0.25, 0.25]), -sound.n0);
    let ray = Ray::new(inside - 4.0 * d, d);
    let spoilt = |v: Vec3, axis: usize| {
        let mut v = v.to_array();
        v[axis] = f64::NAN;
        Vec3::from(v)
    };
    for axis in 0..3 {
        for vertex in 0..3 {
            let mut t = sound;
            let p = [&mut t.p0, &mut t.p1, &mut t.p2];
            let p = p.into_iter().nth(vertex).expect("three vertices");
            *p = spoilt(*p, axis);
            probes.triangle(&t);
            probes.ray(ray);
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
    probes.work()
}

fn cancelling_normals() -> Work {
    let mut dice = Dice::new("cancelling_normals", 0);
    let mut probes = Probes::default();
    let mut aim = |t: Triangle, targets: &[[f64; 2]]| {
        probes.triangle(&t);
        for b in targets {
            for side in [1.0, -1.0] {
                probes.ray(dice.ray_to(&t, *b, side, 4.0));
            }
        }
    };
    for t in in_coordinate_planes() {
        // Opposite normals at both ends of an edge cancel in its middle; here just inside of it, too.
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
    probes.work()
}

fn fresh(seed: u64) -> Work {
    let mut dice = Dice::new("fresh_hard_triangles", seed);
    let mut probes = Probes::default();
    for i in 0..60 {
        let scale = dice.one_of(&[1e-9, 1e-3, 1.0, 1e3, 1e9]);
        let t = match i % 3 {
            0 => sliver(&mut dice, 1e-5),
            _ => dice.triangle(),
        };
        let t = scaled(
            &shifted(&t, dice.one_of(&[0.0, 10.0, 1e4]) * dice.direction()),
            scale,
        );
        shots(&mut dice, &mut probes, &t, scale, 6);
        if i % 3 == 1 {
            let b = dice.inside(0.1);
            probes.ray(grazing_ray(&mut dice, &t, b, 1e-4, 5.0 * scale));
        }
    }
    probes.work()
}
