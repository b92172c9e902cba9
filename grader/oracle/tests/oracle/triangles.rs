//! Tests the triangle oracle against rational arithmetic.

use kit::{Ray, Triangle};
use oracle::{TriangleClass, triangle};

use crate::rationals::{Q, agrees, cross, dot, in_range, minus, q, q3, zero};
use crate::rays::{self, Random};

/// Intersects by another method than the oracle: the plane first, then weights from areas,
/// projected along an axis in which the normal is not 0.
fn rational_hit(tri: &Triangle, ray: &Ray) -> Option<(Q, [Q; 3])> {
    let [p0, p1, p2, o, d] = [tri.p0, tri.p1, tri.p2, ray.o, ray.d].map(q3);
    let normal = cross(&minus(&p1, &p0), &minus(&p2, &p0));
    let facing = dot(&normal, &d);
    if facing == zero() {
        return None;
    }
    let t = dot(&normal, &minus(&p0, &o)) / facing;
    let p = [0, 1, 2].map(|i| &o[i] + &t * &d[i]);
    let drop = normal.iter().position(|n| *n != zero())?;
    let (j, k) = ((drop + 1) % 3, (drop + 2) % 3);
    let area = |a: &[Q; 3], b: &[Q; 3], c: &[Q; 3]| {
        (&b[j] - &a[j]) * (&c[k] - &a[k]) - (&b[k] - &a[k]) * (&c[j] - &a[j])
    };
    let all = area(&p0, &p1, &p2);
    let weights = [area(&p, &p1, &p2), area(&p0, &p, &p2), area(&p0, &p1, &p)].map(|b| b / &all);
    let hits = weights.iter().all(|b| *b >= zero())
        && in_range(&t, (ray.min_t, ray.max_t))
        && ray.min_t <= ray.max_t;
    hits.then_some((t, weights))
}

fn class_of(weights: &[Q; 3]) -> TriangleClass {
    let on_edge = [0u8, 1, 2].map(|i| weights[i as usize] == zero());
    match on_edge {
        [false, false, false] => TriangleClass::Inside,
        [true, false, false] => TriangleClass::Edge(0),
        [false, true, false] => TriangleClass::Edge(1),
        [false, false, true] => TriangleClass::Edge(2),
        [false, true, true] => TriangleClass::Vertex(0),
        [true, false, true] => TriangleClass::Vertex(1),
        _ => TriangleClass::Vertex(2),
    }
}

fn disagreements(seed: u64, count: u64, cycle: u64) {
    let mut r = Random::new(seed);
    let (mut hits, mut boundary) = (0u64, 0u64);
    for i in 0..count {
        let family = rays::family(i, cycle);
        let (tri, mut ray) = rays::triangle(&mut r, family);
        // Sometimes the range ends at the hit, as exactly as f64 can represent it.
        if i % 16 < 8
            && let Some((t, _)) = rational_hit(&tri, &ray)
            && r.below(4) == 0
        {
            let near = oracle::triangle(&tri, &ray)
                .crossing
                .map_or(0.0, |at| at.t.to_f64());
            if near.is_finite() && agrees(&oracle::BigFloat::new(near), &t) {
                boundary += 1;
            }
            if r.below(2) == 0 {
                ray.max_t = near;
            } else {
                ray.min_t = near;
            }
        }
        let verdict = triangle(&tri, &ray);
        match rational_hit(&tri, &ray) {
            None => assert!(
                !verdict.hits(),
                "{family:?} {i}: {verdict:?}\n{tri:?}\n{ray:?}"
            ),
            Some((t, weights)) => {
                hits += 1;
                let what = || format!("{family:?} {i}: {verdict:?}\n{tri:?}\n{ray:?}\n{t}");
                assert_eq!(verdict.class, class_of(&weights), "{}", what());
                let at = verdict.crossing.expect("a hit has a crossing");
                assert!(agrees(&at.t, &t), "{}", what());
                assert!(agrees(&at.b1, &weights[1]), "{}", what());
                assert!(agrees(&at.b2, &weights[2]), "{}", what());
                let ends = [ray.min_t, ray.max_t];
                let at_end = ends.iter().any(|end| end.is_finite() && q(*end) == t);
                assert_eq!(verdict.at_range_end, at_end, "{}", what());
            }
        }
    }
    println!("{count} pairs, {hits} hits, {boundary} with a range end exactly at the hit");
    assert!(hits > count / 20, "too few rays hit: {hits} of {count}");
}

#[test]
fn agrees_with_rationals() {
    disagreements(1, 4_000, 64);
}

/// `cargo test -p oracle --release --test oracle -- --ignored million`; takes minutes.
#[test]
#[ignore = "takes minutes; run it when the oracle's arithmetic changes"]
fn agrees_with_rationals_a_million_times() {
    disagreements(2, 1_000_000, 1024);
}
