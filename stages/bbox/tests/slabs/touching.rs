//! Rays along faces and through edges and corners, and boxes without volume.
// BEGIN SOLUTION(part2.task2)
use bbox::intersect_bbox;
use kit::{Aabb, Ray, Vec3};

/// The cube from (-1, -1, -1) to (1, 1, 1).
const CUBE: Aabb = Aabb {
    min: Vec3::NEG_ONE,
    max: Vec3::ONE,
};

fn is_hit(b: &Aabb, o: Vec3, d: Vec3) -> bool {
    intersect_bbox(b, &Ray::new(o, d)).is_some()
}

/// Hard cases 50 and 51. `(plane - o) / d` is 0/0, or `(plane - o)·(1/d)` is 0·∞: a NaN, which
/// `min` and `max` propagate into the interval or ignore on the wrong side. And -0 gives an
/// infinity of the wrong sign.
#[test]
fn ray_in_the_plane_of_a_face_is_a_hit() {
    for zero in [0.0, -0.0] {
        for plane in [-1.0, 1.0] {
            let o = Vec3::new(plane, 0.0, -3.0);
            let d = Vec3::new(zero, zero, 1.0);
            let inside = intersect_bbox(&CUBE, &Ray::new(o, d)).expect("the ray hits");
            assert_eq!(inside.min, 2.0, "{o} {d}");
            assert!(inside.max >= 4.0 && inside.max < 4.0 + 1e-14);
            assert!(
                is_hit(&CUBE, Vec3::new(plane, plane, -3.0), d),
                "a ray along an edge must hit"
            );
        }
    }
}

#[test]
fn ray_parallel_to_a_slab_and_outside_misses() {
    for zero in [0.0, -0.0] {
        for x in [-1.5, 1.5, 1.0_f64.next_up(), -1.0_f64.next_up()] {
            let outside = x.abs() > 1.0;
            let o = Vec3::new(x, 0.0, -3.0);
            assert_eq!(is_hit(&CUBE, o, Vec3::new(zero, 0.0, 1.0)), !outside, "{x}");
        }
    }
}

/// Hard cases 52 and 53. Entry and exit of a flat box are equal, so `entry < exit` rejects every
/// wall.
#[test]
fn flat_box_is_hit_from_outside_and_in_its_plane() {
    let wall = Aabb {
        min: Vec3::new(-1.0, -1.0, 0.0),
        max: Vec3::new(1.0, 1.0, 0.0),
    };
    assert!(is_hit(&wall, Vec3::new(0.0, 0.0, 2.0), Vec3::NEG_Z));
    assert!(is_hit(
        &wall,
        Vec3::new(0.3, 0.1, 0.7),
        Vec3::new(0.1, -0.3, -0.7)
    ));
    for zero in [0.0, -0.0] {
        assert!(is_hit(
            &wall,
            Vec3::new(-3.0, 0.5, 0.0),
            Vec3::new(1.0, 0.1, zero)
        ));
        assert!(is_hit(
            &wall,
            Vec3::new(-3.0, 0.5, zero),
            Vec3::new(1.0, zero, zero)
        ));
        assert!(!is_hit(
            &wall,
            Vec3::new(-3.0, 0.5, 1e-9),
            Vec3::new(1.0, zero, zero)
        ));
    }
}

/// Hard case 54.
#[test]
fn point_box_is_hit() {
    let p = Vec3::new(0.1, 0.2, 0.3);
    let point = Aabb { min: p, max: p };
    for o in [
        Vec3::ZERO,
        Vec3::new(7.0, 0.2, 0.3),
        Vec3::new(0.1, 5.0, -1.0),
        p,
    ] {
        assert!(is_hit(&point, o, p - o), "{o}");
    }
    assert!(!is_hit(&point, Vec3::ZERO, Vec3::new(0.1, 0.2, 0.31)));
}

/// Hard case 55. At a corner three entries equal three exits, each with its own rounding error.
#[test]
fn rays_to_corners_and_edges_give_no_false_miss() {
    let b = Aabb {
        min: Vec3::new(0.1, 0.7, 1.3),
        max: Vec3::new(0.3, 1.1, 1.9),
    };
    let corner = |i: u32| {
        let coordinate = |bit: u32, axis: usize| {
            if i >> bit & 1 == 0 {
                b.min[axis]
            } else {
                b.max[axis]
            }
        };
        Vec3::new(coordinate(0, 0), coordinate(1, 1), coordinate(2, 2))
    };
    for (i, o) in (0..8).flat_map(|i| (0..50).map(move |k| (i, f64::from(k)))) {
        let o = Vec3::new(-0.3 - 0.1 * o, 0.9 * o - 20.0, 0.7);
        for other in [i, i ^ 1, i ^ 2, i ^ 4] {
            // From the origin (0, 0, 0) the direction is exact. From `o` it is rounded, and the ray
            // can miss the corner.
            let target = 0.5 * (corner(i) + corner(other));
            assert!(is_hit(&b, Vec3::ZERO, target), "{target}");
            let ray = Ray::new(o, target - o);
            let at = ray.at(1.0);
            if b.contains(&Aabb { min: at, max: at }) {
                assert!(intersect_bbox(&b, &ray).is_some(), "{ray:?}");
            }
        }
    }
}
// END SOLUTION(part2.task2)
