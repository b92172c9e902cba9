//! Part 1, task 3: simple cases of the ray/triangle intersection.
// BEGIN SOLUTION(part1.task3)
use intersect::{intersect_triangle, test_triangle};
use kit::{PrimId, Ray, Triangle, TriangleHit, Vec2, Vec3};

/// A right triangle in the plane z = -2, with the right angle on the z axis.
fn right_triangle() -> Triangle {
    Triangle::flat(
        Vec3::new(0.0, 0.0, -2.0),
        Vec3::new(4.0, 0.0, -2.0),
        Vec3::new(0.0, 4.0, -2.0),
    )
}

fn ray_along_minus_z(x: f64, y: f64) -> Ray {
    Ray::new(Vec3::new(x, y, 0.0), Vec3::NEG_Z)
}

#[test]
fn test_returns_distance_and_weights() {
    let hit = test_triangle(&right_triangle(), &ray_along_minus_z(1.0, 2.0)).unwrap();
    let expected = TriangleHit {
        t: 2.0,
        b1: 0.25,
        b2: 0.5,
    };
    assert_eq!(hit, expected);
}

#[test]
fn ray_outside_of_each_edge_misses() {
    for (x, y) in [(-0.1, 1.0), (1.0, -0.1), (2.1, 2.1), (5.0, 5.0)] {
        assert_eq!(
            test_triangle(&right_triangle(), &ray_along_minus_z(x, y)),
            None,
            "({x}, {y})"
        );
    }
}

#[test]
fn triangle_behind_the_origin_is_missed() {
    let ray = Ray::new(Vec3::new(1.0, 1.0, -3.0), Vec3::NEG_Z);
    assert_eq!(test_triangle(&right_triangle(), &ray), None);
}

#[test]
fn hit_is_recorded_and_shortens_the_ray() {
    let mut ray = ray_along_minus_z(1.0, 2.0);
    let hit = intersect_triangle(&right_triangle(), PrimId(7), &mut ray).unwrap();
    assert_eq!(ray.max_t, 2.0);
    assert_eq!(hit.t, 2.0);
    assert_eq!(hit.p, Vec3::new(1.0, 2.0, -2.0));
    assert_eq!(hit.n, Vec3::Z);
    assert_eq!(hit.ng, Vec3::Z);
    assert_eq!(hit.uv, Vec2::new(0.25, 0.5));
    assert_eq!(hit.prim, PrimId(7));
}

#[test]
fn miss_does_not_change_the_ray() {
    let before = ray_along_minus_z(-1.0, 0.0);
    let mut ray = before;
    assert_eq!(
        intersect_triangle(&right_triangle(), PrimId(0), &mut ray),
        None
    );
    assert_eq!(ray, before);
}

#[test]
fn shading_normal_is_interpolated_and_unit() {
    let mut tri = right_triangle();
    (tri.n0, tri.n1, tri.n2) = (Vec3::Z, Vec3::X, Vec3::Y);
    let hit = intersect_triangle(&tri, PrimId(0), &mut ray_along_minus_z(1.0, 2.0)).unwrap();
    let expected = Vec3::new(0.25, 0.5, 0.25).normalize();
    assert!((hit.n - expected).length() < 1e-15);
    assert_eq!(hit.ng, Vec3::Z);
}

#[test]
fn result_does_not_depend_on_the_largest_axis() {
    let permute = |v: Vec3| Vec3::new(v.y, v.z, v.x);
    let (mut tri, mut ray) = (right_triangle(), ray_along_minus_z(1.0, 2.0));
    for _ in 0..3 {
        let hit = test_triangle(&tri, &ray).unwrap();
        assert_eq!((hit.t, hit.b1, hit.b2), (2.0, 0.25, 0.5));
        tri = Triangle::flat(permute(tri.p0), permute(tri.p1), permute(tri.p2));
        (ray.o, ray.d) = (permute(ray.o), permute(ray.d));
    }
}
// END SOLUTION(part1.task3)
