//! Properties that hold for every sphere and ray.
// BEGIN SOLUTION(part1.task4)
use crate::cases;
use crate::truth::{discriminant, error_of_root};
use intersect::{intersect_sphere, test_sphere};
use kit::{PrimId, Ray, Sphere, Vec2, Vec3};
use proptest::prelude::*;

fn point() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-1.0..1.0_f64).prop_map(Vec3::from_array)
}

/// A sphere and a ray that passes through it or near it.
fn pair() -> impl Strategy<Value = (Sphere, Ray)> {
    (point(), 0.01..2.0_f64, point(), point(), 0.1..3.0_f64).prop_map(
        |(center, radius, beside, o, speed)| {
            let target = center + 1.2 * radius * beside;
            let o = 4.0 * o;
            let ray = Ray::new(o, speed * (target - o).normalize_or(Vec3::X));
            (Sphere { center, radius }, ray)
        },
    )
}

proptest! {
    #![proptest_config(cases(3000))]

    #[test]
    fn agrees_with_exact_arithmetic((s, ray) in pair()) {
        let everywhere = Ray { min_t: f64::NEG_INFINITY, ..ray };
        let disc = discriminant(&s, &ray);
        let near = test_sphere(&s, &everywhere);
        // In double-double, or if the discriminant is far from 0, the decision is exact.
        prop_assert_eq!(near.is_some(), disc >= 0.0);
        let Some(near) = near else { return Ok(()) };
        // The distance by which rounding moves the line, and the factor for the intersections of a
        // nearly tangent ray.
        let half_chord = disc.sqrt() / ray.d.length();
        let size = (ray.o - s.center).length() + s.radius;
        let moved = 8.0 * f64::EPSILON * size / ray.d.length();
        let bound = moved * (s.radius / half_chord).max(1.0);
        // If the roots are nearly equal, a Newton step from one of them is no measure of its error.
        if half_chord > 1e-4 * s.radius {
            let far = test_sphere(&s, &Ray { min_t: near.next_up(), ..ray }).expect("two roots");
            prop_assert!(error_of_root(&s, &ray, near) <= bound);
            prop_assert!(error_of_root(&s, &ray, far) <= bound);
        }
    }

    /// For rays that are tangent up to sixteen digits, the seventeenth decides between hit and
    /// miss.
    #[test]
    fn nearly_tangent_rays_are_decided_exactly(
        (s, direction) in (pair().prop_map(|(s, _)| s), point()),
        distance in 0.0..6.0_f64,
        gap in 3.0..17.0_f64,
        outside in any::<bool>(),
    ) {
        let gap = kit::math::pow(10.0, -gap) * if outside { 1.0 } else { -1.0 };
        let d = direction.normalize_or(Vec3::X);
        let side = d.any_orthonormal_vector() * (s.radius * (1.0 + gap));
        let o = s.center + side - kit::math::pow(10.0, distance) * s.radius * d;
        // The origin is rounded. Computes the radius that gives this gap for the rounded origin.
        let f = o - s.center;
        let radius = f.cross(d).length() / d.length() * (1.0 - gap);
        let (s, ray) = (Sphere { radius, ..s }, Ray::new(o, d));
        prop_assert_eq!(test_sphere(&s, &ray).is_some(), discriminant(&s, &ray) >= 0.0);
    }

    /// At 1e14 radii the vector from the centre to the line is mostly rounding error if it is
    /// computed from the origin.
    #[test]
    fn distant_sphere_agrees_with_exact_arithmetic(
        (s, direction) in (pair().prop_map(|(s, _)| s), point()),
        distance in 6.0..16.0_f64,
        gap in -0.1..0.1_f64,
    ) {
        let d = direction.normalize_or(Vec3::X);
        let side = d.any_orthonormal_vector() * (s.radius * (1.0 + gap));
        let distance = kit::math::pow(10.0, distance) * s.radius;
        let ray = Ray::new(s.center + side - distance * d, d);
        prop_assert_eq!(test_sphere(&s, &ray).is_some(), discriminant(&s, &ray) >= 0.0);
    }

    #[test]
    fn range_is_compared_with_the_returned_distance((s, ray) in pair()) {
        if let Some(t) = test_sphere(&s, &ray) {
            prop_assert_eq!(test_sphere(&s, &Ray { min_t: t, max_t: t, ..ray }), Some(t));
            prop_assert_eq!(test_sphere(&s, &Ray { max_t: t.next_down(), ..ray }), None);
        }
    }

    #[test]
    fn recorded_hit_agrees_with_the_test((s, ray) in pair()) {
        let mut shortened = ray;
        let hit = intersect_sphere(&s, PrimId(5), &mut shortened);
        prop_assert_eq!(hit.map(|hit| hit.t), test_sphere(&s, &ray));
        let Some(hit) = hit else {
            prop_assert_eq!(shortened, ray);
            return Ok(());
        };
        prop_assert_eq!(shortened, Ray { max_t: hit.t, ..ray });
        prop_assert!((hit.p - ray.at(hit.t)).length() < 1e-14);
        prop_assert!((hit.n * s.radius - (hit.p - s.center)).length() < 1e-15 * 4.0);
        prop_assert!((hit.n.length() - 1.0).abs() < 1e-15);
        prop_assert_eq!((hit.ng, hit.uv, hit.prim), (hit.n, Vec2::ZERO, PrimId(5)));
    }
}
// END SOLUTION(part1.task4)
