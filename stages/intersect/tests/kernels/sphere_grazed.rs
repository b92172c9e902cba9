//! Tangent rays, distant and very large spheres: cases in which the discriminant cancels.
// BEGIN SOLUTION(part1.task4)
use crate::truth::{discriminant, error_of_root};
use intersect::test_sphere;
use kit::{Ray, Sphere, Vec3};

/// Tolerance for a root, relative: a few rounding errors, if the two roots are well separated.
const FEW_ULP: f64 = 8.0 * f64::EPSILON;

/// Hard case 36. `b² - a·c` of a tangent is exactly 0 here, but its terms are large, so a single
/// rounding error decides.
#[test]
fn tangent_with_integer_coordinates_is_one_hit() {
    // Points on spheres with integer radius, and directions perpendicular to their normals.
    let tangents = [
        (Vec3::new(5.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), 5.0),
        (Vec3::new(3.0, 4.0, 0.0), Vec3::new(-4.0, 3.0, 0.0), 5.0),
        (Vec3::new(2.0, 3.0, 6.0), Vec3::new(3.0, -2.0, 0.0), 7.0),
        (Vec3::new(1.0, 4.0, 8.0), Vec3::new(4.0, -7.0, 3.0), 9.0),
        (Vec3::new(6.0, 10.0, 15.0), Vec3::new(5.0, -3.0, 0.0), 19.0),
    ];
    for (point, d, radius) in tangents {
        for center in [
            Vec3::ZERO,
            Vec3::new(12.0, -7.0, 5.0),
            Vec3::new(1e6, -3e5, 7.0),
        ] {
            for t in [1.0, 3.0, 1000.0, 65536.0] {
                let ray = Ray::new(center + point - t * d, d);
                let s = Sphere { center, radius };
                assert_eq!(discriminant(&s, &ray), 0.0, "the test ray is not tangent");
                assert_eq!(test_sphere(&s, &ray), Some(t), "{s:?} {ray:?}");
                let smaller = Sphere {
                    center,
                    radius: radius.next_down(),
                };
                assert_eq!(test_sphere(&smaller, &ray), None, "{s:?} {ray:?}");
                let larger = Sphere {
                    center,
                    radius: radius.next_up(),
                };
                assert!(test_sphere(&larger, &ray).is_some(), "{s:?} {ray:?}");
            }
        }
    }
}

/// Hard case 37. A ray 1e-6 radii inside hits and one 1e-6 radii outside misses, at any distance of
/// the origin.
#[test]
fn ray_within_1e6th_of_a_tangent_hits_or_misses_correctly() {
    for radius in [1e-3, 1.0, 250.0] {
        for distance in [3.0, 1e3, 1e6] {
            let s = Sphere {
                center: Vec3::new(0.1, -0.2, 0.3),
                radius,
            };
            let beside = |gap: f64| {
                let side = Vec3::new(0.0, radius * (1.0 + gap), 0.0);
                Ray::new(
                    s.center + side - Vec3::new(distance * radius, 0.0, 0.0),
                    Vec3::X,
                )
            };
            assert!(
                test_sphere(&s, &beside(-1e-6)).is_some(),
                "{radius} {distance}"
            );
            assert_eq!(test_sphere(&s, &beside(1e-6)), None, "{radius} {distance}");
        }
    }
}

/// Hard case 38. `b²` and `a·c` are the square of the distance, and their difference is the square
/// of the radius. It vanishes at 1e8 radii in f64 and at 1e4 radii in f32.
#[test]
fn far_sphere_is_hit() {
    for distance in [1e3, 1e4, 1e5, 1e6, 1e9, 1e12] {
        for offset in [0.0, 0.5, 0.99] {
            let s = Sphere {
                center: Vec3::new(-3.0, 1.0, 2.0),
                radius: 1.0,
            };
            let d = Vec3::new(2.0, -3.0, 6.0) / 7.0;
            let side = offset * Vec3::new(3.0, 2.0, 0.0).normalize();
            let ray = Ray::new(s.center + side - distance * d, d);
            if discriminant(&s, &ray) > 0.01 {
                let t = test_sphere(&s, &ray).expect("the ray hits");
                assert!(
                    error_of_root(&s, &ray, t) <= FEW_ULP * t,
                    "{distance} {offset}"
                );
            } else {
                // The origin is rounded so coarsely that the line is a different one.
                assert!(distance >= 1e12, "{distance} {offset}");
            }
        }
    }
}

/// Hard case 39. Near a very large sphere `c = f·f - r²` cancels, and the smaller root is
/// inaccurate.
#[test]
fn very_large_sphere_has_an_accurate_hit() {
    let ground = Sphere {
        center: Vec3::new(0.0, -1e5, 0.0),
        radius: 1e5,
    };
    for height in [1e-3, 1.7, 30.0] {
        for down in [1.0, 0.3, 0.05, 0.03] {
            let d = Vec3::new(0.6, -down, 0.8).normalize();
            let ray = Ray::new(Vec3::new(0.3, height, -0.2), d);
            let t = test_sphere(&ground, &ray).expect("the ray hits");
            assert!(t < 1e4);
            assert!(
                error_of_root(&ground, &ray, t) <= FEW_ULP * t,
                "{height} {down}"
            );
        }
    }
}

/// The same scene at scales from 2^-1000 to 2^1000. Squares overflow at 1e154 and underflow at
/// 1e-154.
#[test]
fn result_does_not_depend_on_the_scale() {
    let s = Sphere {
        center: Vec3::new(1.0, 2.0, -9.0),
        radius: 3.0,
    };
    let ray = Ray::new(Vec3::new(0.5, 0.25, 0.0), Vec3::new(0.125, 0.25, -1.0));
    let reference = test_sphere(&s, &ray).unwrap();
    for exponent in [-1000, -600, -300, 300, 600, 1000] {
        let k = 2.0_f64.powi(exponent);
        let scaled = Sphere {
            center: k * s.center,
            radius: k * s.radius,
        };
        let t = test_sphere(&scaled, &Ray::new(k * ray.o, ray.d)).expect("the ray hits");
        assert!(
            (t / k - reference).abs() <= FEW_ULP * reference,
            "{exponent}"
        );
        // Hard case 48: `d` of any length.
        let t = test_sphere(&s, &Ray::new(ray.o, k * ray.d)).expect("the ray hits");
        assert!(
            (t * k - reference).abs() <= FEW_ULP * reference,
            "{exponent}"
        );
    }
}
// END SOLUTION(part1.task4)
