// BEGIN SOLUTION(part6.task1)
//! What the wide tree says is what asking every primitive says, bit for bit.

mod checked;

use checked::{Checked, Numbers};
use kit::{PrimId, Ray, Sphere, Triangle, Vec3};
use meshes::{MeshKind, generate};
use simd_bvh::{WideBvh, Work};
use std::path::Path;

fn soup(numbers: &mut Numbers, count: usize, size: f64) -> Vec<Triangle> {
    (0..count)
        .map(|_| {
            let p = numbers.point();
            let corner = |numbers: &mut Numbers| p + size * numbers.point();
            Triangle::flat(p, corner(numbers), corner(numbers))
        })
        .collect()
}

/// Rays from anywhere and from on the triangles at points on them, along axes, with both ends of the range cut.
fn rays_at(checked: &mut Checked, numbers: &mut Numbers, count: usize, scale: f64) {
    for i in 0..count {
        let of = numbers.below(checked.scene.triangles.len());
        let target = numbers.on(&checked.scene.triangles[of]);
        let other = numbers.below(checked.scene.triangles.len());
        let (o, left) = match i % 3 {
            0 => (2.0 * scale * numbers.point(), None),
            1 => {
                let from = numbers.on(&checked.scene.triangles[other]);
                (from, Some(PrimId(other as u32)))
            }
            _ => (target + scale * numbers.direction(), None),
        };
        let mut d = target - o;
        match i % 11 {
            0..=6 => d = d.normalize_or(Vec3::X),
            7 => d[numbers.below(3)] = 0.0,
            8 => d = [Vec3::X, -Vec3::Y, Vec3::Z][numbers.below(3)],
            9 => d *= 1e-3,
            _ => d[numbers.below(3)] *= 1e-19,
        }
        let mut ray = Ray::new(o, d);
        match i % 7 {
            0 => ray.max_t = 1.0,
            1 => ray.min_t = -2.0 * scale,
            2 => ray.min_t = 1.0,
            3 => (ray.min_t, ray.max_t) = (-3.0 * scale, -0.1 * scale),
            _ => {}
        }
        checked.check(&ray, left);
    }
}

#[test]
fn on_meshes() {
    for kind in MeshKind::ALL {
        let mut numbers = Numbers::new(1);
        let mut checked = Checked::new(generate(kind, 1500), Vec::new());
        rays_at(&mut checked, &mut numbers, 4000, 1.0);
        assert!(checked.hits > 1000, "{} rays hit", checked.hits);
    }
}

#[test]
fn on_soups_of_every_size() {
    let mut numbers = Numbers::new(2);
    for count in (0..40).chain([100, 300]) {
        for size in [0.01, 0.3, 2.0] {
            let triangles = soup(&mut numbers, count.max(1), size);
            let mut checked = Checked::new(triangles, Vec::new());
            rays_at(&mut checked, &mut numbers, 200, 1.0);
        }
    }
}

/// Triangles in each other's planes, twice the same, without area: ties everywhere.
#[test]
fn on_ties() {
    let mut numbers = Numbers::new(3);
    let corner = |numbers: &mut Numbers| {
        let mut p = (3.0 * numbers.point()).round() / 3.0;
        p.z = p.z.abs().round();
        p
    };
    let mut triangles: Vec<Triangle> = (0..60)
        .map(|_| {
            let mut next = || corner(&mut numbers);
            Triangle::flat(next(), next(), next())
        })
        .collect();
    triangles.extend_from_within(10..40);
    let mut checked = Checked::new(triangles, Vec::new());
    rays_at(&mut checked, &mut numbers, 20_000, 1.0);
    assert!(checked.hits > 10_000, "{} rays hit", checked.hits);
}

/// From a billionth of a billionth to beyond what single precision can hold, and far from the origin.
#[test]
fn on_every_scale_and_far_away() {
    let mut numbers = Numbers::new(4);
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
        let triangles: Vec<Triangle> = soup(&mut numbers, 100, 0.5)
            .iter()
            .map(|t| Triangle::flat(place(t.p0), place(t.p1), place(t.p2)))
            .collect();
        let mut checked = Checked::new(triangles, Vec::new());
        rays_at(&mut checked, &mut numbers, 1500, scale);
        assert!(checked.hits > 100, "{} rays hit at {scale}", checked.hits);
    }
}

/// From a billion scenes away, where a rounding error of the origin is as large as a triangle.
#[test]
fn on_what_is_seen_from_very_far_away() {
    let mut numbers = Numbers::new(8);
    for distance in [1e3, 1e5, 1e6, 1e9, 1e12, 1e15] {
        let triangles = soup(&mut numbers, 200, 0.3);
        let mut checked = Checked::new(triangles, Vec::new());
        for i in 0..2000 {
            let of = numbers.below(200);
            let target = numbers.on(&checked.scene.triangles[of]);
            let o = target + distance * numbers.direction();
            let d = (target - o) * if i % 2 == 0 { 1.0 } else { 1.0 / distance };
            checked.check(&Ray::new(o, d), None);
        }
        assert!(checked.hits > 100, "{} rays hit", checked.hits);
    }
}

/// One huge triangle or sphere, and many small ones near by.
#[test]
fn on_small_ones_on_a_ground() {
    let mut numbers = Numbers::new(9);
    for size in [1e3, 1e6, 1e9] {
        let mut triangles = soup(&mut numbers, 100, 0.2);
        let at = |x: f64, z: f64| Vec3::new(size * x, -1.0, size * z);
        triangles.push(Triangle::flat(at(-1.0, -1.0), at(3.0, -1.0), at(-1.0, 3.0)));
        let ground = Sphere {
            center: Vec3::new(0.0, -size - 2.0, 0.0),
            radius: size,
        };
        let mut checked = Checked::new(triangles, vec![ground]);
        rays_at(&mut checked, &mut numbers, 3000, 1.0);
        for _ in 0..1000 {
            let o = 3.0 * numbers.point();
            checked.check(&Ray::new(o, numbers.direction()), None);
        }
        assert!(checked.hits > 1000, "{} rays hit", checked.hits);
    }
}

#[test]
fn on_spheres_among_triangles() {
    let mut numbers = Numbers::new(5);
    for count in [1, 2, 7, 20, 90] {
        let spheres = (0..count)
            .map(|_| Sphere {
                center: numbers.point(),
                radius: 0.3 * numbers.one(),
            })
            .collect();
        let mut checked = Checked::new(soup(&mut numbers, 30, 0.3), spheres);
        rays_at(&mut checked, &mut numbers, 1000, 1.0);
        for _ in 0..1000 {
            let i = numbers.below(count);
            let s = checked.scene.spheres[i];
            let o = s.center + s.radius * numbers.direction();
            let left = (numbers.one() < 0.5).then_some(PrimId(30 + i as u32));
            checked.check(&Ray::new(o, numbers.direction()), left);
            let beside = s.center + s.radius * numbers.direction();
            let far = 3.0 * numbers.point();
            checked.check(&Ray::new(far, beside - far), None);
        }
    }
}

#[test]
fn on_nothing_and_on_what_no_ray_can_hit() {
    let mut numbers = Numbers::new(6);
    let ray = Ray::new(-Vec3::Z, Vec3::Z);
    Checked::new(Vec::new(), Vec::new()).check(&ray, None);
    let mut triangles = soup(&mut numbers, 20, 0.5);
    for (i, triangle) in triangles.iter_mut().enumerate().step_by(3) {
        triangle.p1[i % 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][i / 3 % 3];
    }
    let spheres = [-0.5, f64::NAN, 0.0, f64::INFINITY].map(|radius| Sphere {
        center: numbers.point(),
        radius,
    });
    let mut checked = Checked::new(triangles, spheres.to_vec());
    for bad in [f64::NAN, f64::INFINITY, 0.0, 1e300, 5e-324] {
        for axis in 0..3 {
            let (mut o, mut d) = (ray, ray);
            o.o[axis] = bad;
            d.d[axis] = bad;
            for ray in [o, d] {
                checked.check(&ray, None);
            }
        }
    }
    for (min_t, max_t) in [(f64::NAN, 1.0), (0.0, f64::NAN), (2.0, 1.0)] {
        checked.check(
            &Ray {
                min_t,
                max_t,
                ..ray
            },
            None,
        );
    }
    checked.check(
        &Ray {
            d: Vec3::ZERO,
            ..ray
        },
        None,
    );
    rays_at(&mut checked, &mut numbers, 1000, 1.0);
}

/// Large meshes and the project's scenes.
#[test]
#[ignore = "millions of rays take minutes: cargo test --release -p simd_bvh -- --ignored"]
fn on_millions_of_rays() {
    let mut numbers = Numbers::new(10);
    for kind in MeshKind::ALL {
        let mut checked = Checked::large(generate(kind, 50_000), Vec::new());
        rays_at(&mut checked, &mut numbers, 300_000, 1.0);
    }
    let files = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/dae");
    for file in std::fs::read_dir(files).expect("the scene files") {
        let path = file.expect("a scene file").path();
        let scene = scenes::load(&path).expect("a sound scene file").scene;
        let size = scene.bounds().extent().max_element();
        let of_spheres = scene.triangles.is_empty();
        let mut checked = Checked::large(scene.triangles, scene.spheres);
        if !of_spheres {
            rays_at(&mut checked, &mut numbers, 150_000, size);
        }
        for _ in 0..50_000 {
            let (from, to) = (size * numbers.point(), size * numbers.point());
            checked.check(&Ray::new(from, to - from), None);
        }
    }
    for (count, size) in [(12, 1.0), (16, 0.3), (17, 0.3), (200, 0.02), (200, 1.0)] {
        for _ in 0..20 {
            let triangles = soup(&mut numbers, count, size);
            let mut checked = Checked::new(triangles, Vec::new());
            rays_at(&mut checked, &mut numbers, 5000, 1.0);
        }
    }
}

/// What the tree is for: few of the boxes and triangles are asked.
#[test]
fn few_are_asked() {
    let mesh = generate(MeshKind::ALL[0], 50_000);
    let tree = WideBvh::build(&mesh, &[]);
    // Full nodes: halves that are opened by their size alone would make a third more of them.
    assert!(30 * tree.node_count() < mesh.len(), "{}", tree.node_count());
    let mut numbers = Numbers::new(7);
    let mut work = Work::default();
    let rays = 2000;
    for _ in 0..rays {
        let target = numbers.below(mesh.len());
        let o = 3.0 * numbers.direction();
        let ray = Ray::new(o, numbers.on(&mesh[target]) - o);
        let exact =
            &mut |id: PrimId, ray: &Ray| intersect::test_triangle(&mesh[id.0 as usize], ray);
        tree.closest(&ray, None, exact, &mut work);
    }
    let each = |tests: u64| tests / rays;
    assert!(each(work.box_tests) < 100, "{work:?}");
    assert!(each(work.prim_tests) < 30, "{work:?}");
}
// END SOLUTION(part6.task1)
