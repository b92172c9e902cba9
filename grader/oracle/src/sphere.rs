//! Rays and spheres.

use std::cmp::Ordering;

use kit::{Ray, Sphere};

use super::dyadic::{Dyadic, Dyadic3};
use super::real::Real;
use super::sphere_error::Frame;
use super::triangle::range_misses;
use super::verdict::{Answers, Candidate, Judgement, Kernel, Miss, PerKernel, Sure};

/// How a ray meets a sphere, exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SphereClass {
    /// At the smaller root: going in, unless the range cuts.
    Near,
    /// At the larger root: the smaller one is before `min_t`.
    Far,
    /// At the only root: the line touches the sphere in one point. Counts as a hit.
    Tangent,
    /// Not at all.
    Miss(Miss),
}

/// All there is to say about one ray and one sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereVerdict {
    /// The exact answer.
    pub class: SphereClass,
    /// Whether the answer's `t` is exactly `min_t` or `max_t`. Both ends count.
    pub at_range_end: bool,
    /// The true answer.
    pub t: Option<Real>,
    /// Both roots, in order, whether or not the range holds them.
    pub roots: Option<[Real; 2]>,
    /// How far off each root may be. Infinite where rounding decides everything.
    pub t_tolerance: [PerKernel<f64>; 2],
    /// How far off each coordinate of the hit point may be, by root.
    pub p_tolerance: [PerKernel<f64>; 2],
    /// The answers that score.
    pub answers: PerKernel<Answers>,
}

impl SphereVerdict {
    fn miss(why: Miss) -> SphereVerdict {
        SphereVerdict {
            class: SphereClass::Miss(why),
            at_range_end: false,
            t: None,
            roots: None,
            t_tolerance: [PerKernel::default(); 2],
            p_tolerance: [PerKernel::default(); 2],
            answers: PerKernel::each(|_| match why {
                Miss::NotFinite => Answers::ANY,
                _ => Answers::MISS,
            }),
        }
    }

    /// Whether the ray truly hits; the course's conventions count.
    pub fn hits(&self) -> bool {
        !matches!(self.class, SphereClass::Miss(_))
    }

    /// Whether the exact answer hangs on a convention: a tangent or an end of the range.
    pub fn on_boundary(&self) -> bool {
        self.at_range_end || self.class == SphereClass::Tangent
    }

    /// Whether correct code of this kind may answer either way.
    pub fn undecidable(&self, kernel: Kernel) -> bool {
        self.answers.get(kernel).undecidable()
    }

    /// Judges the `t` of an answer.
    pub fn judge(&self, kernel: Kernel, answer: Option<f64>) -> Judgement {
        self.answers.get(kernel).judge(answer)
    }
}

/// Decides where `ray` hits `s`, exactly, and which answers in `f64` score.
///
/// The answer is the smaller root of the quadratic that lies in the ray's closed range. A miss
/// by convention: NaN anywhere, `d = 0`, a negative radius.
pub fn sphere(s: &Sphere, ray: &Ray) -> SphereVerdict {
    if let Some(why) = by_convention(s, ray) {
        return SphereVerdict::miss(why);
    }
    let frame = Frame::new(s, ray);
    if frame.surely_misses() {
        return SphereVerdict::miss(Miss::Beside);
    }
    Exact::new(s, ray).verdict(ray, &frame)
}

/// The misses that need no arithmetic.
fn by_convention(s: &Sphere, ray: &Ray) -> Option<Miss> {
    let places = [s.center, ray.o, ray.d];
    if s.radius.is_nan() || places.iter().any(|v| v.is_nan()) {
        return Some(Miss::NotANumber);
    }
    if let Some(why) = range_misses(ray) {
        return Some(why);
    }
    if s.radius < 0.0 {
        return Some(Miss::Degenerate);
    }
    let finite = s.radius.is_finite() && places.iter().all(|v| v.is_finite());
    (!finite).then_some(Miss::NotFinite)
}

/// The exact numbers behind a verdict; see `sphere_error`.
struct Exact {
    a: Dyadic,
    b: Dyadic,
    c: Dyadic,
    /// The discriminant, `b² - a c`.
    d: Dyadic,
    /// Bits of the longest coordinate (the radius too), on the exponent common to all.
    place_bits: usize,
    goes_along_an_axis: bool,
}

impl Exact {
    fn new(s: &Sphere, ray: &Ray) -> Exact {
        let radius = kit::Vec3::splat(s.radius);
        let places = Dyadic3::aligned([ray.o, s.center, radius]);
        let [direction] = Dyadic3::aligned([ray.d]);
        let f = places[0].minus(&places[1]);
        let a = direction.dot(&direction);
        let b = f.dot(&direction);
        let c = &f.dot(&f) - &places[2].get(0).square();
        Exact {
            d: &b.square() - &(&a * &c),
            a,
            b,
            c,
            place_bits: places.iter().map(Dyadic3::bits).max().unwrap_or(0),
            goes_along_an_axis: direction.is_along_an_axis(),
        }
    }

    /// How a root compares with a range end. The root is `(-b ∓ √D) / a`, so the sign of
    /// `x ∓ √D` decides, `x = -b - a·end`: by squaring, without the root.
    fn compare_root(&self, root: usize, end: f64) -> Ordering {
        if end.is_infinite() {
            return 0.0.partial_cmp(&end).unwrap_or(Ordering::Equal);
        }
        let x = -&(&self.b + &(&self.a * &Dyadic::new(end)));
        match (root, x.sign() < 0) {
            (0, true) => Ordering::Less,
            (0, false) => x.square().compare(&self.d),
            (_, true) => self.d.compare(&x.square()),
            (_, false) if x.sign() == 0 && self.d.sign() == 0 => Ordering::Equal,
            (_, false) => Ordering::Greater,
        }
    }

    /// Both roots of `a t² + 2 b t + c`, the one that cancels by way of the other.
    /// Where `D < 0` both are `-b/a`, the point of the line nearest to the centre.
    fn roots(&self) -> [Real; 2] {
        if self.d.sign() <= 0 {
            return [Real::ratio(&-&self.b, &self.a); 2];
        }
        let (root, _) = Real::root_parts(&self.d);
        if self.b.sign() > 0 {
            let q = -&(&self.b + &root);
            [Real::ratio(&q, &self.a), Real::ratio(&self.c, &q)]
        } else {
            let q = &root - &self.b;
            [Real::ratio(&self.c, &q), Real::ratio(&q, &self.a)]
        }
    }

    fn verdict(&self, ray: &Ray, frame: &Frame) -> SphereVerdict {
        let exists = PerKernel::each(|kernel| self.exists(kernel, frame));
        let mut verdict = SphereVerdict::miss(Miss::Beside);
        if self.d.sign() < 0 && exists == PerKernel::each(|_| Sure::No) {
            return verdict;
        }
        let ends = [0, 1].map(|i| [ray.min_t, ray.max_t].map(|end| self.compare_root(i, end)));
        let inside = ends.map(|[min, max]| min != Ordering::Less && max != Ordering::Greater);
        let roots = self.roots();
        if self.d.sign() >= 0 {
            let root = inside.iter().position(|inside| *inside);
            verdict.class = match root {
                None => SphereClass::Miss(Miss::OutOfRange),
                Some(_) if self.d.sign() == 0 => SphereClass::Tangent,
                Some(0) => SphereClass::Near,
                Some(_) => SphereClass::Far,
            };
            verdict.at_range_end = root.is_some_and(|i| ends[i].iter().any(|end| end.is_eq()));
            verdict.t = root.map(|i| roots[i]);
            verdict.roots = Some(roots);
        }
        let near = roots.map(|t| t.to_f64());
        let (b, d) = (self.b.to_f64(), self.d.to_f64());
        let errors = PerKernel::each(|kernel| {
            let errors = frame.roots(kernel, b, d, near);
            let known = |e: f64| frame.in_reach && !e.is_nan();
            errors.map(|e| if known(e) { e } else { f64::INFINITY })
        });
        verdict.t_tolerance = [0, 1].map(|i| PerKernel::each(|k| errors.get(k)[i]));
        verdict.p_tolerance = verdict
            .t_tolerance
            .map(|t| PerKernel::each(|k| frame.position(*t.get(k))));
        verdict.answers = PerKernel::each(|kernel| {
            let in_range = |i: usize| {
                if self.roots_are_exact(frame) {
                    return Sure::exactly(inside[i]);
                }
                Sure::in_range(near[i], errors.get(kernel)[i], (ray.min_t, ray.max_t))
            };
            let candidates = [0, 1].map(|i| Candidate {
                t: roots[i],
                tolerance: errors.get(kernel)[i],
            });
            first_root(*exists.get(kernel), [in_range(0), in_range(1)], candidates)
        });
        verdict
    }

    /// Whether correct code is sure that the line meets the sphere.
    fn exists(&self, kernel: Kernel, frame: &Frame) -> Sure {
        if !frame.in_reach {
            return Sure::Open;
        }
        let (d, bound) = (self.d.to_f64(), frame.discriminant(kernel));
        if self.rounds_nothing() || d.abs() > bound {
            return Sure::exactly(self.d.sign() >= 0);
        }
        Sure::Open
    }

    /// Whether every kernel finds the discriminant without a rounding: the direction is a power of two along an
    /// axis, so that dividing by its length only shifts, and two short lengths are multiplied.
    fn rounds_nothing(&self) -> bool {
        self.goes_along_an_axis && self.a.is_power_of_two() && 2 * (self.place_bits + 1) + 6 <= 53
    }

    /// Whether every kernel finds both roots without a rounding, so that an end of the range may decide.
    fn roots_are_exact(&self, frame: &Frame) -> bool {
        let square = || self.d.sign() >= 0 && Real::root_parts(&self.d).1;
        frame.in_reach && self.rounds_nothing() && square()
    }
}

/// The answers that score, given what is sure about each root: the first root that is in the range.
fn first_root(exists: Sure, in_range: [Sure; 2], candidates: [Candidate; 2]) -> Answers {
    let mut answers = Answers::MISS;
    if exists == Sure::No {
        return answers;
    }
    for i in [0, 1] {
        if in_range[i] != Sure::No {
            answers.hits[i] = Some(candidates[i]);
        }
        if in_range[i] == Sure::Yes {
            answers.miss = exists == Sure::Open;
            break;
        }
    }
    answers
}
