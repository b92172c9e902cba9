//! Rays and triangles.

use std::cmp::Ordering;

use kit::{Ray, Triangle, Vec3};

use super::dyadic::{Dyadic, Dyadic3};
use super::real::Real;
use super::triangle_error::{Frame, Robust};
use super::verdict::{Answers, Candidate, Judgement, Kernel, Miss, PerKernel, Sure};

/// Where a ray passes a triangle, exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TriangleClass {
    /// Through its inside.
    Inside,
    /// Through the inside of the edge that is opposite to this vertex (0, 1 or 2). Counts as a hit.
    Edge(u8),
    /// Through this vertex. Counts as a hit.
    Vertex(u8),
    /// Not at all.
    Miss(Miss),
}

/// Where the line of a ray crosses the plane of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Distance along the ray, in lengths of its direction.
    pub t: Real,
    /// Barycentric weight of `p1`.
    pub b1: Real,
    /// Barycentric weight of `p2`.
    pub b2: Real,
    /// How far a `t` may be off. Infinite where rounding decides everything.
    pub t_tolerance: PerKernel<f64>,
    /// How far a barycentric weight may be off.
    pub b_tolerance: PerKernel<f64>,
    /// How far each coordinate of the hit point may be off.
    pub p_tolerance: PerKernel<f64>,
}

/// All there is to say about one ray and one triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleVerdict {
    /// The exact answer.
    pub class: TriangleClass,
    /// Whether `t` is exactly `min_t` or `max_t`. Both ends count.
    pub at_range_end: bool,
    /// Where the ray's line meets the plane. There is always one with a hit; with a miss only
    /// where an undecidable one needs it.
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
            answers: PerKernel::each(|_| match why {
                Miss::NotFinite => Answers::ANY,
                _ => Answers::MISS,
            }),
        }
    }

    /// Whether the ray truly hits; the course's conventions count.
    pub fn hits(&self) -> bool {
        !matches!(self.class, TriangleClass::Miss(_))
    }

    /// Whether the exact answer hangs on a convention: an edge, a vertex or an end of the range.
    pub fn on_boundary(&self) -> bool {
        use TriangleClass::{Edge, Vertex};
        self.at_range_end || matches!(self.class, Edge(_) | Vertex(_))
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

/// Decides whether `ray` hits `tri`, exactly, and which answers in `f64` score.
///
/// Edges, vertices and both ends of the ray's range count, both faces are hit. A miss by convention: NaN
/// anywhere, `d = 0`, no area, a ray inside the plane. Only positions are read, not normals.
pub fn triangle(tri: &Triangle, ray: &Ray) -> TriangleVerdict {
    if let Some(why) = by_convention(tri, ray) {
        return TriangleVerdict::miss(why);
    }
    let frame = Frame::new(tri, ray);
    if frame.surely_misses() {
        return TriangleVerdict::miss(Miss::Beside);
    }
    let exact = Exact::new(tri, ray);
    exact.verdict(ray, &frame)
}

/// The misses that need no arithmetic.
fn by_convention(tri: &Triangle, ray: &Ray) -> Option<Miss> {
    let places = [tri.p0, tri.p1, tri.p2, ray.o, ray.d];
    if places.iter().any(|v| v.is_nan()) {
        return Some(Miss::NotANumber);
    }
    if let Some(why) = range_misses(ray) {
        return Some(why);
    }
    places
        .iter()
        .any(|v| !v.is_finite())
        .then_some(Miss::NotFinite)
}

/// The misses that a ray brings along, whatever it is tested against.
pub(super) fn range_misses(ray: &Ray) -> Option<Miss> {
    if ray.min_t.is_nan() || ray.max_t.is_nan() {
        Some(Miss::NotANumber)
    } else if ray.d == Vec3::ZERO {
        Some(Miss::NoDirection)
    } else if ray.min_t > ray.max_t {
        Some(Miss::EmptyRange)
    } else {
        None
    }
}

/// The exact numbers behind a verdict.
struct Exact {
    /// Edge functions, their sum, and the numerator of `t`; see `triangle_error`.
    e: [Dyadic; 3],
    det: Dyadic,
    num: Dyadic,
    normal: Dyadic3,
    /// The same, rounded, to be held against bounds.
    rounded: Rounded,
    /// Bits of the longest coordinate, and of the direction, each on its own common exponent.
    place_bits: usize,
    direction_bits: usize,
    /// Whether dividing by the longest component of the direction does not round.
    shear_is_exact: bool,
}

/// Some of [`Exact`]'s numbers in `f64`.
struct Rounded {
    e: [f64; 3],
    det: f64,
    normal: Vec3,
}

impl Exact {
    fn new(tri: &Triangle, ray: &Ray) -> Exact {
        let places = Dyadic3::aligned([tri.p0, tri.p1, tri.p2, ray.o]);
        let [d] = Dyadic3::aligned([ray.d]);
        let [a, b, c] = [0, 1, 2].map(|i| places[i].minus(&places[3]));
        let normal = b.minus(&a).cross(&c.minus(&a));
        let det = d.dot(&normal);
        let e1 = d.dot(&c.cross(&a));
        let e2 = d.dot(&a.cross(&b));
        let e = [&(&det - &e1) - &e2, e1, e2];
        Exact {
            rounded: Rounded {
                e: [0, 1, 2].map(|i| e[i].to_f64()),
                det: det.to_f64(),
                normal: normal.to_f64(),
            },
            e,
            num: a.dot(&normal),
            det,
            normal,
            place_bits: places.iter().map(Dyadic3::bits).max().unwrap_or(0),
            direction_bits: d.bits(),
            shear_is_exact: d.get(ray.d.abs().max_position()).is_power_of_two(),
        }
    }

    /// Where the line passes, whatever the range.
    fn class(&self) -> TriangleClass {
        if self.normal.is_zero() {
            return TriangleClass::Miss(Miss::Degenerate);
        }
        let facing = self.det.sign();
        if facing == 0 && self.num.sign() == 0 {
            return TriangleClass::Miss(Miss::Coplanar);
        } else if facing == 0 {
            return TriangleClass::Miss(Miss::Beside);
        }
        match [0, 1, 2].map(|i| self.e[i].sign() * facing) {
            [1, 1, 1] => TriangleClass::Inside,
            [0, 1, 1] => TriangleClass::Edge(0),
            [1, 0, 1] => TriangleClass::Edge(1),
            [1, 1, 0] => TriangleClass::Edge(2),
            [1, 0, 0] => TriangleClass::Vertex(0),
            [0, 1, 0] => TriangleClass::Vertex(1),
            [0, 0, 1] => TriangleClass::Vertex(2),
            _ => TriangleClass::Miss(Miss::Beside),
        }
    }

    /// How `t` compares with a range end; `det` must not be 0.
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

    fn verdict(&self, ray: &Ray, frame: &Frame) -> TriangleVerdict {
        let mut class = self.class();
        let mut verdict = TriangleVerdict::miss(Miss::Beside);
        let mut range = Sure::No;
        if self.det.sign() != 0 {
            let ends = (self.compare_t(ray.min_t), self.compare_t(ray.max_t));
            let inside = ends.0 != Ordering::Less && ends.1 != Ordering::Greater;
            let beside = matches!(class, TriangleClass::Miss(_));
            if !beside && !inside {
                class = TriangleClass::Miss(Miss::OutOfRange);
            }
            verdict.at_range_end = !beside && inside && (ends.0.is_eq() || ends.1.is_eq());
            range = Sure::exactly(inside);
        }
        verdict.class = class;
        let robust = frame.robust();
        let edges = PerKernel::each(|kernel| self.edges(kernel, frame, &robust));
        if edges == PerKernel::each(|_| Sure::No) {
            return verdict;
        }
        if self.det.sign() == 0 {
            verdict.answers = PerKernel::each(|kernel| match edges.get(kernel) {
                Sure::Open => Answers::ANY,
                _ => Answers::MISS,
            });
            return verdict;
        }
        let mut crossing = self.crossing(frame, &robust);
        let sure = PerKernel::each(|kernel| {
            let in_range = if self.divides_exactly(kernel, frame) {
                range
            } else {
                let t = crossing.t.to_f64();
                let error = *crossing.t_tolerance.get(kernel);
                Sure::in_range(t, error, (ray.min_t, ray.max_t))
            };
            edges.get(kernel).and(in_range)
        });
        if sure.robust == Sure::Yes {
            crossing.t_tolerance.robust = crossing.t_tolerance.robust.min(robust.t_cap());
        }
        verdict.answers = PerKernel::each(|kernel| {
            let hit = Some(Candidate {
                t: crossing.t,
                tolerance: *crossing.t_tolerance.get(kernel),
            });
            match sure.get(kernel) {
                Sure::No => Answers::MISS,
                sure => Answers {
                    hits: [hit, None],
                    miss: *sure == Sure::Open,
                },
            }
        });
        verdict.crossing = Some(crossing);
        verdict
    }

    /// Whether correct code is sure that the line passes through the triangle.
    fn edges(&self, kernel: Kernel, frame: &Frame, robust: &Robust) -> Sure {
        if !frame.in_reach {
            return Sure::Open;
        }
        if self.rounds_nothing(kernel) {
            return Sure::exactly(!matches!(self.class(), TriangleClass::Miss(_)));
        }
        let bounds = match kernel {
            Kernel::Textbook => [frame.textbook_edge(self.rounded.normal); 3],
            Kernel::Robust => robust.edges,
        };
        let e = self.rounded.e;
        let is_positive = [0, 1, 2].map(|i| e[i] > bounds[i]);
        let is_negative = [0, 1, 2].map(|i| e[i] < -bounds[i]);
        if is_positive.contains(&true) && is_negative.contains(&true) {
            Sure::No
        } else if is_positive == [true; 3] || is_negative == [true; 3] {
            Sure::Yes
        } else {
            Sure::Open
        }
    }

    /// Whether a kernel decides the edges without a single rounding, because its numbers are short.
    ///
    /// Counted in bits on common exponents: a robust kernel multiplies two lengths and the direction twice
    /// (shear), and a third length for `t`. A textbook one may multiply four lengths (plane and inside
    /// test), compares quotients by `det`, and normalises the normal, which is exact along an axis.
    fn rounds_nothing(&self, kernel: Kernel) -> bool {
        // Seen from the origin, a coordinate may be one bit longer.
        let (place, direction) = (self.place_bits + 1, self.direction_bits);
        let robust = self.shear_is_exact && 3 * place + 2 * direction + 3 <= 53;
        match kernel {
            Kernel::Robust => robust,
            Kernel::Textbook => {
                robust
                    && self.normal.is_along_an_axis()
                    && (self.det.sign() == 0 || self.det.is_power_of_two())
                    && 4 * place + 2 * direction + 4 <= 53
            }
        }
    }

    /// Whether a kernel finds `t` without a rounding, so that an end of the range may decide.
    fn divides_exactly(&self, kernel: Kernel, frame: &Frame) -> bool {
        frame.in_reach && self.rounds_nothing(kernel) && self.det.is_power_of_two()
    }

    fn crossing(&self, frame: &Frame, robust: &Robust) -> Crossing {
        let t = Real::ratio(&self.num, &self.det);
        let Rounded { e, det, normal } = self.rounded;
        let near = t.to_f64();
        let bound = |value: f64| {
            if frame.in_reach && !value.is_nan() {
                value
            } else {
                f64::INFINITY
            }
        };
        let t_tolerance = PerKernel {
            textbook: bound(frame.textbook_t(det, near)),
            robust: bound(robust.t(e, det, near)),
        };
        let b_tolerance = PerKernel {
            textbook: bound(frame.textbook_b(normal, det)),
            robust: bound(robust.b(det)),
        };
        Crossing {
            t,
            b1: Real::ratio(&self.e[1], &self.det),
            b2: Real::ratio(&self.e[2], &self.det),
            t_tolerance,
            b_tolerance,
            p_tolerance: PerKernel::each(|k| {
                frame.position(k, *t_tolerance.get(k), *b_tolerance.get(k))
            }),
        }
    }
}
