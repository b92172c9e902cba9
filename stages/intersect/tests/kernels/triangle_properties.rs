//! Properties that hold for every triangle and ray.
// BEGIN SOLUTION(part1.task3)
use crate::cases;
use crate::triangle_scales::distance_bound;
use crate::truth::Crossing;
use intersect::{intersect_triangle, test_triangle};
use kit::{PrimId, Ray, Triangle, Vec3};
use proptest::prelude::*;

/// Smallest barycentric weight, in magnitude, for which rounding cannot change the decision. It
/// holds for well-shaped triangles at a distance of a few units: rounding errors of coordinates are
/// about 1e-16, and the smallest area is 1e-2.
const UNDECIDABLE: f64 = 1e-12;

fn point() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-1.0..1.0_f64).prop_map(Vec3::from_array)
}

/// A triangle and a ray through its plane, inside or outside of the triangle.
fn pair() -> impl Strategy<Value = (Triangle, Ray)> {
    let weight = -0.5..1.5_f64;
    (point(), point(), point(), point(), weight.clone(), weight)
        .prop_map(|(a, b, c, o, b1, b2)| {
            let target = a + b1 * (b - a) + b2 * (c - a);
            let o = 4.0 * o;
            (
                Triangle::flat(a, b, c),
                Ray::new(o, (target - o).normalize()),
            )
        })
        .prop_filter(
            "the projected area along the ray is large enough",
            |(tri, ray)| (tri.p1 - tri.p0).cross(tri.p2 - tri.p0).dot(ray.d).abs() > 0.01,
        )
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn agrees_with_exact_arithmetic((tri, ray) in pair()) {
        let truth = Crossing::of(&tri, &ray).unwrap();
        let hit = test_triangle(&tri, &ray);
        if truth.margin().abs() > UNDECIDABLE && truth.t() > UNDECIDABLE {
            prop_assert_eq!(hit.is_some(), truth.is_inside());
        }
        if let Some(hit) = hit {
            prop_assert!(truth.error_of(hit.t) <= distance_bound(&tri, &ray));
        }
    }

    /// A cyclic permutation of the axes does not change a bit of the result.
    #[test]
    fn permuted_axes_give_identical_results((tri, ray) in pair()) {
        let permute = |v: Vec3| Vec3::new(v.y, v.z, v.x);
        let permuted = Triangle::flat(permute(tri.p0), permute(tri.p1), permute(tri.p2));
        let permuted_ray = Ray { o: permute(ray.o), d: permute(ray.d), ..ray };
        prop_assert_eq!(test_triangle(&permuted, &permuted_ray), test_triangle(&tri, &ray));
    }

    #[test]
    fn result_does_not_depend_on_the_vertex_order((tri, ray) in pair()) {
        let hits = test_triangle(&tri, &ray).is_some();
        let (a, b, c) = (tri.p0, tri.p1, tri.p2);
        for (p0, p1, p2) in [(b, c, a), (c, a, b), (a, c, b), (c, b, a), (b, a, c)] {
            prop_assert_eq!(test_triangle(&Triangle::flat(p0, p1, p2), &ray).is_some(), hits);
        }
    }

    #[test]
    fn range_is_compared_with_the_returned_distance((tri, ray) in pair()) {
        if let Some(hit) = test_triangle(&tri, &ray) {
            for (min_t, max_t, hits) in [
                (hit.t, hit.t, true),
                (0.0, hit.t.next_down(), false),
                (hit.t.next_up(), f64::INFINITY, false),
            ] {
                let ray = Ray { min_t, max_t, ..ray };
                prop_assert_eq!(test_triangle(&tri, &ray), hits.then_some(hit));
            }
        }
    }

    #[test]
    fn recorded_hit_agrees_with_the_test((tri, ray) in pair(), normals in (point(), point(), point())) {
        let mut tri = tri;
        (tri.n0, tri.n1, tri.n2) =
            (normals.0.normalize(), normals.1.normalize(), normals.2.normalize());
        let tested = test_triangle(&tri, &ray);
        let mut shortened = ray;
        let hit = intersect_triangle(&tri, PrimId(3), &mut shortened);
        prop_assert_eq!(hit.map(|hit| hit.t), tested.map(|hit| hit.t));
        if let Some(hit) = hit {
            prop_assert_eq!(shortened, Ray { max_t: hit.t, ..ray });
            prop_assert!(hit.uv.x >= 0.0 && hit.uv.y >= 0.0 && hit.uv.x + hit.uv.y <= 1.0 + f64::EPSILON);
            prop_assert!((hit.p - ray.at(hit.t)).length() < 1e-14);
            prop_assert!((hit.n.length() - 1.0).abs() < 1e-15 * 4.0);
            prop_assert!((hit.ng.length() - 1.0).abs() < 1e-15 * 4.0);
            prop_assert!(hit.ng.dot(tri.p1 - tri.p0).abs() < 1e-14);
            prop_assert!(hit.ng.dot(tri.p2 - tri.p0).abs() < 1e-14);
            let b0 = 1.0 - hit.uv.x - hit.uv.y;
            let interpolated = b0 * tri.n0 + hit.uv.x * tri.n1 + hit.uv.y * tri.n2;
            prop_assert!((hit.n * interpolated.length() - interpolated).length() < 1e-14);
        }
    }
}
// END SOLUTION(part1.task3)
