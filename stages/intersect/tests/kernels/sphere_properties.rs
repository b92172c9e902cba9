//! What holds for every sphere and ray.
// BEGIN SOLUTION(part1.task4)
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
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn agrees_with_exact_arithmetic((s, ray) in pair()) {
        let everywhere = Ray { min_t: f64::NEG_INFINITY, ..ray };
        let disc = discriminant(&s, &ray);
        let near = test_sphere(&s, &everywhere);
        // What is decided in double-double or far from 0 is decided right.
        prop_assert_eq!(near.is_some(), disc >= 0.0);
        let Some(near) = near else { return Ok(()) };
        let far = test_sphere(&s, &Ray { min_t: near.next_up(), ..ray });
        let size = near.abs().max(far.map_or(0.0, f64::abs));
        // Where the roots nearly meet, Newton's step from one of them says little.
        if disc > 1e-9 {
            prop_assert!(error_of_root(&s, &ray, near) <= 8.0 * f64::EPSILON * size);
            let far = far.expect("two roots");
            prop_assert!(error_of_root(&s, &ray, far) <= 8.0 * f64::EPSILON * size);
        }
    }

    #[test]
    fn range_decides_by_the_distance_that_is_returned((s, ray) in pair()) {
        if let Some(t) = test_sphere(&s, &ray) {
            prop_assert_eq!(test_sphere(&s, &Ray { min_t: t, max_t: t, ..ray }), Some(t));
            prop_assert_eq!(test_sphere(&s, &Ray { max_t: t.next_down(), ..ray }), None);
        }
    }

    #[test]
    fn record_agrees_with_the_test((s, ray) in pair()) {
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
