//! Properties that hold for every box and ray, compared with exact arithmetic.
// BEGIN SOLUTION(part2.task2)
use crate::cases;
use bbox::intersect_bbox;
use kit::{Aabb, Ray, Vec3};
use num_rational::BigRational;
use proptest::prelude::*;

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).expect("inputs are finite")
}

/// The exact interval of the ray inside the box. The range of the ray must be finite.
fn truth(b: &Aabb, ray: &Ray) -> Option<(BigRational, BigRational)> {
    let (mut entry, mut exit) = (exact(ray.min_t), exact(ray.max_t));
    for axis in 0..3 {
        let d = exact(ray.d[axis]);
        let [to_min, to_max] = [b.min, b.max].map(|plane| exact(plane[axis]) - exact(ray.o[axis]));
        if d == exact(0.0) {
            if to_min > d || to_max < d {
                return None;
            }
            continue;
        }
        let (a, b) = (to_min / &d, to_max / &d);
        let (near, far) = if a < b { (a, b) } else { (b, a) };
        entry = entry.max(near);
        exit = exit.min(far);
    }
    (entry <= exit).then_some((entry, exit))
}

/// Tolerance for a `t`: a few relative rounding errors.
fn slack(t: &BigRational) -> BigRational {
    exact(8.0 * f64::EPSILON) * t.max(&-t)
}

/// Coordinates that cause ties (halves, zeros of both signs), and arbitrary ones.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        (-4..=4_i32).prop_map(|x| 0.5 * f64::from(x)),
        Just(-0.0),
        -2.0..2.0_f64,
        (-2.0..2.0_f64, -30..0_i32).prop_map(|(x, e)| x * 2.0_f64.powi(e)),
    ]
}

fn point() -> impl Strategy<Value = Vec3> {
    [coordinate(), coordinate(), coordinate()].prop_map(Vec3::from_array)
}

fn pair() -> impl Strategy<Value = (Aabb, Ray)> {
    (
        point(),
        point(),
        point(),
        point(),
        0.0..1.0_f64,
        0.0..9.0_f64,
    )
        .prop_map(|(a, b, o, d, min_t, length)| {
            let ray = Ray {
                min_t,
                max_t: min_t + length,
                ..Ray::new(o, d)
            };
            (Aabb::of([a, b]), ray)
        })
}

proptest! {
    #![proptest_config(cases(10_000))]

    #[test]
    fn agrees_with_exact_arithmetic((b, ray) in pair()) {
        let inside = intersect_bbox(&b, &ray);
        if let Some((entry, exit)) = truth(&b, &ray) {
            prop_assert!(inside.is_some(), "false miss");
            let inside = inside.unwrap();
            let (min, max) = (exact(inside.min), exact(inside.max));
            prop_assert!(&entry - slack(&entry) <= min && min <= &entry + slack(&entry));
            prop_assert!(max <= &exit + slack(&exit));
            // Never too early, except at the end of the range.
            prop_assert!(max >= &exit - slack(&exit) && (inside.max == ray.max_t || max >= exit));
        } else if inside.is_some() {
            // A false hit must be within rounding: a slightly larger box is hit exactly.
            let grown = |v: Vec3, sign: f64| {
                v + sign * 16.0 * f64::EPSILON * (v.abs() + ray.o.abs())
            };
            let b = Aabb { min: grown(b.min, -1.0), max: grown(b.max, 1.0) };
            prop_assert!(truth(&b, &ray).is_some(), "false hit by more than rounding");
        }
    }

    /// Hard case 55. If a ray touches a box only in an edge, entry and exit are the same number,
    /// each with its own rounding errors. Comparing them without a tolerance loses some of these
    /// hits.
    #[test]
    fn ray_exactly_through_an_edge_is_hit(
        o in prop::array::uniform3(-1000..1000_i64),
        d in prop::array::uniform3(1..1_i64 << 26),
        signs in prop::array::uniform3(any::<bool>()),
        t in 1..1_i64 << 20,
    ) {
        // Integers of at most 53 bits, so the point at `t` is exact.
        let d: [i64; 3] = std::array::from_fn(|i| if signs[i] { d[i] } else { -d[i] });
        let at: [i64; 3] = std::array::from_fn(|i| o[i] + t * d[i]);
        let [o, d, at] = [o, d, at].map(|v| Vec3::from_array(v.map(|x| x as f64)));
        let ahead = d.signum();
        for (enters, leaves) in [(0, 1), (1, 2), (2, 0), (1, 0), (2, 1), (0, 2)] {
            let mut far_corner = at;
            far_corner[enters] += ahead[enters];
            far_corner[leaves] -= ahead[leaves];
            let b = Aabb::of([at, far_corner]);
            prop_assert!(intersect_bbox(&b, &Ray::new(o, d)).is_some(), "{:?} {} {}", b, o, d);
        }
    }

    /// Box tests prune: if a box inside another is hit, the outer box must be hit as well.
    #[test]
    fn interval_contains_those_of_inner_boxes((outer, ray) in pair(), f in prop::array::uniform2(0.0..=1.0_f64)) {
        let inner = Aabb::of(f.map(|f| (outer.min + f * outer.extent()).clamp(outer.min, outer.max)));
        if let Some(inner) = intersect_bbox(&inner, &ray) {
            let outer = intersect_bbox(&outer, &ray);
            prop_assert!(outer.is_some_and(|outer| outer.min <= inner.min && outer.max >= inner.max));
        }
    }

    /// Scaling scene and direction by a power of two does not change the result.
    #[test]
    fn result_does_not_depend_on_the_scale((b, ray) in pair(), exponent in -900..900_i32) {
        let s = 2.0_f64.powi(exponent);
        let scaled = Aabb { min: s * b.min, max: s * b.max };
        let scaled_ray = Ray { o: s * ray.o, d: s * ray.d, ..ray };
        let inside = intersect_bbox(&b, &ray);
        prop_assert_eq!(intersect_bbox(&scaled, &scaled_ray), inside);
    }

    #[test]
    fn permuted_axes_give_identical_results((b, ray) in pair()) {
        let permute = |v: Vec3| Vec3::new(v.y, v.z, v.x);
        let permuted = Aabb { min: permute(b.min), max: permute(b.max) };
        let permuted_ray = Ray { o: permute(ray.o), d: permute(ray.d), ..ray };
        prop_assert_eq!(intersect_bbox(&permuted, &permuted_ray), intersect_bbox(&b, &ray));
    }
}
// END SOLUTION(part2.task2)
