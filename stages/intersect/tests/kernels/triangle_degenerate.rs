//! Degenerate triangles and rays: they are misses, and never give a NaN.
// BEGIN SOLUTION(part1.task3)
use intersect::{intersect_triangle, test_triangle};
use kit::{PrimId, Ray, Triangle, Vec3};

/// A triangle in the plane z = 0. The origin is the midpoint of its longest edge.
fn flat_on_z() -> Triangle {
    Triangle::flat(
        Vec3::new(-1.0, 0.0, 0.0),
        Vec3::new(1.0, 0.0, 0.0),
        Vec3::new(0.0, 1.0, 0.0),
    )
}

/// The same triangle, rotated so that no coordinate is exact.
fn rotated() -> Triangle {
    let rotation = kit::Mat3::from_axis_angle(Vec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    let tri = flat_on_z();
    Triangle::flat(rotation * tri.p0, rotation * tri.p1, rotation * tri.p2)
}

/// Hard case 12. The determinant of a parallel ray is 0 or a rounding error. A division by it can
/// give any result.
#[test]
fn parallel_ray_above_the_plane_misses() {
    for tri in [flat_on_z(), rotated()] {
        let normal = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0);
        for height in [1e-9, 1e-3, 1.0, 1e3] {
            for (w1, w2) in [(1.0, 0.0), (0.0, 1.0), (0.6, 0.8), (0.3, -0.9)] {
                let d = w1 * (tri.p1 - tri.p0) + w2 * (tri.p2 - tri.p0);
                let above_the_centroid = (tri.p0 + tri.p1 + tri.p2) / 3.0 + height * normal;
                let ray = Ray::new(above_the_centroid - 3.0 * d, d);
                assert_eq!(test_triangle(&tri, &ray), None, "{ray:?}");
            }
        }
    }
}

/// Hard case 13. A ray in the plane intersects the triangle in a segment, not in a point. By
/// convention it misses.
#[test]
fn coplanar_ray_through_the_triangle_misses() {
    for d in [Vec3::X, Vec3::new(1.0, 0.5, 0.0), Vec3::Y] {
        let ray = Ray::new(Vec3::new(0.0, 0.25, 0.0) - 5.0 * d, d);
        assert_eq!(test_triangle(&flat_on_z(), &ray), None, "{ray:?}");
    }
}

/// Hard cases 14 to 16. Without area the formulas compute 0/0.
#[test]
fn triangle_without_area_is_missed() {
    let (a, b) = (Vec3::new(-1.0, -1.0, -2.0), Vec3::new(3.0, 1.0, -4.0));
    let collinear = Triangle::flat(a, 0.5 * (a + b), b);
    let point = Triangle::flat(a, a, a);
    let two_equal = [
        Triangle::flat(a, a, b),
        Triangle::flat(a, b, a),
        Triangle::flat(b, a, a),
    ];
    for tri in [collinear, point].iter().chain(&two_equal) {
        for target in [a, b, 0.5 * (a + b), a.lerp(b, 0.3)] {
            for o in [
                Vec3::ZERO,
                Vec3::new(0.1, 0.2, 5.0),
                Vec3::new(7.0, -3.0, 0.4),
            ] {
                let ray = Ray::new(o, target - o);
                assert_eq!(test_triangle(tri, &ray), None, "{tri:?} {ray:?}");
            }
        }
    }
}

/// Hard case 32. Every comparison with a NaN is false, so `if b1 < 0 { miss }` does not reject it.
#[test]
fn non_finite_numbers_are_misses() {
    let ray = Ray::new(Vec3::new(0.0, 0.25, 1.0), Vec3::NEG_Z);
    assert!(test_triangle(&flat_on_z(), &ray).is_some());
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for axis in 0..3 {
            for vertex in 0..3 {
                let mut tri = flat_on_z();
                [&mut tri.p0, &mut tri.p1, &mut tri.p2][vertex][axis] = bad;
                assert_eq!(test_triangle(&tri, &ray), None, "{tri:?}");
            }
            let (mut from, mut along) = (ray, ray);
            from.o[axis] = bad;
            along.d[axis] = bad;
            assert_eq!(test_triangle(&flat_on_z(), &from), None, "{from:?}");
            assert_eq!(test_triangle(&flat_on_z(), &along), None, "{along:?}");
        }
    }
    for (min_t, max_t) in [(f64::NAN, 9.0), (0.0, f64::NAN)] {
        let ray = Ray {
            min_t,
            max_t,
            ..ray
        };
        assert_eq!(test_triangle(&flat_on_z(), &ray), None, "{ray:?}");
    }
}

/// Hard case 33.
#[test]
fn ray_without_direction_misses() {
    for o in [Vec3::ZERO, Vec3::new(0.0, 0.25, 0.0), Vec3::Z] {
        for d in [Vec3::ZERO, -Vec3::ZERO] {
            assert_eq!(test_triangle(&flat_on_z(), &Ray::new(o, d)), None);
        }
    }
}

/// Hard case 34. The mean of two opposite normals is 0 and cannot be normalised.
#[test]
fn opposing_vertex_normals_give_a_finite_shading_normal() {
    let mut tri = flat_on_z();
    (tri.n0, tri.n1, tri.n2) = (Vec3::X, Vec3::NEG_X, Vec3::Y);
    let mut ray = Ray::new(Vec3::Z, Vec3::NEG_Z);
    let hit = intersect_triangle(&tri, PrimId(0), &mut ray).unwrap();
    assert_eq!((hit.n, hit.ng), (Vec3::Z, Vec3::Z));

    for bad in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
        (tri.n0, tri.n1, tri.n2) = (bad, bad, bad);
        let mut ray = Ray::new(Vec3::Z, Vec3::NEG_Z);
        let hit = intersect_triangle(&tri, PrimId(0), &mut ray).unwrap();
        assert_eq!(hit.n, Vec3::Z);
    }
}
// END SOLUTION(part1.task3)
