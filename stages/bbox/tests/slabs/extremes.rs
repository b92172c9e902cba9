//! Boxes and rays with extreme numbers, and the ends of the range.
// BEGIN SOLUTION(part2.task2)
use bbox::intersect_bbox;
use kit::{Aabb, Interval, Ray, Vec3};

/// The cube from (-1, -1, -1) to (1, 1, 1).
const CUBE: Aabb = Aabb {
    min: Vec3::NEG_ONE,
    max: Vec3::ONE,
};

fn is_hit(b: &Aabb, o: Vec3, d: Vec3) -> bool {
    intersect_bbox(b, &Ray::new(o, d)).is_some()
}

/// Hard case 56. 1/d overflows, so that a finite t > 0 is computed as 0·∞ or ∞.
#[test]
fn denormal_direction_gives_no_false_miss() {
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
        let Interval { min, max } = inside.expect("the ray hits");
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

/// Hard case 57. If `min` and `max` are swapped where `d` is negative, (+∞, -∞) becomes the box of
/// all points.
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

/// Hard case 58. The bounding box of an infinite plane: ∞·0 is a NaN.
#[test]
fn infinite_box_is_hit() {
    let unbounded = Aabb {
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
                intersect_bbox(&unbounded, &ray),
                Some(Interval { min: 0.0, max: 7.0 })
            );
        }
    }
    let half_space = Aabb {
        min: Vec3::new(3.0, f64::NEG_INFINITY, f64::NEG_INFINITY),
        ..unbounded
    };
    assert_eq!(
        intersect_bbox(&half_space, &Ray::new(Vec3::ZERO, Vec3::X))
            .unwrap()
            .min,
        3.0
    );
    assert!(!is_hit(&half_space, Vec3::ZERO, Vec3::NEG_X));
}

/// Hard case 59. Comparisons that ignore a NaN are necessary for case 50, but a box with a NaN must
/// be a miss.
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

/// Hard case 60. If the function returned the entry behind the origin, or the exit as the entry, a
/// traversal that sorts by entry would fail.
#[test]
fn interval_of_a_ray_from_inside_starts_at_min_t() {
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
fn negative_distances_in_the_range_count() {
    let ray = Ray {
        min_t: -9.0,
        ..Ray::new(Vec3::new(3.0, 0.0, 0.0), Vec3::X)
    };
    let inside = intersect_bbox(&CUBE, &ray).unwrap();
    assert_eq!(inside.min, -4.0);
    assert!(inside.max >= -2.0 && inside.max < -2.0 + 1e-14);
}

#[test]
fn ray_with_zero_direction_is_a_point() {
    for zero in [0.0, -0.0] {
        assert!(is_hit(&CUBE, Vec3::splat(0.5), Vec3::splat(zero)));
        assert!(!is_hit(&CUBE, Vec3::splat(1.5), Vec3::splat(zero)));
    }
}
// END SOLUTION(part2.task2)
