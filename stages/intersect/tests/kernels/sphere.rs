//! Part 1, task 4: simple cases of the ray/sphere intersection.
// BEGIN SOLUTION(part1.task4)
use intersect::{intersect_sphere, test_sphere};
use kit::{PrimId, Ray, Sphere, Vec2, Vec3};

/// Radius 3 around (0, 0, -5).
const BALL: Sphere = Sphere {
    center: Vec3::new(0.0, 0.0, -5.0),
    radius: 3.0,
};

#[test]
fn near_intersection_is_the_hit() {
    let ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
    assert_eq!(test_sphere(&BALL, &ray), Some(2.0));
}

#[test]
fn ray_outside_of_the_radius_misses() {
    let ray = Ray::new(Vec3::new(3.1, 0.0, 0.0), Vec3::NEG_Z);
    assert_eq!(test_sphere(&BALL, &ray), None);
}

#[test]
fn hit_is_recorded_and_shortens_the_ray() {
    let mut ray = Ray::new(Vec3::ZERO, Vec3::NEG_Z);
    let hit = intersect_sphere(&BALL, PrimId(7), &mut ray).unwrap();
    assert_eq!(ray.max_t, 2.0);
    assert_eq!(hit.t, 2.0);
    assert_eq!(hit.p, Vec3::new(0.0, 0.0, -2.0));
    assert_eq!((hit.n, hit.ng), (Vec3::Z, Vec3::Z));
    assert_eq!(hit.uv, Vec2::ZERO);
    assert_eq!(hit.prim, PrimId(7));
}

#[test]
fn miss_does_not_change_the_ray() {
    let before = Ray::new(Vec3::ZERO, Vec3::Z);
    let mut ray = before;
    assert_eq!(intersect_sphere(&BALL, PrimId(0), &mut ray), None);
    assert_eq!(ray, before);
}

#[test]
fn normal_points_outward_also_from_inside() {
    let mut ray = Ray::new(BALL.center, Vec3::X);
    let hit = intersect_sphere(&BALL, PrimId(0), &mut ray).unwrap();
    assert_eq!((hit.t, hit.n), (3.0, Vec3::X));
}
// END SOLUTION(part1.task4)
