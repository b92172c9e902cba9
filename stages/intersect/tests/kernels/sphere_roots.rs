//! The choice between the two roots, and the recorded hit.
// BEGIN SOLUTION(part1.task4)
use crate::truth::{distance_from_sphere, error_of_root};
use intersect::{intersect_sphere, test_sphere};
use kit::{PrimId, Ray, Sphere, Vec3};

/// Radius 2 around the origin.
const BALL: Sphere = Sphere {
    center: Vec3::ZERO,
    radius: 2.0,
};

fn along_x(o: f64) -> Ray {
    Ray::new(Vec3::new(o, 0.0, 0.0), Vec3::X)
}

/// Hard case 40. Code that tests only the near root misses from inside.
#[test]
fn ray_from_inside_hits_at_the_far_root() {
    assert_eq!(test_sphere(&BALL, &along_x(-1.0)), Some(3.0));
    assert_eq!(test_sphere(&BALL, &along_x(1.0)), Some(1.0));
}

/// Hard case 41. At the centre `b` is 0. With `signum(0) = 0` in `q = b + signum(b)·sqrt(..)` both
/// roots are wrong.
#[test]
fn ray_from_the_centre_hits_at_the_radius() {
    assert_eq!(test_sphere(&BALL, &along_x(0.0)), Some(2.0));
    let slow = Ray::new(Vec3::ZERO, Vec3::new(0.0, -0.25, 0.0));
    assert_eq!(test_sphere(&BALL, &slow), Some(8.0));
    for d in [Vec3::new(1.0, 2.0, 2.0), Vec3::new(-2.0, 3.0, 6.0)] {
        assert_eq!(
            test_sphere(&BALL, &Ray::new(Vec3::ZERO, d)),
            Some(2.0 / d.length())
        );
    }
}

/// Hard case 42. The root at the origin of the ray counts only if the range contains it.
#[test]
fn outward_ray_from_the_surface_has_no_positive_root() {
    let outward = along_x(2.0);
    assert_eq!(test_sphere(&BALL, &outward), Some(0.0));
    let beyond = Ray {
        min_t: 1e-300,
        ..outward
    };
    assert_eq!(test_sphere(&BALL, &beyond), None);
    // Both roots are 0: b + sqrt(b² - a·c) is 0, and the other root, c divided by it, is 0/0.
    let tangent = Ray::new(Vec3::new(2.0, 0.0, 0.0), Vec3::Y);
    assert_eq!(test_sphere(&BALL, &tangent), Some(0.0));
}

/// Hard case 43. The root at the origin of the ray must not be computed as a tiny positive `t`,
/// which would replace the far root.
#[test]
fn inward_ray_from_the_surface_hits_the_far_side() {
    let inward = Ray {
        min_t: 1e-300,
        ..along_x(-2.0)
    };
    assert_eq!(test_sphere(&BALL, &inward), Some(4.0));
    // Rays from (2, 3, 6) on the sphere of radius 7 around the origin. The second is nearly
    // tangent.
    let ball = Sphere {
        center: Vec3::ZERO,
        radius: 7.0,
    };
    for d in [
        Vec3::new(-2.0, -3.0, -6.0),
        Vec3::new(-3.0, 2.0, -0.125),
        Vec3::new(6.0, 0.0, -2.5),
    ] {
        let ray = Ray {
            min_t: 1e-12,
            ..Ray::new(Vec3::new(2.0, 3.0, 6.0), d)
        };
        let t = test_sphere(&ball, &ray).unwrap();
        assert!(error_of_root(&ball, &ray, t) <= 2.0 * f64::EPSILON * t);
        assert!(t > 0.01);
    }
}

/// Hard case 44. Both roots are negative.
#[test]
fn sphere_behind_is_missed() {
    assert_eq!(test_sphere(&BALL, &along_x(3.0)), None);
}

/// Hard case 45.
#[test]
fn far_root_counts_if_the_near_root_is_out_of_range() {
    let ray = Ray {
        min_t: 2.0,
        ..along_x(-3.0)
    };
    assert_eq!(test_sphere(&BALL, &ray), Some(5.0));
    let ray = Ray { max_t: 4.5, ..ray };
    assert_eq!(test_sphere(&BALL, &ray), None);
}

#[test]
fn ends_of_the_range_count() {
    let ranged = |min_t, max_t| Ray {
        min_t,
        max_t,
        ..along_x(-3.0)
    };
    assert_eq!(test_sphere(&BALL, &ranged(0.0, 1.0)), Some(1.0));
    assert_eq!(test_sphere(&BALL, &ranged(1.0, 9.0)), Some(1.0));
    assert_eq!(
        test_sphere(&BALL, &ranged(1.0_f64.next_up(), 5.0)),
        Some(5.0)
    );
    assert_eq!(test_sphere(&BALL, &ranged(0.0, 1.0_f64.next_down())), None);
}

/// Hard case 46. On a sphere of radius 0 the normal is 0/0.
#[test]
fn sphere_of_radius_zero_is_hit_only_exactly() {
    let point = Sphere {
        center: Vec3::new(1.0, 2.0, 3.0),
        radius: 0.0,
    };
    let mut exact = Ray::new(Vec3::new(0.0, 0.0, 1.0), Vec3::new(0.5, 1.0, 1.0));
    let hit = intersect_sphere(&point, PrimId(0), &mut exact).unwrap();
    assert_eq!((hit.t, hit.p), (2.0, point.center));
    assert_eq!(hit.n, -exact.d.normalize());
    let beside = Ray::new(Vec3::new(0.0, 1e-15, 1.0), exact.d);
    assert_eq!(test_sphere(&point, &beside), None);
    let from_it = Ray::new(point.center, Vec3::X);
    assert_eq!(test_sphere(&point, &from_it), Some(0.0));
}

/// Hard case 47 is an error in a scene file. A sphere constructed in code with a negative radius is
/// empty.
#[test]
fn negative_radius_and_non_finite_numbers_are_misses() {
    let ray = along_x(-3.0);
    for radius in [-2.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(
            test_sphere(&Sphere { radius, ..BALL }, &ray),
            None,
            "{radius}"
        );
    }
    for bad in [f64::NAN, f64::INFINITY] {
        for axis in 0..3 {
            let (mut ball, mut from, mut along) = (BALL, ray, ray);
            ball.center[axis] = bad;
            from.o[axis] = bad;
            along.d[axis] = bad;
            assert_eq!(test_sphere(&ball, &ray), None);
            assert_eq!(test_sphere(&BALL, &from), None);
            assert_eq!(test_sphere(&BALL, &along), None);
        }
    }
    assert_eq!(test_sphere(&BALL, &Ray::new(Vec3::ZERO, Vec3::ZERO)), None);
}

/// Hard case 49. `o + t·d` has the rounding error of `t`. A ray that starts there starts inside or
/// outside.
#[test]
fn hit_point_is_on_the_sphere() {
    for distance in [1.0, 1e3, 1e6, 1e9] {
        for d in [Vec3::new(1.0, 2.0, 3.0), Vec3::new(-5.0, 0.3, 0.1)] {
            let target = Vec3::new(0.3, -0.7, 1.1);
            let mut ray = Ray::new(target - distance * d, d);
            let hit = intersect_sphere(&BALL, PrimId(0), &mut ray).unwrap();
            assert!(distance_from_sphere(&BALL, hit.p) <= 2.0 * f64::EPSILON * BALL.radius);
            assert!((hit.n.length() - 1.0).abs() <= 2.0 * f64::EPSILON);
        }
    }
}
// END SOLUTION(part1.task4)
