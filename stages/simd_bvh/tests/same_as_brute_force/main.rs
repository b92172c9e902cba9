//! The wide tree finds the hits of brute force, bit for bit.

mod checker;
mod tiles;

use checker::{Checker, Random};
use kit::{PrimId, Ray, Sphere, Triangle, Vec3};
use meshes::{MeshKind, generate};
use simd_bvh::{TestCounts, WideBvh};
use std::path::Path;

/// How many of `rays` a run checks: a debug build, which `cargo test` makes, is some 20 times as slow
/// as a release build, which checks all of them (`.ci/nightly wide-tree`).
const fn checked(rays: usize) -> usize {
    if cfg!(debug_assertions) {
        rays / 10
    } else {
        rays
    }
}

fn soup(random: &mut Random, count: usize, size: f64) -> Vec<Triangle> {
    (0..count)
        .map(|_| {
            let p = random.point();
            let corner = |random: &mut Random| p + size * random.point();
            Triangle::flat(p, corner(random), corner(random))
        })
        .collect()
}

/// Checks rays to points on the triangles: from anywhere, from other triangles and along axes, with
/// full and with cut ranges.
fn rays_at(checker: &mut Checker, random: &mut Random, count: usize, scale: f64) {
    for i in 0..checked(count) {
        let of = random.below(checker.scene.triangles.len());
        let target = random.on(&checker.scene.triangles[of]);
        let other = random.below(checker.scene.triangles.len());
        let (o, skip) = match i % 3 {
            0 => (2.0 * scale * random.point(), None),
            1 => {
                let from = random.on(&checker.scene.triangles[other]);
                (from, Some(PrimId(other as u32)))
            }
            _ => (target + scale * random.direction(), None),
        };
        let mut d = target - o;
        match i % 11 {
            0..=6 => d = d.normalize_or(Vec3::X),
            7 => d[random.below(3)] = 0.0,
            8 => d = [Vec3::X, -Vec3::Y, Vec3::Z][random.below(3)],
            9 => d *= 1e-3,
            _ => d[random.below(3)] *= 1e-19,
        }
        let mut ray = Ray::new(o, d);
        match i % 7 {
            0 => ray.max_t = 1.0,
            1 => ray.min_t = -2.0 * scale,
            2 => ray.min_t = 1.0,
            3 => (ray.min_t, ray.max_t) = (-3.0 * scale, -0.1 * scale),
            _ => {}
        }
        checker.check(&ray, skip);
    }
}

#[test]
fn on_meshes() {
    for kind in MeshKind::ALL {
        let mut random = Random::new(1);
        let mut checker = Checker::new(generate(kind, 1500), Vec::new());
        rays_at(&mut checker, &mut random, 4000, 1.0);
        assert!(checker.hits > checked(1000), "{} rays hit", checker.hits);
    }
}

#[test]
fn on_soups_of_every_size() {
    let mut random = Random::new(2);
    for count in (0..40).chain([100, 300]) {
        for size in [0.01, 0.3, 2.0] {
            let triangles = soup(&mut random, count.max(1), size);
            let mut checker = Checker::new(triangles, Vec::new());
            rays_at(&mut checker, &mut random, 200, 1.0);
        }
    }
}

/// Coplanar, duplicate and degenerate triangles: many ties.
#[test]
fn on_ties() {
    let mut random = Random::new(3);
    let corner = |random: &mut Random| {
        let mut p = (3.0 * random.point()).round() / 3.0;
        p.z = p.z.abs().round();
        p
    };
    let mut triangles: Vec<Triangle> = (0..60)
        .map(|_| {
            let mut next = || corner(&mut random);
            Triangle::flat(next(), next(), next())
        })
        .collect();
    triangles.extend_from_within(10..40);
    let mut checker = Checker::new(triangles, Vec::new());
    rays_at(&mut checker, &mut random, 20_000, 1.0);
    assert!(checker.hits > checked(10_000), "{} rays hit", checker.hits);
}

/// From far below to far above the range of single precision, and far from the origin.
#[test]
fn on_every_scale_and_far_away() {
    let mut random = Random::new(4);
    for (scale, offset) in [
        (1e-300, 0.0),
        (1e-42, 0.0),
        (1e-30, 0.0),
        (1e-9, 0.0),
        (1.0, 1e6),
        (1.0, 1e12),
        (1e9, 0.0),
        (1e17, 0.0),
        (1e25, 0.0),
        (1e60, 0.0),
        (1e150, 0.0),
    ] {
        let place = |p: Vec3| scale * p + Vec3::new(offset, -0.3 * offset, 0.0);
        let triangles: Vec<Triangle> = soup(&mut random, 100, 0.5)
            .iter()
            .map(|t| Triangle::flat(place(t.p0), place(t.p1), place(t.p2)))
            .collect();
        let mut checker = Checker::new(triangles, Vec::new());
        rays_at(&mut checker, &mut random, 1500, scale);
        assert!(
            checker.hits > checked(100),
            "{} rays hit at {scale}",
            checker.hits
        );
    }
}

/// Rays that pass an edge, a vertex or the end of the range at distances from far above to far below
/// the rounding errors of single precision: the borders between hit, miss and undecided.
#[test]
fn at_every_distance_from_a_border() {
    let mut random = Random::new(11);
    for size in [1e-3, 0.05, 1.0] {
        for flatness in [1.0, 1e-4] {
            let mut triangles = soup(&mut random, 60, size);
            for t in &mut triangles {
                *t = Triangle::flat(t.p0, t.p1, t.p1 + flatness * (t.p2 - t.p1));
            }
            let mut checker = Checker::new(triangles, Vec::new());
            for i in 0..checked(6000) {
                let t = checker.scene.triangles[random.below(60)];
                let near = 0.5_f64.powi(8 + (i % 44) as i32);
                let target = random.on(&t) + size * near * random.direction();
                let o = target + [0.001, 0.3, 4.0][i % 3] * random.direction();
                let mut ray = Ray::new(o, target - o);
                match i % 5 {
                    0 => ray.max_t = 1.0 + near,
                    1 => ray.max_t = 1.0 - near,
                    2 => ray.min_t = 1.0 - near,
                    3 => ray.min_t = 1.0 + near,
                    _ => {}
                }
                checker.check(&ray, None);
            }
            assert!(checker.hits > checked(1000), "{} rays hit", checker.hits);
        }
    }
}

/// From so far away that a rounding error of the origin is as large as a triangle.
#[test]
fn from_very_far_away() {
    let mut random = Random::new(8);
    for distance in [1e3, 1e5, 1e6, 1e9, 1e12, 1e15] {
        let triangles = soup(&mut random, 200, 0.3);
        let mut checker = Checker::new(triangles, Vec::new());
        for i in 0..checked(2000) {
            let of = random.below(200);
            let target = random.on(&checker.scene.triangles[of]);
            let o = target + distance * random.direction();
            let d = (target - o) * if i % 2 == 0 { 1.0 } else { 1.0 / distance };
            checker.check(&Ray::new(o, d), None);
        }
        assert!(checker.hits > checked(100), "{} rays hit", checker.hits);
    }
}

/// One huge triangle and one huge sphere, and many small triangles near them.
#[test]
fn on_small_triangles_on_a_ground() {
    let mut random = Random::new(9);
    for size in [1e3, 1e6, 1e9] {
        let mut triangles = soup(&mut random, 100, 0.2);
        let at = |x: f64, z: f64| Vec3::new(size * x, -1.0, size * z);
        triangles.push(Triangle::flat(at(-1.0, -1.0), at(3.0, -1.0), at(-1.0, 3.0)));
        let ground = Sphere {
            center: Vec3::new(0.0, -size - 2.0, 0.0),
            radius: size,
        };
        let mut checker = Checker::new(triangles, vec![ground]);
        rays_at(&mut checker, &mut random, 3000, 1.0);
        for _ in 0..checked(1000) {
            let o = 3.0 * random.point();
            checker.check(&Ray::new(o, random.direction()), None);
        }
        assert!(checker.hits > checked(1000), "{} rays hit", checker.hits);
    }
}

#[test]
fn on_spheres_among_triangles() {
    let mut random = Random::new(5);
    for count in [1, 2, 7, 20, 90] {
        let spheres = (0..count)
            .map(|_| Sphere {
                center: random.point(),
                radius: 0.3 * random.one(),
            })
            .collect();
        let mut checker = Checker::new(soup(&mut random, 30, 0.3), spheres);
        rays_at(&mut checker, &mut random, 1000, 1.0);
        for _ in 0..checked(1000) {
            let i = random.below(count);
            let s = checker.scene.spheres[i];
            let o = s.center + s.radius * random.direction();
            let skip = (random.one() < 0.5).then_some(PrimId(30 + i as u32));
            checker.check(&Ray::new(o, random.direction()), skip);
            let beside = s.center + s.radius * random.direction();
            let far = 3.0 * random.point();
            checker.check(&Ray::new(far, beside - far), None);
        }
    }
}

/// The walls and large spheres of a room stand apart, whatever their numbers.
#[test]
fn on_small_primitives_in_a_room() {
    let mut random = Random::new(9);
    let wall = |p: Vec3, a: Vec3, b: Vec3| {
        [
            Triangle::flat(p, p + a, p + a + b),
            Triangle::flat(p, p + a + b, p + b),
        ]
    };
    let (x, y, z) = (8.0 * Vec3::X, 8.0 * Vec3::Y, 8.0 * Vec3::Z);
    let corner = Vec3::splat(-4.0);
    for count in [3, 9, 40, 200] {
        let mut triangles = soup(&mut random, count, 0.4);
        for (p, a, b) in [
            (corner, x, y),
            (corner, x, z),
            (corner, y, z),
            (corner + y, x, z),
        ] {
            triangles.extend(wall(p, a, b));
        }
        triangles.extend(soup(&mut random, count, 0.4));
        // The same as another one, which is a tie.
        triangles.push(triangles[count]);
        let mut spheres: Vec<Sphere> = (0..count / 3)
            .map(|_| Sphere {
                center: random.point(),
                radius: 0.1,
            })
            .collect();
        spheres.push(Sphere {
            center: Vec3::new(3.0, 3.0, 3.0),
            radius: 3.0,
        });
        let mut checker = Checker::apart(triangles, spheres);
        rays_at(&mut checker, &mut random, 2000, 4.0);
        assert!(checker.hits > checked(500), "{} hits", checker.hits);
        assert!(
            checker.left_out > checked(100),
            "{} left out",
            checker.left_out
        );
    }
}

#[test]
fn on_empty_scenes_and_invalid_primitives_and_rays() {
    let mut random = Random::new(6);
    let ray = Ray::new(-Vec3::Z, Vec3::Z);
    Checker::new(Vec::new(), Vec::new()).check(&ray, None);
    let mut triangles = soup(&mut random, 20, 0.5);
    for (i, triangle) in triangles.iter_mut().enumerate().step_by(3) {
        triangle.p1[i % 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][i / 3 % 3];
    }
    let spheres = [-0.5, f64::NAN, 0.0, f64::INFINITY].map(|radius| Sphere {
        center: random.point(),
        radius,
    });
    let mut checker = Checker::new(triangles, spheres.to_vec());
    for bad in [f64::NAN, f64::INFINITY, 0.0, 1e300, 5e-324] {
        for axis in 0..3 {
            let (mut o, mut d) = (ray, ray);
            o.o[axis] = bad;
            d.d[axis] = bad;
            for ray in [o, d] {
                checker.check(&ray, None);
            }
        }
    }
    for (min_t, max_t) in [(f64::NAN, 1.0), (0.0, f64::NAN), (2.0, 1.0)] {
        checker.check(
            &Ray {
                min_t,
                max_t,
                ..ray
            },
            None,
        );
    }
    checker.check(
        &Ray {
            d: Vec3::ZERO,
            ..ray
        },
        None,
    );
    rays_at(&mut checker, &mut random, 1000, 1.0);
}

/// Large meshes and the project's scenes.
#[test]
#[ignore = "millions of rays take minutes: cargo test --release -p simd_bvh -- --ignored"]
fn on_millions_of_rays() {
    let mut random = Random::new(10);
    for kind in MeshKind::ALL {
        let mut checker = Checker::large(generate(kind, 50_000), Vec::new());
        rays_at(&mut checker, &mut random, 300_000, 1.0);
    }
    let files = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/dae");
    for file in std::fs::read_dir(files).expect("the scene files") {
        let path = file.expect("a scene file").path();
        let scene = scenes::load(&path).expect("a sound scene file").scene;
        let size = scene.bounds().extent().max_element();
        let of_spheres = scene.triangles.is_empty();
        let mut checker = Checker::large(scene.triangles, scene.spheres);
        if !of_spheres {
            rays_at(&mut checker, &mut random, 150_000, size);
        }
        for _ in 0..50_000 {
            let (from, to) = (size * random.point(), size * random.point());
            checker.check(&Ray::new(from, to - from), None);
        }
    }
    for (count, size) in [(12, 1.0), (16, 0.3), (17, 0.3), (200, 0.02), (200, 1.0)] {
        for _ in 0..20 {
            let triangles = soup(&mut random, count, size);
            let mut checker = Checker::new(triangles, Vec::new());
            rays_at(&mut checker, &mut random, 5000, 1.0);
        }
    }
}

/// Rays that single precision cannot handle, and rays that enter so many boxes of large triangles
/// that they need more space for the children to visit than others, among ordinary ones.
#[test]
fn on_unusual_and_long_rays_among_others() {
    let mut random = Random::new(12);
    let count = 30_000;
    let mut checker = Checker::large(soup(&mut random, count, 3.0), Vec::new());
    for i in 0..150 {
        let of = random.below(count);
        let target = random.on(&checker.scene.triangles[of]);
        let o = [0.5, 8.0, 8.0, 1e9][i % 4] * random.direction();
        let d = (target - o) * [1.0, 1.0, 1e-3, 1e200][i / 4 % 4];
        checker.check(&Ray::new(o, d), (i % 3 == 0).then_some(PrimId(i as u32)));
    }
    assert!(checker.hits > 100, "{} rays hit", checker.hits);
}

/// The tree prunes most of the boxes and triangles.
#[test]
fn few_boxes_and_triangles_are_tested() {
    let mesh = generate(MeshKind::ALL[0], 50_000);
    let tree = WideBvh::build(&mesh, &[]);
    // Nodes are nearly full: opening children by surface area alone makes a third more nodes.
    assert!(30 * tree.node_count() < mesh.len(), "{}", tree.node_count());
    let mut random = Random::new(7);
    let mut counts = TestCounts::default();
    let rays = 2000;
    for _ in 0..rays {
        let target = random.below(mesh.len());
        let o = 3.0 * random.direction();
        let ray = Ray::new(o, random.on(&mesh[target]) - o);
        let exact =
            &mut |id: PrimId, ray: &Ray| intersect::test_triangle(&mesh[id.0 as usize], ray);
        tree.closest(&ray, None, exact, &mut counts);
    }
    let each = |tests: u64| tests / rays;
    assert!(each(counts.box_tests) < 100, "{counts:?}");
    assert!(each(counts.prim_tests) < 30, "{counts:?}");
}
