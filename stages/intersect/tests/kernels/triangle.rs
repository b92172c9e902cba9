//! Part 1, task 3: what a ray does at a triangle, in plain cases.
// BEGIN SOLUTION(part1.task3)
use intersect::{intersect_triangle, test_triangle};
use kit::{PrimId, Ray, Triangle, TriangleHit, Vec2, Vec3};

/// In the plane z = -2, right angle at the origin's foot.
fn corner() -> Triangle {
    Triangle::flat(
        Vec3::new(0.0, 0.0, -2.0),
        Vec3::new(4.0, 0.0, -2.0),
        Vec3::new(0.0, 4.0, -2.0),
    )
}

fn down_z(x: f64, y: f64) -> Ray {
    Ray::new(Vec3::new(x, y, 0.0), Vec3::NEG_Z)
}

#[test]
fn the_test_gives_distance_and_weights() {
    let hit = test_triangle(&corner(), &down_z(1.0, 2.0)).unwrap();
    let expected = TriangleHit {
        t: 2.0,
        b1: 0.25,
        b2: 0.5,
    };
    assert_eq!(hit, expected);
}

#[test]
fn a_ray_beside_each_edge_misses() {
    for (x, y) in [(-0.1, 1.0), (1.0, -0.1), (2.1, 2.1), (5.0, 5.0)] {
        assert_eq!(test_triangle(&corner(), &down_z(x, y)), None, "({x}, {y})");
    }
}

#[test]
fn a_triangle_behind_the_origin_is_missed() {
    let ray = Ray::new(Vec3::new(1.0, 1.0, -3.0), Vec3::NEG_Z);
    assert_eq!(test_triangle(&corner(), &ray), None);
}

#[test]
fn a_hit_is_recorded_and_shortens_the_ray() {
    let mut ray = down_z(1.0, 2.0);
    let hit = intersect_triangle(&corner(), PrimId(7), &mut ray).unwrap();
    assert_eq!(ray.max_t, 2.0);
    assert_eq!(hit.t, 2.0);
    assert_eq!(hit.p, Vec3::new(1.0, 2.0, -2.0));
    assert_eq!(hit.n, Vec3::Z);
    assert_eq!(hit.ng, Vec3::Z);
    assert_eq!(hit.uv, Vec2::new(0.25, 0.5));
    assert_eq!(hit.prim, PrimId(7));
}

#[test]
fn a_miss_leaves_the_ray_alone() {
    let before = down_z(-1.0, 0.0);
    let mut ray = before;
    assert_eq!(intersect_triangle(&corner(), PrimId(0), &mut ray), None);
    assert_eq!(ray, before);
}

#[test]
fn the_shading_normal_is_interpolated_and_unit() {
    let mut tri = corner();
    (tri.n0, tri.n1, tri.n2) = (Vec3::Z, Vec3::X, Vec3::Y);
    let hit = intersect_triangle(&tri, PrimId(0), &mut down_z(1.0, 2.0)).unwrap();
    let expected = Vec3::new(0.25, 0.5, 0.25).normalize();
    assert!((hit.n - expected).length() < 1e-15);
    assert_eq!(hit.ng, Vec3::Z);
}

#[test]
fn every_longest_axis_gives_the_same_answer() {
    let turn = |v: Vec3| Vec3::new(v.y, v.z, v.x);
    let (mut tri, mut ray) = (corner(), down_z(1.0, 2.0));
    for _ in 0..3 {
        let hit = test_triangle(&tri, &ray).unwrap();
        assert_eq!((hit.t, hit.b1, hit.b2), (2.0, 0.25, 0.5));
        tri = Triangle::flat(turn(tri.p0), turn(tri.p1), turn(tri.p2));
        (ray.o, ray.d) = (turn(ray.o), turn(ray.d));
    }
}
// END SOLUTION(part1.task3)
