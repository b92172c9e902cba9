//! Spheres that are touched, far away or huge: where the discriminant cancels.
// BEGIN SOLUTION(part1.task4)
use crate::truth::{discriminant, error_of_root};
use intersect::test_sphere;
use kit::{Ray, Sphere, Vec3};

/// The relative error that a root may have: a few roundings, far from where the two roots meet.
const FEW_ULP: f64 = 8.0 * f64::EPSILON;

/// Hard case 36. `b² - a·c` of a tangent is exactly 0 here, and its terms are large: one rounding error
/// decides.
#[test]
fn tangent_in_whole_numbers_is_one_hit() {
    // Points on spheres of whole radius, and directions at right angles to them.
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
                assert_eq!(discriminant(&s, &ray), 0.0, "the probe itself");
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

/// Hard case 37. A millionth inside is a hit, a millionth outside a miss, however far the origin.
#[test]
fn grazing_by_a_millionth_is_decided() {
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

/// Hard case 38. `b²` and `a·c` are the square of the distance, their difference that of the radius: at
/// 1e8 radii nothing is left of it in f64, at 1e4 radii in f32.
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
                let t = test_sphere(&s, &ray).expect("a hit");
                assert!(
                    error_of_root(&s, &ray, t) <= FEW_ULP * t,
                    "{distance} {offset}"
                );
            } else {
                // The origin is so coarse there that the line is another one.
                assert!(distance >= 1e12, "{distance} {offset}");
            }
        }
    }
}

/// Hard case 39. Near a huge sphere `c = f·f - r²` cancels, and with it the smaller root.
#[test]
fn ground_sphere_is_hit_where_it_is() {
    let ground = Sphere {
        center: Vec3::new(0.0, -1e5, 0.0),
        radius: 1e5,
    };
    for height in [1e-3, 1.7, 30.0] {
        for down in [1.0, 0.3, 0.05, 0.03] {
            let d = Vec3::new(0.6, -down, 0.8).normalize();
            let ray = Ray::new(Vec3::new(0.3, height, -0.2), d);
            let t = test_sphere(&ground, &ray).expect("a hit");
            assert!(t < 1e4);
            assert!(
                error_of_root(&ground, &ray, t) <= FEW_ULP * t,
                "{height} {down}"
            );
        }
    }
}

/// The same scene a thousand orders of magnitude apart: squares overflow at 1e154 and underflow at 1e-154.
#[test]
fn size_of_the_scene_does_not_matter() {
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
        let t = test_sphere(&scaled, &Ray::new(k * ray.o, ray.d)).expect("a hit");
        assert!(
            (t / k - reference).abs() <= FEW_ULP * reference,
            "{exponent}"
        );
        // Hard case 48: `d` of any length.
        let t = test_sphere(&s, &Ray::new(ray.o, k * ray.d)).expect("a hit");
        assert!(
            (t * k - reference).abs() <= FEW_ULP * reference,
            "{exponent}"
        );
    }
}
// END SOLUTION(part1.task4)
