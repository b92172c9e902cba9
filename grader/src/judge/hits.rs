//! Judging a hit record against what is right.

use super::expected::{Decision, Expected, ExpectedHit};
use super::tally::{Aspect, Class, Tally};
use kit::Vec3;
use wire::answer::Hit;
use wire::work::Ray;

/// How far the length of a normal may be from 1: a few roundings of a square root and a division.
const UNIT_BOUND: f64 = 1e-9;

/// Hit or miss. `function` is the one that answered.
pub(super) fn decision(
    tally: &mut Tally,
    call: usize,
    function: &str,
    expected: &Expected,
    answered: Option<f64>,
    ray: &Ray,
) {
    let right = match expected.decision {
        Decision::Either => true,
        Decision::Hit => answered.is_some(),
        Decision::Miss => answered.is_none(),
    };
    let class = match answered {
        _ if right => None,
        Some(_) => Some(Class::FalseHit),
        None => Some(Class::FalseMiss),
    };
    tally.judge_class(Aspect::Decision, call, class, 1.0, || match answered {
        None => {
            let t = expected.hit.map_or(f64::NAN, |hit| hit.t);
            format!(
                "{function} says miss; it hits at t = {t}. {}",
                show_ray(ray)
            )
        }
        Some(t) => format!(
            "{function} says hit at t = {t}; it misses. {}",
            show_ray(ray)
        ),
    });
}

/// Notes the aspects that a right answer with a hit shows.
pub(super) fn expect_hit(tally: &mut Tally, expected: &Expected, with_uv: bool) {
    tally.expect(Aspect::Decision);
    tally.expect(Aspect::RayAfter);
    if expected.decision == Decision::Hit {
        let always = [
            Aspect::Primitive,
            Aspect::T,
            Aspect::Position,
            Aspect::Normal,
            Aspect::GeometricNormal,
        ];
        always
            .into_iter()
            .chain(with_uv.then_some(Aspect::Barycentrics))
            .for_each(|aspect| tally.expect(aspect));
    }
}

/// Distance along the ray.
pub(super) fn t(
    tally: &mut Tally,
    call: usize,
    function: &str,
    hit: &ExpectedHit,
    answered: f64,
    ray: &Ray,
) {
    let off = (answered - hit.t).abs();
    let class = wrong_unless(off <= hit.t_bound, || Class::of_number(answered, hit.t));
    tally.judge_class(Aspect::T, call, class, off / hit.t_bound, || {
        format!(
            "{function} gives t = {answered}, right is {} (off by {off:.3e}, allowed {:.3e}). {}",
            hit.t,
            hit.t_bound,
            show_ray(ray)
        )
    });
}

fn wrong_unless(right: bool, class: impl FnOnce() -> Class) -> Option<Class> {
    if right { None } else { Some(class()) }
}

/// Barycentric weights of `p1` and `p2`.
pub(super) fn barycentrics(
    tally: &mut Tally,
    call: usize,
    function: &str,
    hit: &ExpectedHit,
    answered: [f64; 2],
    ray: &Ray,
) {
    let Some((uv, bound)) = hit.uv else { return };
    let off = (answered[0] - uv.x).abs().max((answered[1] - uv.y).abs());
    let off = if answered.iter().any(|b| b.is_nan()) {
        f64::NAN
    } else {
        off
    };
    tally.judge(
        Aspect::Barycentrics,
        call,
        off <= bound,
        off / bound,
        || {
            format!(
                "{function} gives (b1, b2) = ({}, {}), right is ({}, {}). {}",
                answered[0],
                answered[1],
                uv.x,
                uv.y,
                show_ray(ray)
            )
        },
    );
}

/// Everything in a hit record but its `t`.
pub(super) fn record(
    tally: &mut Tally,
    call: usize,
    function: &str,
    expected: &ExpectedHit,
    prim: u32,
    hit: &Hit,
    ray: &Ray,
) {
    tally.judge(Aspect::Primitive, call, hit.prim == prim, 1.0, || {
        format!(
            "{function} gives primitive {}, right is {prim}. {}",
            hit.prim,
            show_ray(ray)
        )
    });
    let p = Vec3::from(hit.p);
    let off = (p - expected.p).abs().max_element();
    let off = if p.is_nan() { f64::NAN } else { off };
    tally.judge(
        Aspect::Position,
        call,
        off <= expected.p_bound,
        off / expected.p_bound,
        || {
            format!(
                "{function} gives p = {}, right is {}. {}",
                show(p),
                show(expected.p),
                show_ray(ray)
            )
        },
    );
    normal(
        tally,
        Aspect::Normal,
        call,
        function,
        expected.n,
        expected.n_bound,
        hit.n.into(),
        ray,
    );
    normal(
        tally,
        Aspect::GeometricNormal,
        call,
        function,
        Some(expected.ng),
        expected.n_bound,
        hit.ng.into(),
        ray,
    );
}

#[allow(
    clippy::too_many_arguments,
    reason = "what is judged, against what, and what to say of it"
)]
fn normal(
    tally: &mut Tally,
    aspect: Aspect,
    call: usize,
    function: &str,
    right: Option<Vec3>,
    bound: f64,
    given: Vec3,
    ray: &Ray,
) {
    let length_off = (given.length() - 1.0).abs();
    let is_unit = length_off <= UNIT_BOUND;
    let off = right.map_or(0.0, |n| (given - n).abs().max_element());
    let off = if given.is_nan() { f64::NAN } else { off };
    let name = if aspect == Aspect::Normal { "n" } else { "ng" };
    let class = wrong_unless(off <= bound && is_unit, || {
        right.map_or(Class::Wrong, |right| Class::of_direction(given, right))
    });
    tally.judge_class(aspect, call, class, off.max(length_off), || match right {
        _ if !is_unit => {
            format!(
                "{function} gives {name} = {} of length {}, not 1. {}",
                show(given),
                given.length(),
                show_ray(ray)
            )
        }
        Some(n) => format!(
            "{function} gives {name} = {}, right is {}. {}",
            show(given),
            show(n),
            show_ray(ray)
        ),
        None => format!(
            "{function} gives {name} = {}. {}",
            show(given),
            show_ray(ray)
        ),
    });
}

/// The ray after the call: shortened to a hit, untouched by a miss.
pub(super) fn ray_after(
    tally: &mut Tally,
    call: usize,
    function: &str,
    before: &Ray,
    hit_t: Option<f64>,
    after: &Ray,
) {
    let max_t = hit_t.unwrap_or(before.max_t);
    let rest_untouched = same(
        &Ray {
            max_t: before.max_t,
            ..*after
        },
        before,
    );
    let right = after.max_t.to_bits() == max_t.to_bits() && rest_untouched;
    tally.judge(Aspect::RayAfter, call, right, 1.0, || {
        if !rest_untouched {
            return format!(
                "{function} changed the ray's o, d or min_t. {}",
                show_ray(before)
            );
        }
        let why = if hit_t.is_some() {
            "a hit at that t must shorten it"
        } else {
            "a miss must leave it alone"
        };
        format!(
            "{function} left ray.max_t = {}, right is {max_t}: {why}. {}",
            after.max_t,
            show_ray(before)
        )
    });
}

/// Equal bit for bit, so that NaN equals itself.
fn same(a: &Ray, b: &Ray) -> bool {
    let bits = |r: &Ray| [r.o, r.d, [r.min_t, r.max_t, 0.0]].map(|v| v.map(f64::to_bits));
    bits(a) == bits(b)
}

pub(super) fn show(v: Vec3) -> String {
    format!("({}, {}, {})", v.x, v.y, v.z)
}

/// A ray for people.
pub(crate) fn show_ray(ray: &Ray) -> String {
    let (o, d) = (show(Vec3::from(ray.o)), show(Vec3::from(ray.d)));
    format!("Ray: o = {o}, d = {d}, t in [{}, {}]", ray.min_t, ray.max_t)
}
