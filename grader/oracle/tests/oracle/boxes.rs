//! Tests the box oracle against rational arithmetic.

use kit::{Aabb, Ray};
use oracle::bbox;
use oracle::bbox::End;

use crate::rationals::{Q, agrees, q, zero};
use crate::rays::{self, Random};

/// A rational, or the infinity of this sign.
#[derive(Clone, PartialEq, Debug)]
enum Extended {
    Infinite(i32),
    Finite(Q),
}

impl Extended {
    fn new(x: f64) -> Extended {
        if x.is_infinite() {
            return Extended::Infinite(if x > 0.0 { 1 } else { -1 });
        }
        Extended::Finite(q(x))
    }

    fn at_most(&self, other: &Extended) -> bool {
        match (self, other) {
            (Extended::Finite(a), Extended::Finite(b)) => a <= b,
            (Extended::Infinite(a), Extended::Infinite(b)) => a <= b,
            (Extended::Infinite(a), _) => *a < 0,
            (_, Extended::Infinite(b)) => *b > 0,
        }
    }

    fn is(&self, end: &End) -> bool {
        match (self, end) {
            (Extended::Infinite(sign), End::PlusInfinity) => *sign > 0,
            (Extended::Infinite(sign), End::MinusInfinity) => *sign < 0,
            (Extended::Finite(t), End::At(end)) => agrees(end, t),
            _ => false,
        }
    }
}

fn rational_interval(b: &Aabb, ray: &Ray) -> Option<(Extended, Extended)> {
    let mut near = Extended::new(ray.min_t);
    let mut far = Extended::new(ray.max_t);
    if b.is_empty() || ray.d == kit::Vec3::ZERO {
        return None;
    }
    for axis in 0..3 {
        let (o, d) = (q(ray.o[axis]), q(ray.d[axis]));
        if d == zero() {
            let inside = Extended::new(b.min[axis]).at_most(&Extended::Finite(o.clone()))
                && Extended::Finite(o.clone()).at_most(&Extended::new(b.max[axis]));
            if !inside {
                return None;
            }
            continue;
        }
        let [mut enter, mut leave] =
            [b.min[axis], b.max[axis]].map(|plane| match Extended::new(plane) {
                Extended::Finite(plane) => Extended::Finite((plane - &o) / &d),
                Extended::Infinite(sign) if d < zero() => Extended::Infinite(-sign),
                infinite => infinite,
            });
        if d < zero() {
            (enter, leave) = (leave, enter);
        }
        if near.at_most(&enter) {
            near = enter;
        }
        if leave.at_most(&far) {
            far = leave;
        }
    }
    near.at_most(&far).then_some((near, far))
}

fn disagreements(seed: u64, count: u64, cycle: u64) {
    let mut r = Random::new(seed);
    let (mut hits, mut touches) = (0u64, 0u64);
    for i in 0..count {
        let family = rays::family(i, cycle);
        let (b, ray) = rays::bounds(&mut r, family);
        let verdict = bbox(&b, &ray);
        let what = || format!("{family:?} {i}: {verdict:?}\n{b:?}\n{ray:?}");
        let Some((near, far)) = rational_interval(&b, &ray) else {
            assert!(!verdict.hits(), "{}", what());
            continue;
        };
        hits += 1;
        let inside = verdict.inside.unwrap_or_else(|_| panic!("{}", what()));
        assert!(near.is(&inside.min) && far.is(&inside.max), "{}", what());
        assert_eq!(verdict.touches, near == far, "{}", what());
        touches += u64::from(verdict.touches);
        assert!(verdict.hit_scores.robust, "{}", what());
    }
    println!("{count} pairs, {hits} hits, {touches} touches");
    assert!(hits > count / 10, "too few rays hit: {hits} of {count}");
    assert!(touches > 0, "no ray touches a box");
}

#[test]
fn agrees_with_rationals() {
    disagreements(5, 16_000, 64);
}

/// `cargo test -p oracle --release --test oracle -- --ignored million`; takes minutes.
#[test]
#[ignore = "takes minutes; run it when the oracle's arithmetic changes"]
fn agrees_with_rationals_a_million_times() {
    disagreements(6, 1_000_000, 1024);
}
