//! Tests the sphere oracle against rational arithmetic.

use std::cmp::Ordering;

use kit::{Ray, Sphere};
use oracle::{SphereClass, sphere};

use crate::rationals::{Q, dot, minus, q, q3, value, zero};
use crate::rays::{self, Random};

/// The polynomial `a t² + 2 b t + c`. No root is computed: its sign decides on which side of a root
/// a number is.
struct Quadratic {
    a: Q,
    b: Q,
    c: Q,
}

impl Quadratic {
    fn new(s: &Sphere, ray: &Ray) -> Quadratic {
        let d = q3(ray.d);
        let f = minus(&q3(ray.o), &q3(s.center));
        Quadratic {
            a: dot(&d, &d),
            b: dot(&f, &d),
            c: dot(&f, &f) - q(s.radius) * q(s.radius),
        }
    }

    fn at(&self, t: &Q) -> Q {
        (&self.a * t + &self.b + &self.b) * t + &self.c
    }

    fn discriminant(&self) -> Q {
        &self.b * &self.b - &self.a * &self.c
    }

    /// Compares `t` with root 0 or 1.
    fn compare(&self, t: f64, root: usize) -> Ordering {
        if t.is_infinite() {
            return if t > 0.0 {
                Ordering::Greater
            } else {
                Ordering::Less
            };
        }
        let t = q(t);
        let middle = (-&self.b / &self.a).cmp(&t).reverse();
        let sign = self.at(&t).cmp(&zero());
        match (root, sign, middle) {
            (_, Ordering::Greater, side) => side,
            (0, Ordering::Less, _) | (0, Ordering::Equal, Ordering::Greater) => Ordering::Greater,
            (1, Ordering::Less, _) | (1, Ordering::Equal, Ordering::Less) => Ordering::Less,
            (_, _, _) => Ordering::Equal,
        }
    }

    /// Whether `t` is a root up to 1e-30.
    fn is_root(&self, t: &Q) -> bool {
        let slack = t * q(1e-30);
        let (low, high) = (t - &slack, t + &slack);
        let middle = -&self.b / &self.a;
        let (low, high) = if low <= high {
            (low, high)
        } else {
            (high, low)
        };
        self.at(&low) * self.at(&high) <= zero() || (low <= middle && middle <= high)
    }
}

fn root_of_hit(s: &Sphere, ray: &Ray) -> Option<usize> {
    let quadratic = Quadratic::new(s, ray);
    if quadratic.a == zero() || quadratic.discriminant() < zero() || ray.min_t > ray.max_t {
        return None;
    }
    [0, 1].into_iter().find(|root| {
        quadratic.compare(ray.min_t, *root) != Ordering::Greater
            && quadratic.compare(ray.max_t, *root) != Ordering::Less
    })
}

fn disagreements(seed: u64, count: u64, cycle: u64) {
    let mut r = Random::new(seed);
    let (mut hits, mut tangents) = (0u64, 0u64);
    for i in 0..count {
        let family = rays::family(i, cycle);
        let (s, mut ray) = rays::sphere(&mut r, family);
        if r.below(8) == 0 {
            // A range that ends at a root, as exactly as f64 can represent it.
            if let Some(roots) = sphere(&s, &ray).roots {
                let near = roots[r.below(2) as usize].to_f64();
                if r.below(2) == 0 {
                    ray.max_t = near;
                } else {
                    ray.min_t = near;
                }
            }
        }
        let verdict = sphere(&s, &ray);
        let what = || format!("{family:?} {i}: {verdict:?}\n{s:?}\n{ray:?}");
        let Some(root) = root_of_hit(&s, &ray) else {
            assert!(!verdict.hits(), "{}", what());
            continue;
        };
        hits += 1;
        let quadratic = Quadratic::new(&s, &ray);
        let class = match root {
            _ if quadratic.discriminant() == zero() => SphereClass::Tangent,
            0 => SphereClass::Near,
            _ => SphereClass::Far,
        };
        tangents += u64::from(class == SphereClass::Tangent);
        assert_eq!(verdict.class, class, "{}", what());
        let t = verdict.t.expect("a hit has a t");
        assert_eq!(
            Some(t),
            verdict.roots.map(|roots| roots[root]),
            "{}",
            what()
        );
        for t in verdict.roots.expect("a hit has roots") {
            assert!(quadratic.is_root(&value(&t)), "{}", what());
        }
        let ends = [ray.min_t, ray.max_t];
        let at_end = ends.iter().any(|end| quadratic.compare(*end, root).is_eq());
        assert_eq!(verdict.at_range_end, at_end, "{}", what());
    }
    println!("{count} pairs, {hits} hits, {tangents} tangents");
    assert!(hits > count / 10, "too few rays hit: {hits} of {count}");
    assert!(tangents > 0, "no ray touches a sphere");
}

#[test]
fn agrees_with_rationals() {
    disagreements(3, 4_000, 64);
}

/// `cargo test -p oracle --release --test oracle -- --ignored million`; takes minutes.
#[test]
#[ignore = "takes minutes; run it when the oracle's arithmetic changes"]
fn agrees_with_rationals_a_million_times() {
    disagreements(4, 1_000_000, 1024);
}
