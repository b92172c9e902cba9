//! Judges hit records against the exact hit.

use crate::tools::errors::NumberError;
use crate::tools::findings::{Aspect, Class, Findings, Message, SAME};
use crate::tools::truth::expected::{Expected, ExpectedHit, HitOrMiss};
use kit::Vec3;
use wire::answer::Hit;
use wire::work::Ray;

/// How far the length of a normal may be from 1. Normalising rounds it by 1e-16; this bound also
/// accepts the vector from a sphere's centre to a rounded `o + t d`, divided by the radius.
const UNIT_BOUND: f64 = 1e-9;

/// A bound that is this large, relative to the number, also accepts the numbers of typical
/// mistakes: within it, an answer is not judged.
pub(crate) const WIDE: f64 = 1e-4;

/// Why a number within a bound of [`WIDE`] is not judged.
pub(crate) const TOO_WIDE: &str =
    "the rounding errors of right code are as large as those of a mistake";

/// Why hit and miss are not judged.
pub(crate) const ROUNDING_DECIDES: &str =
    "rounding decides between hit and miss, and both are right";

/// Why a primitive is not judged.
pub(crate) const SEVERAL_FIRST: &str =
    "several primitives are hit at this t, up to rounding errors";

/// Why a normal is not judged.
const ANY_NORMAL: &str =
    "any unit vector is right: the vertex normals cancel, or the sphere has no size";

/// A call of one of the student's functions, with the findings about it.
pub(crate) struct Call<'a> {
    pub(crate) findings: &'a mut Findings,
    /// Number of the call in its case, from 0.
    pub(crate) number: usize,
    /// The function that was called.
    pub(crate) function: &'static str,
    /// The ray that it got.
    pub(crate) ray: &'a Ray,
}

/// The aspects of a hit record and of the ray after the call.
pub(crate) const OF_A_RECORD: [Aspect; 8] = [
    Aspect::HitOrMiss,
    Aspect::RayAfter,
    Aspect::Primitive,
    Aspect::T,
    Aspect::Position,
    Aspect::Normal,
    Aspect::GeometricNormal,
    Aspect::Barycentrics,
];

/// Counts the aspects that the right answer has.
pub(crate) fn expect(findings: &mut Findings, expected: &Expected, with_uv: bool) {
    findings.expect(Aspect::HitOrMiss);
    findings.expect(Aspect::RayAfter);
    if expected.decision() != HitOrMiss::Hit {
        return;
    }
    let aspects = [
        Aspect::Primitive,
        Aspect::T,
        Aspect::Position,
        Aspect::Normal,
        Aspect::GeometricNormal,
    ];
    aspects
        .into_iter()
        .for_each(|aspect| findings.expect(aspect));
    if with_uv {
        findings.expect(Aspect::Barycentrics);
    }
}

impl Call<'_> {
    /// Judges one aspect. `message` describes the error; the ray is appended to it.
    fn judge<M: Into<Message>>(
        &mut self,
        aspect: Aspect,
        right: bool,
        badness: f64,
        message: impl FnOnce(&str) -> M,
    ) {
        self.judge_class(
            aspect,
            wrong_unless(right, || Class::Wrong),
            badness,
            message,
        );
    }

    /// Judges one aspect, with the class of a wrong answer; `None` if it is right.
    fn judge_class<M: Into<Message>>(
        &mut self,
        aspect: Aspect,
        class: Option<Class>,
        badness: f64,
        message: impl FnOnce(&str) -> M,
    ) {
        let (function, ray) = (self.function, self.ray);
        self.findings
            .judge_class(aspect, self.number, class, badness, || {
                message(function).into().asked(show_ray(ray))
            });
    }

    /// Records that `aspect` is not judged in this call.
    fn not_judged(&mut self, aspect: Aspect, why: &'static str) {
        self.findings.not_judged(aspect, self.number, why);
    }

    /// Records that `aspect` is not judged if numbers of this `size` may be off by too much.
    fn check_width(&mut self, aspect: Aspect, bound: f64, size: f64) {
        // NaN is too wide.
        let narrow = bound <= WIDE * size || size == 0.0 && bound.is_finite();
        if !narrow {
            self.not_judged(aspect, TOO_WIDE);
        }
    }

    /// Hit or miss.
    pub(crate) fn decision(&mut self, expected: &Expected, answered: Option<f64>) {
        let right = match expected.decision() {
            HitOrMiss::Either => true,
            HitOrMiss::Hit => answered.is_some(),
            HitOrMiss::Miss => answered.is_none(),
        };
        if expected.decision() == HitOrMiss::Either {
            self.not_judged(Aspect::HitOrMiss, ROUNDING_DECIDES);
        }
        let class = match answered {
            Some(t) if !right && t.is_nan() => Some(Class::Named("a hit at NaN")),
            _ => decision_class(right, answered.is_some()),
        };
        self.judge_class(Aspect::HitOrMiss, class, 1.0, |function| match answered {
            None => {
                let t = expected.hits.first().map_or(f64::NAN, |hit| hit.t);
                Message::new(format!(
                    "{function}: your result: miss; expected: hit at t = {t:?}"
                ))
            }
            Some(t) => Message::new(format!(
                "{function}: your result: hit at t = {t:?}; expected: miss"
            ))
            .because(format!(", because {}", expected.why_miss)),
        });
    }

    /// A hit beyond the range of the ray, and not only by the rounding of its `t`, is a false one.
    pub(crate) fn is_in_range(&mut self, expected: &Expected, t: f64) {
        let (min_t, max_t) = (self.ray.min_t, self.ray.max_t);
        let rounding = expected
            .hits
            .iter()
            .map(|hit| hit.t_bound)
            .fold(0.0, f64::max);
        let is_in_range = min_t - rounding <= t && t <= max_t + rounding;
        let class = wrong_unless(is_in_range, || Class::FalseHit);
        self.judge_class(Aspect::HitOrMiss, class, 1.0, |function| {
            Message::new(format!(
                "{function}: your result: hit at t = {t:?}; expected: a hit with t from min_t = {min_t:?} to max_t = {max_t:?}"
            ))
            .compares([t], [t.max(min_t).min(max_t)])
        });
    }

    /// Distance along the ray.
    pub(crate) fn t(&mut self, expected: &ExpectedHit, answered: f64) {
        let off = (answered - expected.t).abs();
        let (right, bound) = (expected.t, expected.t_bound);
        let error = NumberError {
            ulps: expected.exact_t.ulps(answered),
            of_bound: off / bound,
        };
        self.findings.measure(Aspect::T, error);
        self.check_width(Aspect::T, bound, right.abs());
        let class = wrong_unless(off <= bound, || Class::of_number(answered, right));
        self.judge_class(Aspect::T, class, off / bound, |function| {
            Message::new(format!(
                "{function}: your result: t = {answered:?}; expected: {right:?} (error {off:.1e}, allowed {})",
                allowed(bound)
            ))
            .compares([answered], [right])
        });
    }

    /// Barycentric weights of `p1` and `p2`.
    pub(crate) fn barycentrics(&mut self, expected: &ExpectedHit, [b1, b2]: [f64; 2]) {
        let Some((right, bound)) = expected.uv else {
            return;
        };
        self.check_width(Aspect::Barycentrics, bound, 1.0);
        let off = worst([b1 - right.x, b2 - right.y]);
        let swapped = worst([b1 - right.y, b2 - right.x]) <= bound;
        let class = wrong_unless(off <= bound, || match [b1, b2] {
            _ if swapped => Class::Swapped,
            [0.0, 0.0] => Class::Zero,
            _ => Class::of_size(off),
        });
        self.judge_class(Aspect::Barycentrics, class, off / bound, |function| {
            let hint = if swapped { " (b1 and b2 are swapped)" } else { "" };
            Message::new(format!(
                "{function}: your result: b1 = {b1:?}, b2 = {b2:?}; expected: b1 = {:?}, b2 = {:?}{hint}",
                right.x, right.y
            ))
            .compares([b1, b2], right.to_array())
        });
    }

    /// Which primitive.
    pub(crate) fn primitive(&mut self, expected: &Expected, prim: u32) {
        let right = expected.hits.iter().any(|hit| hit.prim == prim);
        if expected
            .hits
            .iter()
            .any(|hit| hit.prim != expected.hits[0].prim)
        {
            self.not_judged(Aspect::Primitive, SEVERAL_FIRST);
        }
        self.judge(Aspect::Primitive, right, 1.0, |function| {
            let right = expected.hits.first().map_or(0, |hit| hit.prim);
            format!("{function}: your result: primitive {prim}; expected: primitive {right}")
        });
    }

    /// The surface parameters of a sphere, which are (0, 0).
    pub(crate) fn no_parameters(&mut self, uv: [f64; 2]) {
        let right = uv == [0.0; 2];
        self.judge(Aspect::Parameters, right, 1.0, |function| {
            format!("{function}: your result: uv = {uv:?}; expected: (0, 0), as for every sphere")
        });
    }

    /// Hit point and normals.
    pub(crate) fn geometry(&mut self, expected: &ExpectedHit, hit: &Hit) {
        self.position(expected, hit.p.into());
        let (n, ng) = (Vec3::from(hit.n), Vec3::from(hit.ng));
        self.normal(Aspect::Normal, "n", expected.n, expected.n_bound, n);
        self.normal(
            Aspect::GeometricNormal,
            "ng",
            expected.ng,
            expected.ng_bound,
            ng,
        );
    }

    fn position(&mut self, expected: &ExpectedHit, p: Vec3) {
        let (right, bound) = (expected.p, expected.p_bound);
        let far = (right - Vec3::from(self.ray.o)).length();
        self.check_width(Aspect::Position, bound, far);
        let off = worst((p - right).to_array());
        let class = wrong_unless(off <= bound, || self.position_class(expected, p));
        self.judge_class(Aspect::Position, class, off / bound, |function| {
            Message::new(format!(
                "{function}: your result: p = {}; expected: {} (error {off:.1e}, allowed {})",
                show(p),
                show(right),
                allowed(bound)
            ))
            .compares(p.to_array(), right.to_array())
        });
        if let Some((surface, bound)) = expected.surface {
            let off = surface.distance(p);
            self.judge(Aspect::Position, off <= bound, off / bound, |function| {
                format!(
                    "{function}: your result: p = {}; expected: a point on the surface (distance {off:.1e}, allowed {})",
                    show(p),
                    allowed(bound)
                )
            });
        }
    }

    /// The class of a wrong hit point: its t if it lies on the ray, else its distance from the
    /// right point.
    fn position_class(&self, expected: &ExpectedHit, p: Vec3) -> Class {
        let (o, d) = (Vec3::from(self.ray.o), Vec3::from(self.ray.d));
        let t = (p - o).dot(d) / d.length_squared();
        let beside = (o + t * d - p).length();
        if beside <= SAME * (expected.p - o).length() {
            // At the origin, t is a rounding error and not 0.
            let t = if t.abs() <= SAME * expected.t { 0.0 } else { t };
            Class::of_number(t, expected.t)
        } else {
            Class::of_size((p - expected.p).length())
        }
    }

    fn normal(&mut self, aspect: Aspect, name: &str, right: Option<Vec3>, bound: f64, given: Vec3) {
        let length = given.length();
        let length_off = worst([length - 1.0]);
        let is_unit = length_off <= UNIT_BOUND;
        let off = right.map_or(0.0, |n| worst((given - n).to_array()));
        match right {
            None => self.not_judged(aspect, ANY_NORMAL),
            Some(_) => self.check_width(aspect, bound, 1.0),
        }
        let class = wrong_unless(is_unit && off <= bound, || {
            right.map_or(Class::Wrong, |right| {
                Class::of_certain_direction(given, right)
            })
        });
        self.judge_class(aspect, class, off.max(length_off), |function| {
            // A component of -0 is 0.
            let show = |n: Vec3| show(n + Vec3::ZERO);
            let result = format!("{function}: your result: {name} = {}", show(given));
            let compared = |words: &str, n: Vec3| {
                Message::new(format!("{result}; expected: {words}{}", show(n)))
                    .compares(given.to_array(), n.to_array())
            };
            match right {
                _ if !is_unit => {
                    Message::new(format!("{result} of length {length}; expected: length 1"))
                        .compares([length], [1.0])
                }
                Some(n) if worst((given + n).to_array()) <= bound => compared("the opposite, ", n),
                Some(n) => compared("", n),
                None => Message::new(result),
            }
        });
    }

    /// The ray after the call: a hit sets `max_t`, a miss changes nothing. For `is_right` see
    /// [`Call::max_t_after`].
    pub(crate) fn ray_after(
        &mut self,
        hit_t: Option<f64>,
        after: &Ray,
        is_right: impl FnOnce(f64) -> bool,
    ) {
        let before = *self.ray;
        let rest = Ray {
            max_t: before.max_t,
            ..*after
        };
        let rest_untouched = bits(&rest) == bits(&before);
        let class = wrong_unless(rest_untouched, || Class::Named("o, d or min_t"));
        self.judge_class(Aspect::RayAfter, class, 2.0, |function| {
            format!("{function} changed the ray's o, d or min_t; expected: they stay as they are")
        });
        self.max_t_after(hit_t, after.max_t, is_right);
    }

    /// `max_t` after the call: that of the hit or miss that the function returned. If this was
    /// wrong, the right `max_t` is right, too: `is_right` returns whether `max_t` is right although
    /// the function returned another hit or miss.
    pub(crate) fn max_t_after(
        &mut self,
        hit_t: Option<f64>,
        after: f64,
        is_right: impl FnOnce(f64) -> bool,
    ) {
        let returned = hit_t.unwrap_or(self.ray.max_t);
        let agrees = after.to_bits() == returned.to_bits();
        let class = wrong_unless(agrees || is_right(after), || {
            if after.to_bits() == self.ray.max_t.to_bits() {
                Class::Named("max_t as before")
            } else if hit_t.is_none() {
                Class::Named("max_t changed by a miss")
            } else if after < returned {
                Class::Named("max_t too near")
            } else if after > returned {
                Class::Named("max_t too far")
            } else {
                Class::Wrong
            }
        });
        self.judge_class(Aspect::RayAfter, class, 1.0, |function| {
            let why = if hit_t.is_some() {
                "a hit sets max_t to the t that it returns"
            } else {
                "a miss does not change max_t"
            };
            Message::new(format!(
                "{function}: your result: ray.max_t = {after:?}; expected: {returned:?}"
            ))
            .because(format!(", since {why}"))
            .compares([after], [returned])
        });
    }

    /// The two functions must agree on hit or miss, also where either scores.
    pub(crate) fn agrees_with(&mut self, test: &str, test_hits: bool, hits: bool) {
        let name = |hit: bool| if hit { "hit" } else { "miss" };
        self.judge(Aspect::HitOrMiss, test_hits == hits, 0.5, |function| {
            format!(
                "your results: {test} returns a {}, {function} a {}; expected: the same from both",
                name(test_hits),
                name(hits)
            )
        });
    }
}

/// Judges a hit record, except for its barycentric weights.
pub(crate) fn record(call: &mut Call<'_>, expected: &Expected, hit: Option<&Hit>) {
    call.decision(expected, hit.map(|hit| hit.t));
    if let Some(hit) = hit
        && let Some(right) = expected.closest_to(hit.prim, hit.t)
    {
        call.primitive(expected, hit.prim);
        call.t(right, hit.t);
        call.geometry(right, hit);
    }
}

/// The class of the answer "hit" or "miss", if it is wrong.
pub(crate) fn decision_class(right: bool, hit: bool) -> Option<Class> {
    wrong_unless(right, || {
        if hit {
            Class::FalseHit
        } else {
            Class::FalseMiss
        }
    })
}

fn wrong_unless(right: bool, class: impl FnOnce() -> Class) -> Option<Class> {
    if right { None } else { Some(class()) }
}

/// The largest absolute value; NaN if one of them is NaN, which is within no bound.
fn worst<const N: usize>(values: [f64; N]) -> f64 {
    if values.iter().any(|value| value.is_nan()) {
        return f64::NAN;
    }
    values
        .iter()
        .fold(0.0, |worst, value| worst.max(value.abs()))
}

/// The bits of the ray's numbers: NaN equals itself.
fn bits(r: &Ray) -> [[u64; 3]; 3] {
    [r.o, r.d, [r.min_t, r.max_t, 0.0]].map(|v| v.map(f64::to_bits))
}

/// The text of an allowed error.
fn allowed(bound: f64) -> String {
    match bound {
        0.0 => "none".to_string(),
        _ => format!("{bound:.1e}"),
    }
}

pub(crate) fn show(v: Vec3) -> String {
    // Debug form: a number that is very small or large is written with an exponent.
    format!("({:?}, {:?}, {:?})", v.x, v.y, v.z)
}

/// The text of a ray in messages.
pub(crate) fn show_ray(ray: &Ray) -> String {
    let (o, d) = (show(Vec3::from(ray.o)), show(Vec3::from(ray.d)));
    let (min_t, max_t) = (ray.min_t, ray.max_t);
    format!("Ray: o = {o}, d = {d}, t in [{min_t:?}, {max_t:?}]")
}
