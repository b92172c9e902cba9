//! The exact ray/triangle test.

use std::cmp::Ordering;

use kit::{Ray, Triangle, Vec3};

use super::big_float::BigFloat;
use super::dyadic::{Dyadic, Dyadic3};
use super::triangle_error::{RobustBounds, TriangleErrorBounds};
use super::verdict::{Answers, Candidate, Certainty, Judgement, KernelClass, Miss, PerKernel};

/// How a ray meets a triangle, exactly.
///
/// ```
/// use kit::{Ray, Triangle, Vec3};
/// use oracle::{Miss, TriangleClass, triangle};
/// let tri = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
/// let class = |x, y| triangle(&tri, &Ray::new(Vec3::new(x, y, 2.0), Vec3::NEG_Z)).class;
/// assert_eq!(class(0.5, 0.5), TriangleClass::Edge(0));
/// assert_eq!(class(1.0, 0.0), TriangleClass::Vertex(1));
/// assert_eq!(class(1.0, 1.0), TriangleClass::Miss(Miss::LineMisses));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TriangleClass {
    /// Through the interior.
    Inside,
    /// Through the interior of the edge that is opposite to this vertex (0, 1 or 2). Counts as a
    /// hit.
    Edge(u8),
    /// Through this vertex. Counts as a hit.
    Vertex(u8),
    /// No hit.
    Miss(Miss),
}

/// The intersection of the line of a ray with the plane of a triangle.
///
/// ```
/// use kit::{Ray, Triangle, Vec3};
/// let tri = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
/// let ray = Ray::new(Vec3::new(0.25, 0.5, 2.0), Vec3::NEG_Z);
/// let crossing = oracle::triangle(&tri, &ray).crossing.expect("the ray hits");
/// assert_eq!(crossing.t.to_f64(), 2.0);
/// assert_eq!((crossing.b1.to_f64(), crossing.b2.to_f64()), (0.25, 0.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Distance along the ray, in lengths of its direction.
    pub t: BigFloat,
    /// Barycentric weight of `p1`.
    pub b1: BigFloat,
    /// Barycentric weight of `p2`.
    pub b2: BigFloat,
    /// Largest error of `t` that scores. Infinite if rounding can change any digit.
    pub t_tolerance: PerKernel<f64>,
    /// Largest error of a barycentric weight that scores.
    pub b_tolerance: PerKernel<f64>,
    /// Largest error that scores of each coordinate of the hit point.
    pub p_tolerance: PerKernel<f64>,
}

/// The oracle's result for one ray and one triangle.
///
/// ```
/// use kit::{Ray, Triangle, Vec3};
/// use oracle::{Judgement, KernelClass, TriangleClass, triangle};
/// let tri = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
/// let ray = Ray::new(Vec3::new(0.25, 0.25, 2.0), Vec3::NEG_Z);
/// let verdict = triangle(&tri, &ray);
/// assert_eq!(verdict.class, TriangleClass::Inside);
/// assert!(verdict.judge(KernelClass::Textbook, Some(2.0)).scores());
/// assert_eq!(verdict.judge(KernelClass::Textbook, None), Judgement::FalseMiss);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleVerdict {
    /// The exact answer.
    pub class: TriangleClass,
    /// Whether `t` is exactly `min_t` or `max_t`. Both ends count.
    pub at_range_end: bool,
    /// The intersection of the ray's line with the plane. Present for every hit; for a miss only if
    /// the ray is undecidable.
    pub crossing: Option<Crossing>,
    /// The answers that score.
    pub answers: PerKernel<Answers>,
}

impl TriangleVerdict {
    fn miss(why: Miss) -> TriangleVerdict {
        TriangleVerdict {
            class: TriangleClass::Miss(why),
            at_range_end: false,
            crossing: None,
            answers: PerKernel::each(|kernel| match (why, kernel) {
                (Miss::NotFinite, KernelClass::Textbook) => Answers::ANY,
                _ => Answers::MISS,
            }),
        }
    }

    /// Whether the ray hits, by exact arithmetic and the course's conventions.
    pub fn hits(&self) -> bool {
        !matches!(self.class, TriangleClass::Miss(_))
    }

    /// Whether correct code of this class may return a hit or a miss.
    pub fn undecidable(&self, kernel: KernelClass) -> bool {
        self.answers.get(kernel).undecidable()
    }

    /// Judges an answer: the `t` of a hit, or `None` for a miss.
    pub fn judge(&self, kernel: KernelClass, answer: Option<f64>) -> Judgement {
        self.answers.get(kernel).judge(answer)
    }
}

/// Decides exactly whether `ray` hits `tri`, and which answers in `f64` score.
///
/// Edges, vertices and both ends of the ray's range count; both faces are hit. Misses by
/// convention: NaN anywhere, `d = 0`, no area, a ray in the plane of the triangle. Only positions
/// are used, not normals.
pub fn triangle(tri: &Triangle, ray: &Ray) -> TriangleVerdict {
    if let Some(why) = conventional_miss(tri, ray) {
        return TriangleVerdict::miss(why);
    }
    let error_bounds = TriangleErrorBounds::new(tri, ray);
    if error_bounds.surely_misses(KernelClass::Textbook) {
        return TriangleVerdict::miss(Miss::LineMisses);
    }
    let exact = ExactTriangle::new(tri, ray);
    exact.verdict(ray, &error_bounds)
}

/// Where the line of a ray crosses the plane of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneCrossing {
    /// Whether the ray meets the side from which the vertices run counter-clockwise.
    pub on_the_front: bool,
    /// For each vertex, whether the crossing is beyond the edge that is opposite to it.
    pub beyond: [bool; 3],
    /// Distance along the ray, in lengths of its direction.
    pub t: BigFloat,
}

/// Where the line of `ray` crosses the plane of `tri`, whatever the range is. `None` if it is
/// parallel to the plane, or if a number is not finite.
///
/// ```
/// use kit::{Ray, Triangle, Vec3};
/// let tri = Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y);
/// let ray = Ray::new(Vec3::new(2.0, -1.0, 3.0), Vec3::NEG_Z);
/// let crossing = oracle::plane_crossing(&tri, &ray).expect("it is not parallel");
/// // Below the edge from p0 to p1, which is opposite to p2.
/// assert_eq!((crossing.on_the_front, crossing.beyond), (true, [false, false, true]));
/// assert_eq!(crossing.t.to_f64(), 3.0);
/// ```
pub fn plane_crossing(tri: &Triangle, ray: &Ray) -> Option<PlaneCrossing> {
    if conventional_miss(tri, ray).is_some() {
        return None;
    }
    let exact = ExactTriangle::new(tri, ray);
    let facing = exact.det.sign();
    (facing != 0).then(|| PlaneCrossing {
        on_the_front: facing < 0,
        beyond: [0, 1, 2].map(|i| exact.e[i].sign() * facing < 0),
        t: BigFloat::ratio(&exact.num, &exact.det),
    })
}

/// Returns the misses that need no arithmetic.
fn conventional_miss(tri: &Triangle, ray: &Ray) -> Option<Miss> {
    let points = [tri.p0, tri.p1, tri.p2, ray.o, ray.d];
    if points.iter().any(|v| v.is_nan()) {
        return Some(Miss::NotANumber);
    }
    if let Some(why) = invalid_ray(ray) {
        return Some(why);
    }
    points
        .iter()
        .any(|v| !v.is_finite())
        .then_some(Miss::NotFinite)
}

/// Returns the misses that depend only on the ray.
pub(super) fn invalid_ray(ray: &Ray) -> Option<Miss> {
    if ray.min_t.is_nan() || ray.max_t.is_nan() {
        Some(Miss::NotANumber)
    } else if ray.d == Vec3::ZERO {
        Some(Miss::ZeroDirection)
    } else if ray.min_t > ray.max_t {
        Some(Miss::EmptyRange)
    } else {
        None
    }
}

/// The exact numbers that a verdict is computed from.
struct ExactTriangle {
    /// Edge functions, their sum, and the numerator of `t`; see `triangle_error`.
    e: [Dyadic; 3],
    det: Dyadic,
    num: Dyadic,
    normal: Dyadic3,
    /// The same numbers, rounded, to compare with error bounds.
    rounded: Rounded,
    /// Bits of the longest coordinate and of the longest component of the direction, each with its
    /// own common exponent.
    position_bits: usize,
    direction_bits: usize,
    /// Whether division by the largest component of the direction does not round.
    shear_is_exact: bool,
}

/// Some of [`ExactTriangle`]'s numbers in `f64`.
struct Rounded {
    e: [f64; 3],
    det: f64,
    normal: Vec3,
}

impl ExactTriangle {
    fn new(tri: &Triangle, ray: &Ray) -> ExactTriangle {
        let points = Dyadic3::aligned([tri.p0, tri.p1, tri.p2, ray.o]);
        let [d] = Dyadic3::aligned([ray.d]);
        let [a, b, c] = [0, 1, 2].map(|i| points[i].minus(&points[3]));
        let normal = b.minus(&a).cross(&c.minus(&a));
        let det = d.dot(&normal);
        let e1 = d.dot(&c.cross(&a));
        let e2 = d.dot(&a.cross(&b));
        let e = [&(&det - &e1) - &e2, e1, e2];
        ExactTriangle {
            rounded: Rounded {
                e: [0, 1, 2].map(|i| e[i].to_f64()),
                det: det.to_f64(),
                normal: normal.to_f64(),
            },
            e,
            num: a.dot(&normal),
            det,
            normal,
            position_bits: points.iter().map(Dyadic3::bits).max().unwrap_or(0),
            direction_bits: d.bits(),
            shear_is_exact: d.get(ray.d.abs().max_position()).is_power_of_two(),
        }
    }

    /// Classifies the line of the ray; the range is not considered.
    fn class(&self) -> TriangleClass {
        if self.normal.is_zero() {
            return TriangleClass::Miss(Miss::Degenerate);
        }
        let facing = self.det.sign();
        if facing == 0 && self.num.sign() == 0 {
            return TriangleClass::Miss(Miss::Coplanar);
        } else if facing == 0 {
            return TriangleClass::Miss(Miss::LineMisses);
        }
        match [0, 1, 2].map(|i| self.e[i].sign() * facing) {
            [1, 1, 1] => TriangleClass::Inside,
            [0, 1, 1] => TriangleClass::Edge(0),
            [1, 0, 1] => TriangleClass::Edge(1),
            [1, 1, 0] => TriangleClass::Edge(2),
            [1, 0, 0] => TriangleClass::Vertex(0),
            [0, 1, 0] => TriangleClass::Vertex(1),
            [0, 0, 1] => TriangleClass::Vertex(2),
            _ => TriangleClass::Miss(Miss::LineMisses),
        }
    }

    /// Compares `t` with an end of the range; `det` must not be 0.
    fn compare_t(&self, end: f64) -> Ordering {
        if end.is_infinite() {
            return 0.0.partial_cmp(&end).unwrap_or(Ordering::Equal);
        }
        let order = self.num.compare(&(&Dyadic::new(end) * &self.det));
        if self.det.sign() < 0 {
            order.reverse()
        } else {
            order
        }
    }

    fn verdict(&self, ray: &Ray, error_bounds: &TriangleErrorBounds) -> TriangleVerdict {
        let mut class = self.class();
        let mut verdict = TriangleVerdict::miss(Miss::LineMisses);
        let mut range = Certainty::No;
        if self.det.sign() != 0 {
            let ends = (self.compare_t(ray.min_t), self.compare_t(ray.max_t));
            let inside = ends.0 != Ordering::Less && ends.1 != Ordering::Greater;
            let beside = matches!(class, TriangleClass::Miss(_));
            if !beside && !inside {
                class = TriangleClass::Miss(Miss::OutOfRange);
            }
            verdict.at_range_end = !beside && inside && (ends.0.is_eq() || ends.1.is_eq());
            range = Certainty::exact(inside);
        }
        verdict.class = class;
        let robust = error_bounds.robust();
        let edges = PerKernel::each(|kernel| self.edges(kernel, error_bounds, &robust));
        if edges == PerKernel::each(|_| Certainty::No) {
            return verdict;
        }
        if self.det.sign() == 0 {
            verdict.answers = PerKernel::each(|kernel| match edges.get(kernel) {
                Certainty::Undecided => Answers::ANY,
                _ => Answers::MISS,
            });
            return verdict;
        }
        let mut crossing = self.crossing(error_bounds, &robust);
        let sure = PerKernel::each(|kernel| {
            let in_range = if self.divides_exactly(kernel, error_bounds) {
                range
            } else {
                let t = crossing.t.to_f64();
                let error = *crossing.t_tolerance.get(kernel);
                Certainty::in_range(t, error, (ray.min_t, ray.max_t))
            };
            edges.get(kernel).and(in_range)
        });
        if sure.robust == Certainty::Yes {
            crossing.t_tolerance.robust = crossing.t_tolerance.robust.min(robust.t_cap());
        }
        verdict.answers = PerKernel::each(|kernel| {
            let hit = Some(Candidate {
                t: crossing.t,
                tolerance: *crossing.t_tolerance.get(kernel),
            });
            match sure.get(kernel) {
                Certainty::No => Answers::MISS,
                sure => Answers {
                    hits: [hit, None],
                    miss: *sure == Certainty::Undecided,
                },
            }
        });
        verdict.crossing = Some(crossing);
        verdict
    }

    /// Whether all correct code finds that the line passes through the triangle.
    fn edges(
        &self,
        kernel: KernelClass,
        error_bounds: &TriangleErrorBounds,
        robust: &RobustBounds,
    ) -> Certainty {
        if !error_bounds.fits_f64 {
            return Certainty::Undecided;
        }
        if self.rounds_nothing(kernel) {
            return Certainty::exact(!matches!(self.class(), TriangleClass::Miss(_)));
        }
        let bounds = match kernel {
            KernelClass::Textbook => [error_bounds.textbook_edge(self.rounded.normal); 3],
            KernelClass::Robust => robust.edges,
        };
        let e = self.rounded.e;
        let is_positive = [0, 1, 2].map(|i| e[i] > bounds[i]);
        let is_negative = [0, 1, 2].map(|i| e[i] < -bounds[i]);
        if is_positive.contains(&true) && is_negative.contains(&true) {
            Certainty::No
        } else if is_positive == [true; 3] || is_negative == [true; 3] {
            Certainty::Yes
        } else {
            Certainty::Undecided
        }
    }

    /// Whether a kernel decides the edges without any rounding, because its numbers have few bits.
    ///
    /// The bits are counted with common exponents. A robust kernel multiplies two lengths and the
    /// direction twice (shear), and a third length for `t`. A textbook kernel may multiply four
    /// lengths (plane and inside test), compares quotients by `det`, and normalises the normal,
    /// which is exact along an axis.
    fn rounds_nothing(&self, kernel: KernelClass) -> bool {
        // Relative to the ray's origin, a coordinate may be one bit longer.
        let (place, direction) = (self.position_bits + 1, self.direction_bits);
        let robust = self.shear_is_exact && 3 * place + 2 * direction + 3 <= 53;
        match kernel {
            KernelClass::Robust => robust,
            KernelClass::Textbook => {
                robust
                    && self.normal.is_along_an_axis()
                    && (self.det.sign() == 0 || self.det.is_power_of_two())
                    && 4 * place + 2 * direction + 4 <= 53
            }
        }
    }

    /// Whether a kernel computes `t` without rounding, so that `t` can be compared exactly with an
    /// end of the range.
    fn divides_exactly(&self, kernel: KernelClass, error_bounds: &TriangleErrorBounds) -> bool {
        error_bounds.fits_f64 && self.rounds_nothing(kernel) && self.det.is_power_of_two()
    }

    fn crossing(&self, error_bounds: &TriangleErrorBounds, robust: &RobustBounds) -> Crossing {
        let t = BigFloat::ratio(&self.num, &self.det);
        let Rounded { e, det, normal } = self.rounded;
        let near = t.to_f64();
        let bound = |value: f64| {
            if error_bounds.fits_f64 && !value.is_nan() {
                value
            } else {
                f64::INFINITY
            }
        };
        let t_tolerance = PerKernel {
            textbook: bound(error_bounds.textbook_t(det, near)),
            robust: bound(robust.t(e, det, near)),
        };
        let b_tolerance = PerKernel {
            textbook: bound(error_bounds.textbook_b(normal, det)),
            robust: bound(robust.b(det)),
        };
        Crossing {
            t,
            b1: BigFloat::ratio(&self.e[1], &self.det),
            b2: BigFloat::ratio(&self.e[2], &self.det),
            t_tolerance,
            b_tolerance,
            p_tolerance: PerKernel::each(|k| {
                error_bounds.position(k, *t_tolerance.get(k), *b_tolerance.get(k))
            }),
        }
    }
}
