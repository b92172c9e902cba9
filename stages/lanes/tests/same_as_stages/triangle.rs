//! `lanes::triangle` and `intersect::test_triangle`.

use crate::inputs::{Random, join, numbers, ray, vector};
use crate::widths::{Formula, at_every_width, same};
use kit::{Ray, Triangle};
use lanes::triangle::{Axes, Edges, project};
use lanes::{Mask, Real};

const MISS: f64 = 0.0;
const HIT: f64 = 1.0;
const UNDECIDED: f64 = 2.0;

/// The test, put together: the verdict, `t` and two weights.
struct TriangleTest;

impl Formula<17, 4> for TriangleTest {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 17]) -> [R; 4] {
        let ray = ray(&input);
        let axes = Axes::of(ray.d);
        let (o, d) = (axes.permute(ray.o), axes.permute(ray.d));
        let a = project(axes.permute(vector(&input[8..11])) - o, d);
        let b = project(axes.permute(vector(&input[11..14])) - o, d);
        let c = project(axes.permute(vector(&input[14..17])) - o, d);
        let edges = Edges::of([a, b, c]);
        let crossing = edges.crossing([a.z, b.z, c.z], d.z);
        let t = crossing.t;
        let [miss, hit, undecided] = [MISS, HIT, UNDECIDED].map(|x| t.constant(x));
        let certain = ray.in_range(t).choose(hit, miss);
        let verdict = crossing.is_certain.choose(certain, undecided);
        let misses = edges.agreement().less(t.constant(0.0));
        [
            misses.choose(miss, verdict),
            t,
            crossing.v / crossing.det,
            crossing.w / crossing.det,
        ]
    }
}

/// A triangle and a ray towards a vertex, an edge or any point of it, from a point of it or from
/// elsewhere.
fn pair(random: &mut Random) -> (Triangle, Ray) {
    let triangle = random.triangle();
    let p = [triangle.p0, triangle.p1, triangle.p2];
    let mut on_triangle = || {
        let [b1, b2] = random.weights();
        p[0] + b1 * (p[1] - p[0]) + b2 * (p[2] - p[0])
    };
    let [from, to] = [on_triangle(), on_triangle()];
    let size = p[0].abs().max_element();
    let far = random.of(&[2.0, 2.0, 1e6]) * size * random.point();
    let o = random.of(&[from, far, far]);
    (triangle, random.ray(o, to))
}

#[test]
fn triangles() {
    let mut random = Random::new(1);
    let pairs: Vec<(Triangle, Ray)> = (0..40_000).map(|_| pair(&mut random)).collect();
    let inputs: Vec<[f64; 17]> = pairs
        .iter()
        .map(|(t, ray)| {
            let [p0, p1, p2] = [t.p0, t.p1, t.p2].map(|p| p.to_array());
            join(&[&numbers(ray), &p0, &p1, &p2])
        })
        .collect();
    let results = at_every_width(&TriangleTest, &inputs);
    let mut counts = [0; 3];
    for ((triangle, ray), [verdict, t, b1, b2]) in pairs.iter().zip(results) {
        counts[verdict as usize] += 1;
        if verdict == UNDECIDED {
            continue;
        }
        let expected = intersect::test_triangle(triangle, ray);
        let is_same = match expected {
            Some(hit) => verdict == HIT && same(t, hit.t) && same(b1, hit.b1) && same(b2, hit.b2),
            None => verdict == MISS,
        };
        assert!(
            is_same,
            "{verdict} {t}, expected {expected:?}\n{triangle:?}\n{ray:?}"
        );
    }
    let [misses, hits, _] = counts;
    assert!(misses > 5_000 && hits > 2_000, "{counts:?}");
}
