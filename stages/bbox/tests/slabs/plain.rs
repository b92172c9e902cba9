//! Part 2, task 2: simple cases of the ray/box intersection.
// BEGIN SOLUTION(part2.task2)
use bbox::intersect_bbox;
use kit::{Aabb, Ray, Vec3};

const BOX: Aabb = Aabb {
    min: Vec3::new(1.0, -1.0, -1.0),
    max: Vec3::new(3.0, 1.0, 1.0),
};

/// Asserts entry and exit. The exit may be larger by the documented relative error.
#[track_caller]
fn assert_interval(ray: &Ray, min: f64, max: f64) {
    let inside = intersect_bbox(&BOX, ray).expect("the ray hits");
    assert_eq!(inside.min, min);
    assert!(
        inside.max >= max && inside.max <= max * (1.0 + 1e-15),
        "{inside:?}"
    );
}

#[test]
fn interval_is_between_two_faces() {
    assert_interval(&Ray::new(Vec3::ZERO, Vec3::X), 1.0, 3.0);
    assert_interval(&Ray::new(Vec3::new(4.0, 0.0, 0.0), -Vec3::X), 1.0, 3.0);
    assert_interval(
        &Ray::new(Vec3::new(0.0, -3.0, 0.0), Vec3::new(1.0, 1.0, 0.0)),
        2.0,
        3.0,
    );
}

#[test]
fn ray_outside_misses() {
    assert_eq!(
        intersect_bbox(&BOX, &Ray::new(Vec3::new(0.0, 1.5, 0.0), Vec3::X)),
        None
    );
    assert_eq!(
        intersect_bbox(&BOX, &Ray::new(Vec3::ZERO, Vec3::new(1.0, 1.1, 0.0))),
        None
    );
}

#[test]
fn box_behind_the_origin_is_missed() {
    assert_eq!(intersect_bbox(&BOX, &Ray::new(Vec3::ZERO, -Vec3::X)), None);
}

#[test]
fn interval_is_clamped_to_the_range_of_the_ray() {
    let mut ray = Ray::new(Vec3::ZERO, Vec3::X);
    (ray.min_t, ray.max_t) = (1.5, 2.5);
    assert_interval(&ray, 1.5, 2.5);
}
// END SOLUTION(part2.task2)
