//! Rays through edges and vertices of a single triangle: they hit.
// BEGIN SOLUTION(part1.task3)
use crate::cases;
use crate::truth::Crossing;
use intersect::test_triangle;
use kit::{Ray, Triangle, Vec3};
use proptest::prelude::*;

/// A point with small integer coordinates. Sums and products of a few of them are exact.
fn integer_point() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-40..=40_i32).prop_map(|p| Vec3::from_array(p.map(f64::from)))
}

fn integer_triangle() -> impl Strategy<Value = Triangle> {
    (integer_point(), integer_point(), integer_point())
        .prop_map(|(a, b, c)| Triangle::flat(a, b, c))
}

proptest! {
    #![proptest_config(cases(2000))]

    /// Hard case 9. With a division by `d.z`, or with `<` instead of `<=`, some rays at the middle
    /// of an edge miss. Here no rounding is needed, so every ray must hit, at exactly t = 1/2.
    #[test]
    fn edge_midpoint_with_exact_direction_is_hit(tri in integer_triangle(), o in integer_point()) {
        for (a, b) in [(tri.p0, tri.p1), (tri.p1, tri.p2), (tri.p2, tri.p0)] {
            let ray = Ray::new(o, a + b - 2.0 * o);
            let truth = Crossing::of(&tri, &ray);
            prop_assert_eq!(test_triangle(&tri, &ray).map(|hit| hit.t), truth.map(|_| 0.5));
        }
    }

    #[test]
    fn vertex_with_exact_direction_is_hit(tri in integer_triangle(), o in integer_point()) {
        for (vertex, weights) in [(tri.p0, (0.0, 0.0)), (tri.p1, (1.0, 0.0)), (tri.p2, (0.0, 1.0))] {
            let ray = Ray::new(o, vertex - o);
            let truth = Crossing::of(&tri, &ray);
            let hit = test_triangle(&tri, &ray);
            prop_assert_eq!(hit.map(|hit| hit.t), truth.map(|_| 1.0));
            if let Some(hit) = hit {
                prop_assert_eq!((hit.b1, hit.b2), weights);
            }
        }
    }

    /// Hard case 11. `if det < epsilon { miss }` culls back faces.
    #[test]
    fn back_face_is_hit_at_the_same_distance(tri in integer_triangle(), o in integer_point(), d in integer_point()) {
        let ray = Ray::new(o, d);
        let reversed = Triangle::flat(tri.p0, tri.p2, tri.p1);
        let front = test_triangle(&tri, &ray);
        let back = test_triangle(&reversed, &ray);
        prop_assert_eq!(front.map(|hit| (hit.t, hit.b1, hit.b2)), back.map(|hit| (hit.t, hit.b2, hit.b1)));
    }

    #[test]
    fn integer_coordinates_are_decided_exactly(tri in integer_triangle(), o in integer_point(), d in integer_point()) {
        let ray = Ray::new(o, d);
        let truth = Crossing::of(&tri, &ray).filter(|truth| truth.is_inside() && truth.t() >= 0.0);
        prop_assert_eq!(test_triangle(&tri, &ray).is_some(), truth.is_some());
    }
}

/// Hard case 10. Two small triangles share an edge with a large one, and their common vertex lies
/// in the middle of this edge.
#[test]
fn t_junction_is_closed_only_if_exactly_on_the_edge() {
    let large = Triangle::flat(
        Vec3::ZERO,
        Vec3::new(2.0, 0.0, 0.0),
        Vec3::new(1.0, -2.0, 0.0),
    );
    let small = |junction: Vec3| {
        let top = Vec3::new(1.0, 2.0, 0.0);
        [
            Triangle::flat(Vec3::ZERO, junction, top),
            Triangle::flat(junction, Vec3::new(2.0, 0.0, 0.0), top),
        ]
    };
    let through = |x: f64, y: f64| Ray::new(Vec3::new(x, y, 5.0), Vec3::NEG_Z);

    let on_the_edge = small(Vec3::new(1.0, 0.0, 0.0));
    for tri in [large].iter().chain(&on_the_edge) {
        assert!(test_triangle(tri, &through(1.0, 0.0)).is_some());
    }
    // A vertex off the edge leaves a real gap, however thin.
    let gap = 2.0_f64.powi(-40);
    let off_the_edge = small(Vec3::new(1.0, gap, 0.0));
    for tri in [large].iter().chain(&off_the_edge) {
        assert_eq!(test_triangle(tri, &through(1.0, 0.5 * gap)), None);
    }
}
// END SOLUTION(part1.task3)
