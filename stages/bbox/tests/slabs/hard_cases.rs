//! Boxes without volume, rays along faces, numbers that are hardly any.
// BEGIN SOLUTION(part2.task2)
use bbox::intersect_bbox;
use kit::{Aabb, Interval, Ray, Vec3};

/// From (-1, -1, -1) to (1, 1, 1).
const CUBE: Aabb = Aabb {
    min: Vec3::NEG_ONE,
    max: Vec3::ONE,
};

fn is_hit(b: &Aabb, o: Vec3, d: Vec3) -> bool {
    intersect_bbox(b, &Ray::new(o, d)).is_some()
}

/// Hard cases 50 and 51. `(plane - o) / d` is 0/0 there, or `(plane - o)·(1/d)` is 0·∞: a NaN, that `min` and `max`
/// carry into the interval or drop on the wrong side. And -0 turns the infinity round.
#[test]
fn origin_on_a_slab_plane_along_the_slab_is_a_hit() {
    for zero in [0.0, -0.0] {
        for plane in [-1.0, 1.0] {
            let o = Vec3::new(plane, 0.0, -3.0);
            let d = Vec3::new(zero, zero, 1.0);
            let inside = intersect_bbox(&CUBE, &Ray::new(o, d)).expect("a hit");
            assert_eq!(inside.min, 2.0, "{o} {d}");
            assert!(inside.max >= 4.0 && inside.max < 4.0 + 1e-14);
            assert!(
                is_hit(&CUBE, Vec3::new(plane, plane, -3.0), d),
                "along an edge"
            );
        }
    }
}

#[test]
fn ray_along_a_slab_and_outside_it_misses() {
    for zero in [0.0, -0.0] {
        for x in [-1.5, 1.5, 1.0_f64.next_up(), -1.0_f64.next_up()] {
            let outside = x.abs() > 1.0;
            let o = Vec3::new(x, 0.0, -3.0);
            assert_eq!(is_hit(&CUBE, o, Vec3::new(zero, 0.0, 1.0)), !outside, "{x}");
        }
    }
}

/// Hard cases 52 and 53. Entry and exit of a flat box are equal: `entry < exit` loses every wall.
#[test]
fn flat_box_is_hit_across_and_in_its_plane() {
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

/// Hard case 55. At a corner three entries meet three exits, each with its own rounding error.
#[test]
fn ray_at_a_corner_or_an_edge_is_no_false_miss() {
    let b = Aabb {
        min: Vec3::new(0.1, 0.7, 1.3),
        max: Vec3::new(0.3, 1.1, 1.9),
    };
    let corner = |i: u32| {
        let pick = |bit: u32, axis: usize| {
            if i >> bit & 1 == 0 {
                b.min[axis]
            } else {
                b.max[axis]
            }
        };
        Vec3::new(pick(0, 0), pick(1, 1), pick(2, 2))
    };
    for (i, o) in (0..8).flat_map(|i| (0..50).map(move |k| (i, f64::from(k)))) {
        let o = Vec3::new(-0.3 - 0.1 * o, 0.9 * o - 20.0, 0.7);
        for other in [i, i ^ 1, i ^ 2, i ^ 4] {
            // From the origin 0 the direction is exact; from `o` it is rounded, and can pass the corner by.
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

/// Hard case 56. 1/d overflows, and 0 < t < ∞ becomes 0·∞ or ∞.
#[test]
fn denormal_direction_is_no_false_miss() {
    let tiny = 1e-310;
    let thin = Aabb {
        min: Vec3::new(1e-20, -1.0, -1.0),
        max: Vec3::new(2e-20, 1.0, 1.0),
    };
    for sign in [1.0, -1.0] {
        let mirrored = Aabb::of([sign * thin.min, sign * thin.max]);
        let inside = intersect_bbox(
            &mirrored,
            &Ray::new(Vec3::ZERO, Vec3::new(sign * tiny, 0.0, 0.0)),
        );
        let Interval { min, max } = inside.expect("a hit");
        assert!(
            (min / 1e290 - 1.0).abs() < 1e-9 && (max / 2e290 - 1.0).abs() < 1e-9,
            "{min} {max}"
        );
    }
    assert!(is_hit(
        &CUBE,
        Vec3::new(0.0, 0.0, -3.0),
        Vec3::new(tiny, -tiny, 1.0)
    ));
    assert!(is_hit(
        &CUBE,
        Vec3::new(1.0, 0.0, -3.0),
        Vec3::new(-tiny, -tiny, 1.0)
    ));
    assert!(!is_hit(
        &CUBE,
        Vec3::new(1.5, 0.0, -3.0),
        Vec3::new(-tiny, 0.0, 1.0)
    ));
}

/// Hard case 57. With `min` and `max` swapped where `d` is negative, (+∞, -∞) becomes the box of everything.
#[test]
fn empty_box_is_missed() {
    for d in [
        Vec3::X,
        Vec3::NEG_ONE,
        Vec3::new(1.0, -2.0, 0.5),
        Vec3::new(-0.0, 1.0, 0.0),
    ] {
        for o in [Vec3::ZERO, Vec3::splat(1e300)] {
            assert!(!is_hit(&Aabb::EMPTY, o, d), "{o} {d}");
            let inverted = Aabb {
                min: Vec3::ONE,
                max: Vec3::NEG_ONE,
            };
            assert!(!is_hit(&inverted, o, d), "{o} {d}");
            let inverted_on_x = Aabb {
                min: Vec3::new(1.0, -1.0, -1.0),
                max: Vec3::new(-1.0, 1.0, 1.0),
            };
            assert!(!is_hit(&inverted_on_x, o, d), "{o} {d}");
        }
    }
}

/// Hard case 58. The box of a plane without end; ∞·0 is a NaN.
#[test]
fn infinite_box_is_hit() {
    let everything = Aabb {
        min: Vec3::NEG_INFINITY,
        max: Vec3::INFINITY,
    };
    for d in [Vec3::X, Vec3::NEG_ONE, Vec3::new(0.0, -0.0, 1.0)] {
        for o in [Vec3::ZERO, Vec3::new(1e300, -5.0, 2.0)] {
            let ray = Ray {
                max_t: 7.0,
                ..Ray::new(o, d)
            };
            assert_eq!(
                intersect_bbox(&everything, &ray),
                Some(Interval { min: 0.0, max: 7.0 })
            );
        }
    }
    let half_space = Aabb {
        min: Vec3::new(3.0, f64::NEG_INFINITY, f64::NEG_INFINITY),
        ..everything
    };
    assert_eq!(
        intersect_bbox(&half_space, &Ray::new(Vec3::ZERO, Vec3::X))
            .unwrap()
            .min,
        3.0
    );
    assert!(!is_hit(&half_space, Vec3::ZERO, Vec3::NEG_X));
}

/// Hard case 59. Comparisons that ignore a NaN, which case 50 needs, must not turn a box of NaN into a hit.
#[test]
fn nan_is_a_miss() {
    for d in [
        Vec3::X,
        Vec3::new(0.3, 0.4, 0.5),
        Vec3::new(-0.0, -1.0, 0.0),
    ] {
        let ray = Ray::new(-3.0 * d, d);
        assert!(intersect_bbox(&CUBE, &ray).is_some());
        for axis in 0..3 {
            let (mut min_nan, mut max_nan) = (CUBE, CUBE);
            min_nan.min[axis] = f64::NAN;
            max_nan.max[axis] = f64::NAN;
            assert_eq!(intersect_bbox(&min_nan, &ray), None);
            assert_eq!(intersect_bbox(&max_nan, &ray), None);
            let (mut from, mut along) = (ray, ray);
            from.o[axis] = f64::NAN;
            along.d[axis] = f64::NAN;
            assert_eq!(intersect_bbox(&CUBE, &from), None);
            assert_eq!(intersect_bbox(&CUBE, &along), None);
        }
        for (min_t, max_t) in [(f64::NAN, 9.0), (0.0, f64::NAN)] {
            assert_eq!(
                intersect_bbox(
                    &CUBE,
                    &Ray {
                        min_t,
                        max_t,
                        ..ray
                    }
                ),
                None
            );
        }
    }
}

/// Hard case 60. Taking the entry behind the origin, or the exit for the entry, breaks a traversal that sorts by entry.
#[test]
fn from_inside_the_interval_starts_at_min_t() {
    for d in [Vec3::X, Vec3::NEG_ONE, Vec3::new(0.1, 0.0, -2.0)] {
        for min_t in [0.0, 0.01] {
            let ray = Ray {
                min_t,
                ..Ray::new(Vec3::splat(0.25), d)
            };
            assert_eq!(intersect_bbox(&CUBE, &ray).unwrap().min, min_t);
        }
    }
}

/// Hard case 61.
#[test]
fn box_out_of_range_is_skipped() {
    let ray = Ray::new(Vec3::new(-3.0, 0.0, 0.0), Vec3::X);
    assert_eq!(
        intersect_bbox(
            &CUBE,
            &Ray {
                max_t: 2.0_f64.next_down(),
                ..ray
            }
        ),
        None
    );
    assert_eq!(
        intersect_bbox(
            &CUBE,
            &Ray {
                min_t: 4.0 + 1e-12,
                ..ray
            }
        ),
        None
    );
    let touched = Ray { max_t: 2.0, ..ray };
    assert_eq!(
        intersect_bbox(&CUBE, &touched),
        Some(Interval { min: 2.0, max: 2.0 })
    );
    assert!(intersect_bbox(&CUBE, &Ray { min_t: 4.0, ..ray }).is_some());
}

#[test]
fn box_behind_is_in_a_range_of_negative_distances() {
    let ray = Ray {
        min_t: -9.0,
        ..Ray::new(Vec3::new(3.0, 0.0, 0.0), Vec3::X)
    };
    let inside = intersect_bbox(&CUBE, &ray).unwrap();
    assert_eq!(inside.min, -4.0);
    assert!(inside.max >= -2.0 && inside.max < -2.0 + 1e-14);
}

#[test]
fn ray_without_direction_is_a_point() {
    for zero in [0.0, -0.0] {
        assert!(is_hit(&CUBE, Vec3::splat(0.5), Vec3::splat(zero)));
        assert!(!is_hit(&CUBE, Vec3::splat(1.5), Vec3::splat(zero)));
    }
}
// END SOLUTION(part2.task2)
