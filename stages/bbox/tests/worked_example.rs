//! The worked example of the chapter of Part 2, task 2: the first test to make green.

use bbox::intersect_bbox;
use kit::{Aabb, Interval, Ray, Vec3};

#[test]
fn part2_task2_a_ray_through_a_box() {
    let cube = Aabb {
        min: -Vec3::ONE,
        max: Vec3::ONE,
    };
    let ray = Ray::new(Vec3::new(-3.0, 0.5, 0.0), Vec3::new(2.0, -0.5, 0.25));
    let inside = |ray: &Ray| intersect_bbox(&cube, ray).map(|Interval { min, max }| (min, max));
    let (enter, exit) = inside(&ray).expect("the ray hits");
    // A box may be a little larger than it is, so that no ray slips through.
    assert!(
        (enter - 1.0).abs() < 1e-12 && (exit - 2.0).abs() < 1e-12,
        "{enter} to {exit}"
    );

    let short = Ray { max_t: 0.5, ..ray };
    assert_eq!(inside(&short), None);
    let late = Ray { min_t: 1.5, ..ray };
    let (enter, exit) = inside(&late).expect("the ray hits");
    assert!(
        enter == 1.5 && (exit - 2.0).abs() < 1e-12,
        "{enter} to {exit}"
    );
}
