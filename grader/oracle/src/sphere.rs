//! The exact ray/sphere test.

use std::cmp::Ordering;

use kit::{Ray, Sphere};

use super::big_float::BigFloat;
use super::dyadic::{Dyadic, Dyadic3};
use super::sphere_error::SphereErrorBounds;
use super::triangle::invalid_ray;
use super::verdict::{Answers, Candidate, Certainty, Judgement, KernelClass, Miss, PerKernel};

/// How a ray meets a sphere, exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SphereClass {
    /// A hit at the smaller root, where the line enters the sphere.
    Near,
    /// A hit at the larger root; the smaller one is outside the range.
    Far,
    /// A hit at the double root: the line touches the sphere in one point. Counts as a hit.
    Tangent,
    /// No hit.
    Miss(Miss),
}

/// The oracle's result for one ray and one sphere.
///
/// ```
/// use kit::{Ray, Sphere, Vec3};
/// use oracle::{KernelClass, SphereClass, sphere};
/// let ball = Sphere {
///     center: Vec3::ZERO,
///     radius: 1.0,
/// };
/// let verdict = |x| sphere(&ball, &Ray::new(Vec3::new(x, 0.0, 3.0), Vec3::NEG_Z));
/// let through = verdict(0.0);
/// assert_eq!(through.class, SphereClass::Near);
/// assert_eq!(through.roots.map(|roots| roots.map(|t| t.to_f64())), Some([2.0, 4.0]));
/// assert!(!through.judge(KernelClass::Robust, Some(4.0)).scores());
/// assert_eq!(verdict(1.0).class, SphereClass::Tangent);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereVerdict {
    /// The exact answer.
    pub class: SphereClass,
    /// Whether the answer's `t` is exactly `min_t` or `max_t`. Both ends count.
    pub at_range_end: bool,
    /// The exact `t` of the hit; `None` for a miss.
    pub t: Option<BigFloat>,
    /// Both roots in increasing order, whether or not they are in the range.
    pub roots: Option<[BigFloat; 2]>,
    /// Largest error of each root that scores. Infinite if rounding can change any digit.
    pub t_tolerance: [PerKernel<f64>; 2],
    /// Largest error that scores of each coordinate of the hit point, by root.
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

    /// Whether the ray hits, by exact arithmetic and the course's conventions.
    pub fn hits(&self) -> bool {
        !matches!(self.class, SphereClass::Miss(_))
    }

    /// Whether correct code of this class may return different answers.
    pub fn undecidable(&self, kernel: KernelClass) -> bool {
        self.answers.get(kernel).undecidable()
    }

    /// Judges an answer: the `t` of a hit, or `None` for a miss.
    pub fn judge(&self, kernel: KernelClass, answer: Option<f64>) -> Judgement {
        self.answers.get(kernel).judge(answer)
    }
}

/// Decides exactly where `ray` hits `s`, and which answers in `f64` score.
///
/// The hit is the smallest root of the quadratic equation that is in the ray's closed range. Misses
/// by convention: NaN anywhere, `d = 0`, a negative radius.
pub fn sphere(s: &Sphere, ray: &Ray) -> SphereVerdict {
    if let Some(why) = conventional_miss(s, ray) {
        return SphereVerdict::miss(why);
    }
    let error_bounds = SphereErrorBounds::new(s, ray);
    if error_bounds.surely_misses(KernelClass::Textbook) {
        return SphereVerdict::miss(Miss::LineMisses);
    }
    ExactSphere::new(s, ray).verdict(ray, &error_bounds)
}

/// Returns the misses that need no arithmetic.
fn conventional_miss(s: &Sphere, ray: &Ray) -> Option<Miss> {
    let points = [s.center, ray.o, ray.d];
    if s.radius.is_nan() || points.iter().any(|v| v.is_nan()) {
        return Some(Miss::NotANumber);
    }
    if let Some(why) = invalid_ray(ray) {
        return Some(why);
    }
    if s.radius < 0.0 {
        return Some(Miss::Degenerate);
    }
    let finite = s.radius.is_finite() && points.iter().all(|v| v.is_finite());
    (!finite).then_some(Miss::NotFinite)
}

/// The exact numbers that a verdict is computed from; see `sphere_error`.
struct ExactSphere {
    a: Dyadic,
    b: Dyadic,
    c: Dyadic,
    /// The discriminant, `b² - a c`.
    d: Dyadic,
    /// Bits of the longest coordinate, radius included, with one common exponent.
    position_bits: usize,
    is_along_an_axis: bool,
}

impl ExactSphere {
    fn new(s: &Sphere, ray: &Ray) -> ExactSphere {
        let radius = kit::Vec3::splat(s.radius);
        let points = Dyadic3::aligned([ray.o, s.center, radius]);
        let [direction] = Dyadic3::aligned([ray.d]);
        let f = points[0].minus(&points[1]);
        let a = direction.dot(&direction);
        let b = f.dot(&direction);
        let c = &f.dot(&f) - &points[2].get(0).square();
        ExactSphere {
            d: &b.square() - &(&a * &c),
            a,
            b,
            c,
            position_bits: points.iter().map(Dyadic3::bits).max().unwrap_or(0),
            is_along_an_axis: direction.is_along_an_axis(),
        }
    }

    /// Compares a root with an end of the range. The root is `(-b ∓ √D) / a`, so the sign of
    /// `x ∓ √D` with `x = -b - a·end` decides. It is found by squaring, without computing the root.
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

    /// Returns both roots of `a t² + 2 b t + c`. The one that would cancel is computed from the
    /// other. If `D < 0` both are `-b/a`, the point of the line nearest to the centre.
    fn roots(&self) -> [BigFloat; 2] {
        if self.d.sign() <= 0 {
            return [BigFloat::ratio(&-&self.b, &self.a); 2];
        }
        let (root, _) = BigFloat::root_parts(&self.d);
        if self.b.sign() > 0 {
            let q = -&(&self.b + &root);
            [BigFloat::ratio(&q, &self.a), BigFloat::ratio(&self.c, &q)]
        } else {
            let q = &root - &self.b;
            [BigFloat::ratio(&self.c, &q), BigFloat::ratio(&q, &self.a)]
        }
    }

    fn verdict(&self, ray: &Ray, error_bounds: &SphereErrorBounds) -> SphereVerdict {
        let exists = PerKernel::each(|kernel| self.exists(kernel, error_bounds));
        let mut verdict = SphereVerdict::miss(Miss::LineMisses);
        if self.d.sign() < 0 && exists == PerKernel::each(|_| Certainty::No) {
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
            let errors = error_bounds.roots(kernel, b, d, near);
            let known = |e: f64| error_bounds.fits_f64 && !e.is_nan();
            errors.map(|e| if known(e) { e } else { f64::INFINITY })
        });
        verdict.t_tolerance = [0, 1].map(|i| PerKernel::each(|k| errors.get(k)[i]));
        verdict.p_tolerance = verdict
            .t_tolerance
            .map(|t| PerKernel::each(|k| error_bounds.position(*t.get(k))));
        verdict.answers = PerKernel::each(|kernel| {
            let in_range = |i: usize| {
                if self.roots_are_exact(error_bounds) {
                    return Certainty::exact(inside[i]);
                }
                Certainty::in_range(near[i], errors.get(kernel)[i], (ray.min_t, ray.max_t))
            };
            let candidates = [0, 1].map(|i| Candidate {
                t: roots[i],
                tolerance: errors.get(kernel)[i],
            });
            first_root(*exists.get(kernel), [in_range(0), in_range(1)], candidates)
        });
        verdict
    }

    /// Whether all correct code finds that the line meets the sphere.
    fn exists(&self, kernel: KernelClass, error_bounds: &SphereErrorBounds) -> Certainty {
        if !error_bounds.fits_f64 {
            return Certainty::Undecided;
        }
        let (d, bound) = (self.d.to_f64(), error_bounds.discriminant(kernel));
        if self.rounds_nothing() || d.abs() > bound {
            return Certainty::exact(self.d.sign() >= 0);
        }
        Certainty::Undecided
    }

    /// Whether every kernel computes the discriminant without rounding: the direction is a power of
    /// two along an axis, so that division by its length is exact, and products of two coordinates
    /// fit into 53 bits.
    fn rounds_nothing(&self) -> bool {
        self.is_along_an_axis && self.a.is_power_of_two() && 2 * (self.position_bits + 1) + 6 <= 53
    }

    /// Whether every kernel computes both roots without rounding, so that they can be compared
    /// exactly with an end of the range.
    fn roots_are_exact(&self, error_bounds: &SphereErrorBounds) -> bool {
        let square = || self.d.sign() >= 0 && BigFloat::root_parts(&self.d).1;
        error_bounds.fits_f64 && self.rounds_nothing() && square()
    }
}

/// Returns the answers that score, given the certainty about each root: the first root that is in
/// the range.
fn first_root(exists: Certainty, in_range: [Certainty; 2], candidates: [Candidate; 2]) -> Answers {
    let mut answers = Answers::MISS;
    if exists == Certainty::No {
        return answers;
    }
    for i in [0, 1] {
        if in_range[i] != Certainty::No {
            answers.hits[i] = Some(candidates[i]);
        }
        if in_range[i] == Certainty::Yes {
            answers.miss = exists == Certainty::Undecided;
            break;
        }
    }
    answers
}
