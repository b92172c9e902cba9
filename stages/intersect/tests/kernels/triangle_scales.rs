//! Very small, large, thin or distant triangles: no fixed epsilon works for all of them.
// BEGIN SOLUTION(part1.task3)
use crate::cases;
use crate::truth::{Crossing, distance_from_plane, unit_normal};
use intersect::{intersect_triangle, test_triangle};
use kit::{PrimId, Ray, Triangle, TriangleHit, Vec3};
use proptest::prelude::*;

/// Bound on the error of `t`: the bound for the watertight test, doubled as in the grader, for unit
/// `d` (Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section 6.8.7).
pub(crate) fn distance_bound(tri: &Triangle, ray: &Ray) -> f64 {
    let gamma = |n: f64| n * 0.5 * f64::EPSILON / (1.0 - n * 0.5 * f64::EPSILON);
    let longest = ray.d.abs().max_position();
    let permuted = |v: Vec3| Vec3::from_array([1, 2, 0].map(|i| v[(longest + i) % 3]));
    let d = permuted(ray.d);
    let points = [tri.p0, tri.p1, tri.p2].map(|p| {
        let p = permuted(p - ray.o);
        Vec3::new(p.x - d.x / d.z * p.z, p.y - d.y / d.z * p.z, p.z / d.z)
    });
    let largest = points.iter().fold(Vec3::ZERO, |m, p| m.max(p.abs()));
    let edge = |i: usize, j: usize| points[i].x * points[j].y - points[i].y * points[j].x;
    let edges = [edge(1, 2), edge(2, 0), edge(0, 1)];
    let det: f64 = edges.iter().sum();
    let max_edge = edges.iter().fold(0.0_f64, |m, e| m.max(e.abs()));
    let delta_x = gamma(5.0) * (largest.x + largest.z);
    let delta_y = gamma(5.0) * (largest.y + largest.z);
    let delta_z = gamma(3.0) * largest.z;
    let delta_e =
        2.0 * (gamma(2.0) * largest.x * largest.y + delta_y * largest.x + delta_x * largest.y);
    let delta_t = 3.0
        * (gamma(3.0) * max_edge * largest.z + delta_e * largest.z + delta_z * max_edge)
        / det.abs();
    2.0 * delta_t
}

/// Asserts that `ray` hits `tri` and that the error of `t` is within the bound.
fn assert_hit_within_bound(tri: &Triangle, ray: &Ray) -> Result<(), TestCaseError> {
    let truth = Crossing::of(tri, ray).expect("the ray is not parallel");
    prop_assert!(
        truth.is_inside(),
        "the test ray misses by {:e}",
        truth.margin()
    );
    let hit = test_triangle(tri, ray);
    prop_assert!(hit.is_some(), "{:?} {:?} is missed", tri, ray);
    let error = truth.error_of(hit.unwrap().t);
    let bound = distance_bound(tri, ray);
    prop_assert!(
        error <= bound,
        "the error of t is {error:e}, the bound is {bound:e}"
    );
    Ok(())
}

fn point() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-1.0..1.0_f64).prop_map(Vec3::from_array)
}

/// A triangle of sufficient area in a cube of size 2, and a unit ray from a distance of about 5 to
/// its interior.
fn well_shaped_hit() -> impl Strategy<Value = (Triangle, Ray)> {
    let triangle = (point(), point(), point()).prop_map(|(a, b, c)| Triangle::flat(a, b, c));
    (triangle, point())
        .prop_map(|(tri, o)| {
            let target = 0.4 * tri.p0 + 0.3 * tri.p1 + 0.3 * tri.p2;
            let o = target + 5.0 * o;
            (tri, Ray::new(o, (target - o).normalize()))
        })
        .prop_filter(
            "the projected area along the ray is large enough",
            |(tri, ray)| (tri.p1 - tri.p0).cross(tri.p2 - tri.p0).dot(ray.d).abs() > 0.01,
        )
}

fn scaled(tri: &Triangle, s: f64) -> Triangle {
    Triangle::flat(s * tri.p0, s * tri.p1, s * tri.p2)
}

/// Products of coordinates and direction overflow, underflow and become denormal in all
/// combinations.
#[test]
fn all_scales_of_scene_and_direction() {
    let tri = Triangle::flat(
        Vec3::new(-0.7, -0.9, 0.1),
        Vec3::new(0.8, -0.3, -0.2),
        Vec3::new(0.1, 0.9, 0.3),
    );
    let ray = Ray::new(Vec3::new(0.3, -0.2, 3.0), Vec3::new(-0.1, 0.03, -0.9));
    let reference = test_triangle(&tri, &ray).unwrap().t;
    for size in (-1000..1000_i32).step_by(10) {
        for speed in (-1000..1000)
            .step_by(10)
            .filter(|speed| (size - speed).abs() < 1000)
        {
            let (size, speed) = (2.0_f64.powi(size), 2.0_f64.powi(speed));
            let hit = test_triangle(&scaled(&tri, size), &Ray::new(size * ray.o, speed * ray.d));
            let t = hit.expect("the ray hits").t / (size / speed);
            assert!(
                (t - reference).abs() <= 4.0 * f64::EPSILON * reference,
                "{size:e} {speed:e}: {t}"
            );
        }
    }
}

/// Hard case 35. The origin is in the plane of the triangles, and the direction is out of it by
/// less than the product of two weights can express. Only the triangle with the origin is hit.
#[test]
fn ray_that_is_almost_in_the_plane_hits_one_triangle() {
    let at = |x: i32, z: i32| Vec3::new(f64::from(x), 0.0, f64::from(z));
    let triangle = |x: i32, z: i32| Triangle::flat(at(x, z), at(x + 1, z), at(x, z + 1));
    for out_of_plane in [1e-100, 1e-150, 1e-200, 1e-300] {
        let ray = Ray::new(
            Vec3::new(0.25, 0.0, 0.25),
            Vec3::new(0.0, out_of_plane, -1.0),
        );
        for (x, z) in (-3..4).flat_map(|x| (-3..4).map(move |z| (x, z))) {
            let hit = test_triangle(&triangle(x, z), &ray);
            let expected = (x, z) == (0, 0);
            assert_eq!(
                hit.is_some(),
                expected,
                "{out_of_plane:e}, ({x}, {z}): {hit:?}"
            );
        }
    }
}

/// Tolerance for normals: a plain cross product is accepted if at most ten of its 53 bits cancel.
const NORMAL_TOLERANCE: f64 = 4096.0 * f64::EPSILON;

proptest! {
    #![proptest_config(cases(300))]

    /// Hard cases 17, 18 and 19. `if det.abs() < 1e-8 { miss }` rejects every triangle of a small
    /// scene. In f32 the products of coordinates underflow at 1e-15 and overflow at 1e15; in f64
    /// they do at 1e-100 and 1e100.
    #[test]
    fn result_does_not_depend_on_the_scale((tri, ray) in well_shaped_hit(), exponent in -900..900_i32) {
        let reference = test_triangle(&tri, &ray).unwrap();
        for exponent in [exponent, -20, -50, 50, -500, 500] {
            // Powers of two, so that scaling is exact.
            let s = 2.0_f64.powi(exponent);
            let hit = test_triangle(&scaled(&tri, s), &Ray::new(s * ray.o, ray.d));
            prop_assert!(hit.is_some(), "missed at a scale of {s:e}");
            let TriangleHit { t, b1, b2 } = hit.unwrap();
            prop_assert!((t / s - reference.t).abs() <= distance_bound(&tri, &ray));
            prop_assert!((b1 - reference.b1).abs() < 1e-12 && (b2 - reference.b2).abs() < 1e-12);
        }
    }

    /// Hard case 31. A direction without unit length is valid: `t` counts multiples of its length.
    /// At extreme scales the products of coordinates and direction overflow and underflow in all
    /// combinations.
    #[test]
    fn t_is_measured_in_lengths_of_d(
        (tri, ray) in well_shaped_hit(),
        size in -900..900_i32,
        speed in -900..900_i32,
    ) {
        let reference = test_triangle(&tri, &ray).unwrap().t;
        for (size, speed) in [(0, speed), (0, 3), (size, speed)] {
            let (size, speed) = (2.0_f64.powi(size), 2.0_f64.powi(speed));
            let unit = size / speed;
            prop_assume!(unit.is_normal() && (reference * unit).is_normal());
            let hit = test_triangle(&scaled(&tri, size), &Ray::new(size * ray.o, speed * ray.d));
            prop_assert!(hit.is_some(), "missed");
            let t = hit.unwrap().t / unit;
            prop_assert!((t - reference).abs() <= distance_bound(&tri, &ray), "{t} {reference}");
        }
    }

    /// The normal of a needle is a small difference of products, and the normal of a tiny triangle
    /// underflows. With a vertex at the origin the edges are exact.
    #[test]
    fn geometric_normal_is_that_of_the_plane(
        (tri, ray) in well_shaped_hit(),
        width in 0.0..12.0_f64,
        size in -900..900_i32,
    ) {
        let (e1, e2) = (tri.p1 - tri.p0, tri.p2 - tri.p0);
        let p2 = 0.37 * e1 + kit::math::pow(10.0, -width) * e2;
        let needle = Triangle::flat(Vec3::ZERO, e1, p2);
        let target = (needle.p1 + needle.p2) / 3.0;
        let s = 2.0_f64.powi(size);
        let mut ray = Ray::new(s * (target - ray.d), ray.d);
        let hit = intersect_triangle(&scaled(&needle, s), PrimId(0), &mut ray);
        // The midpoint of the thinnest needles is rounded to a point outside of them.
        prop_assert!(hit.is_some() || width > 10.0);
        if let Some(hit) = hit {
            prop_assert!((hit.ng - unit_normal(&needle)).length() < NORMAL_TOLERANCE);
        }
    }

    /// The plain formula gives the exact signs of the weights, but their digits are rounding errors
    /// if the products cancel. Along an axis nothing else is rounded, so `t` can be accurate to the
    /// last few bits.
    #[test]
    fn needle_seen_along_an_axis_has_an_accurate_distance(
        (a, b) in (point(), point()),
        along in 0.1..0.9_f64,
        width in 8.0..13.0_f64,
    ) {
        let thin = kit::math::pow(10.0, -width);
        let side = thin * Vec3::new(b.y - a.y, a.x - b.x, 0.0);
        let middle = a.lerp(b, along);
        let middle = Vec3::new(middle.x, middle.y, 0.0);
        let needle = Triangle::flat(a - middle, b - middle, side);
        let ray = Ray { min_t: -9.0, ..Ray::new(Vec3::ZERO, Vec3::NEG_Z) };
        let truth = Crossing::of(&needle, &ray);
        prop_assume!(truth.as_ref().is_some_and(Crossing::is_inside));
        let hit = test_triangle(&needle, &ray);
        prop_assert!(hit.is_some());
        let error = truth.unwrap().error_of(hit.unwrap().t);
        prop_assert!(error <= 4.0 * f64::EPSILON, "{error:e}");
    }

    /// Hard case 20.
    #[test]
    fn sliver_is_hit((tri, ray) in well_shaped_hit(), width in 3.0..9.0_f64) {
        let thin = kit::math::pow(10.0, -width);
        let p2 = tri.p0.lerp(tri.p1, 0.37) + thin * (tri.p2 - tri.p0);
        let sliver = Triangle::flat(tri.p0, tri.p1, p2);
        let target = (sliver.p0 + sliver.p1 + sliver.p2) / 3.0;
        let ray = Ray::new(ray.o, (target - ray.o).normalize());
        assert_hit_within_bound(&sliver, &ray)?;
    }

    /// Hard case 22. `if t <= delta_t { miss }`, meant to reject hits behind the origin, rejects
    /// hits in front of it.
    #[test]
    fn flattened_triangle_is_hit((tri, ray) in well_shaped_hit(), flat in 3.0..6.0_f64) {
        let thin = kit::math::pow(10.0, -flat);
        let flatten = |p: Vec3| Vec3::new(p.x, p.y, thin * p.z);
        let flattened = Triangle::flat(flatten(tri.p0), flatten(tri.p1), flatten(tri.p2));
        let target = 0.4 * flattened.p0 + 0.3 * flattened.p1 + 0.3 * flattened.p2;
        let o = flatten(ray.o);
        prop_assert!(test_triangle(&flattened, &Ray::new(o, target - o)).is_some());
    }

    /// Hard case 23. Far from the origin coordinates are coarse, and the input is a rounded
    /// triangle. The result must be correct for the rounded triangle.
    #[test]
    fn offset_of_a_million_is_exact_on_the_rounded_input((tri, ray) in well_shaped_hit(), offset in point()) {
        let offset = 1e6 * offset;
        let far = Triangle::flat(tri.p0 + offset, tri.p1 + offset, tri.p2 + offset);
        let o = ray.o + offset;
        let target = 0.4 * far.p0 + 0.3 * far.p1 + 0.3 * far.p2;
        assert_hit_within_bound(&far, &Ray::new(o, (target - o).normalize()))?;
    }

    /// Hard cases 24 and 35. At an angle of 1e-4 or less to the plane the determinant is small
    /// compared to its terms.
    #[test]
    fn grazing_ray_is_within_the_bound(
        (tri, _) in well_shaped_hit(),
        grazing in 4.0..7.0_f64,
        turn in 0.0..std::f64::consts::TAU,
    ) {
        let normal = (tri.p1 - tri.p0).cross(tri.p2 - tri.p0).normalize();
        let along = (tri.p1 - tri.p0).normalize();
        let along = kit::math::cos(turn) * along + kit::math::sin(turn) * normal.cross(along);
        let target = 0.4 * tri.p0 + 0.3 * tri.p1 + 0.3 * tri.p2;
        let d = (along - kit::math::pow(10.0, -grazing) * normal).normalize();
        assert_hit_within_bound(&tri, &Ray::new(target - 3.0 * d, d))?;
    }

    /// Hard case 25. `o + t·d` has the rounding error of `t`, which is 1e-6 at t = 1e10. The
    /// vertices do not.
    #[test]
    fn hit_point_is_on_the_plane_however_far_the_origin((tri, ray) in well_shaped_hit(), distance in 0.0..9.0_f64) {
        let target = 0.4 * tri.p0 + 0.3 * tri.p1 + 0.3 * tri.p2;
        let o = target - kit::math::pow(10.0, distance) * ray.d;
        let mut ray = Ray::new(o, ray.d);
        if let Some(hit) = intersect_triangle(&tri, PrimId(0), &mut ray) {
            // Coordinates are at most 1, so this is a few units in the last place.
            prop_assert!(distance_from_plane(&tri, hit.p) < 8.0 * f64::EPSILON);
        }
    }
}
// END SOLUTION(part1.task3)
