//! The worked examples of the chapters of Part 1, tasks 3 and 4: the first tests to make green.

use intersect::{intersect_sphere, intersect_triangle, test_sphere, test_triangle};
use kit::{PrimId, Ray, Sphere, Triangle, Vec2, Vec3};

/// The numbers of the book have four decimals.
fn assert_near(found: Vec3, expected: [f64; 3]) {
    let expected = Vec3::from(expected);
    assert!(
        (found - expected).length() < 1e-4,
        "{found}, expected {expected}"
    );
}

#[test]
fn part1_task3_a_ray_through_a_triangle() {
    let triangle = Triangle {
        n0: Vec3::Z,
        n1: Vec3::new(0.6, 0.0, 0.8),
        n2: Vec3::new(0.0, 0.6, 0.8),
        ..Triangle::flat(Vec3::ZERO, 4.0 * Vec3::X, 4.0 * Vec3::Y)
    };
    let mut ray = Ray::new(Vec3::new(3.0, 3.0, 4.0), Vec3::new(-1.0, -0.5, -2.0));
    let hit = test_triangle(&triangle, &ray).expect("the ray hits");
    assert!((hit.t - 2.0).abs() < 1e-12, "t = {}", hit.t);
    assert!((hit.b1 - 0.25).abs() < 1e-12, "b1 = {}", hit.b1);
    assert!((hit.b2 - 0.5).abs() < 1e-12, "b2 = {}", hit.b2);

    let hit = intersect_triangle(&triangle, PrimId(7), &mut ray).expect("the ray hits");
    assert!((ray.max_t - 2.0).abs() < 1e-12, "a hit shortens the ray");
    assert_near(hit.p, [1.0, 2.0, 0.0]);
    assert_near(hit.n, [0.1642, 0.3283, 0.9302]);
    assert_near(hit.ng, [0.0, 0.0, 1.0]);
    assert!((hit.uv - Vec2::new(0.25, 0.5)).length() < 1e-12);
    assert_eq!(hit.prim, PrimId(7));
}

#[test]
fn part1_task4_a_ray_through_a_sphere() {
    let sphere = Sphere {
        center: Vec3::new(0.0, 0.0, -5.0),
        radius: 2.0,
    };
    let mut ray = Ray::new(Vec3::new(1.0, 0.0, 1.0), Vec3::new(0.0, 0.0, -2.0));
    let near = test_sphere(&sphere, &ray).expect("the ray hits");
    assert!((near - 2.1340).abs() < 1e-4, "t = {near}");

    // Clipped behind the near crossing, it hits from inside.
    ray.min_t = 2.5;
    let far = intersect_sphere(&sphere, PrimId(0), &mut ray).expect("the ray hits");
    assert!((far.t - 3.8660).abs() < 1e-4, "t = {}", far.t);
    assert_near(far.p, [1.0, 0.0, -6.7321]);
    assert_near(far.n, [0.5, 0.0, -0.8660]);
}
