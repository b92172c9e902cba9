//! The range of a ray: both ends count, and only a hit changes `max_t`.
// BEGIN SOLUTION(part1.task3)
use intersect::{intersect_triangle, test_triangle};
use kit::{PrimId, Ray, Triangle, Vec3};

fn wall() -> Triangle {
    Triangle::flat(
        Vec3::new(-1.0, -1.0, -3.0),
        Vec3::new(3.0, -1.0, -3.0),
        Vec3::new(-1.0, 3.0, -3.0),
    )
}

/// A ray that intersects the plane of `wall` at t = 3, with the given range.
fn ranged(min_t: f64, max_t: f64) -> Ray {
    Ray {
        min_t,
        max_t,
        ..Ray::new(Vec3::ZERO, Vec3::NEG_Z)
    }
}

/// Hard cases 26 and 27. A fixed `t > 1e-4` rejects valid hits of rays that start on a surface and
/// whose range includes 0.
#[test]
fn origin_on_the_plane_hits_at_zero_if_in_range() {
    let vertices = [wall().p0, wall().p1, wall().p2];
    let inside = Vec3::new(0.0, 0.25, -3.0);
    for o in vertices.into_iter().chain([inside]) {
        for d in [Vec3::NEG_Z, Vec3::Z, Vec3::new(1.0, 2.0, 3.0)] {
            let mut ray = Ray::new(o, d);
            assert_eq!(
                test_triangle(&wall(), &ray).map(|hit| hit.t),
                Some(0.0),
                "{ray:?}"
            );
            ray.min_t = 1e-300;
            assert_eq!(test_triangle(&wall(), &ray), None, "{ray:?}");
        }
    }
}

/// Hard cases 28 and 29. `t < max_t` rejects a hit at the end of the range, such as the second of
/// two coincident surfaces.
#[test]
fn ends_of_the_range_count() {
    let t = |ray: Ray| test_triangle(&wall(), &ray).map(|hit| hit.t);
    assert_eq!(t(ranged(0.0, 3.0)), Some(3.0));
    assert_eq!(t(ranged(3.0, 9.0)), Some(3.0));
    assert_eq!(t(ranged(3.0, 3.0)), Some(3.0));
    assert_eq!(t(ranged(0.0, 3.0_f64.next_down())), None);
    assert_eq!(t(ranged(3.0_f64.next_up(), 9.0)), None);
}

#[test]
fn negative_distances_in_the_range_count() {
    let mut ray = ranged(-5.0, -1.0);
    ray.d = Vec3::Z;
    assert_eq!(test_triangle(&wall(), &ray).map(|hit| hit.t), Some(-3.0));
}

/// Hard case 30. A test that shortens the ray before it tests the edges hides everything behind a
/// miss.
#[test]
fn only_a_hit_shortens_the_ray() {
    let beside = Ray::new(Vec3::new(2.5, 2.5, 0.0), Vec3::NEG_Z);
    for before in [beside, ranged(0.0, 2.0), ranged(4.0, 9.0)] {
        let mut ray = before;
        assert_eq!(intersect_triangle(&wall(), PrimId(0), &mut ray), None);
        assert_eq!(ray, before);
    }
    let mut ray = ranged(1.0, 9.0);
    intersect_triangle(&wall(), PrimId(0), &mut ray).unwrap();
    assert_eq!(ray, ranged(1.0, 3.0));
}
// END SOLUTION(part1.task3)
