//! The exact ray/box test.

use std::cmp::Ordering;

use kit::{Aabb, Interval, Ray};

use super::big_float::BigFloat;
use super::dyadic::Dyadic;
use super::roundoff::U;
use super::triangle::invalid_ray;
use super::verdict::{KernelClass, Miss, PerKernel};

/// Relative error of `t` by which a box test may hit although the ray misses, and by which the
/// plain slab test may miss a corner.
///
/// A slab's `t = (plane - o) · (1/d)` has three roundings at either end of the interval. A
/// conservative test (Ize, *Robust BVH Ray Traversal*, JCGT 2013) widens the far end by 2 ulp,
/// which is 4 roundings more at most: 10 in all, rounded up.
pub const SLACK: f64 = 16.0 * U;

/// Largest relative error of an end of the interval: 7 roundings and widenings, doubled.
pub const END_ERROR: f64 = 16.0 * U;

/// Error of a slab's planes that textbook code may make, relative to the sum of the sizes of both
/// planes and of the origin on its axis.
///
/// `(plane - o) · (1/d)` makes none beyond [`END_ERROR`]. A test with the centre and half the
/// extent computes `((min + max)/2 - o) ∓ (max - min)/2`, and another one `plane · (1/d) - o · (1/d)`:
/// each term rounds by up to 2 U of its own size, and their difference may be much smaller. At most
/// 4 roundings of the whole sum, doubled.
const PLANE_ERROR: f64 = 8.0 * U;

/// The largest number, 2^1000, for which differences of positions do not overflow and the
/// reciprocal is not denormal.
const LARGEST: f64 = f64::from_bits((1023 + 1000) << 52);

/// The oracle's result for one ray and one box.
///
/// ```
/// use kit::{Aabb, Interval, Ray, Vec3};
/// use oracle::{BoxJudgement, KernelClass, bbox};
/// let unit = Aabb::of([Vec3::ZERO, Vec3::ONE]);
/// let verdict = bbox(&unit, &Ray::new(Vec3::new(0.5, 0.5, 3.0), Vec3::NEG_Z));
/// let inside = verdict.inside.expect("the ray hits");
/// assert_eq!((inside.min.to_f64(), inside.max.to_f64()), (2.0, 3.0));
/// let answer = Interval { min: 2.0, max: 3.0 };
/// assert_eq!(verdict.judge(KernelClass::Robust, Some(answer)), BoxJudgement::Right);
/// assert_eq!(verdict.judge(KernelClass::Robust, None), BoxJudgement::FalseMiss);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxVerdict {
    /// The exact interval in which the ray is inside the box, or the reason for a miss.
    pub inside: Result<ExactInterval, Miss>,
    /// Whether the interval is a single point: the ray touches an edge, a corner or a flat box, or
    /// an end of its range touches the box from outside.
    pub touches: bool,
    /// How far the ray misses: the near end minus the far end of the interval, relative to the
    /// larger of the two in size. Negative for a hit, 0 for a touch, infinite if the ray is
    /// parallel to a slab and outside it.
    pub gap: f64,
    /// Whether "no hit" scores.
    pub miss_scores: PerKernel<bool>,
    /// Whether "hit" scores. A box test for tree traversal may hit although the ray misses by a few
    /// ulp, but never miss although the ray hits.
    pub hit_scores: PerKernel<bool>,
    /// Whether every answer scores, because the numbers are out of the range of `f64` arithmetic.
    pub any_scores: PerKernel<bool>,
    /// Near and far end of the interval by the slabs, also if the far end is smaller; `None` if the
    /// ray clearly misses.
    pub ends: Option<(End, End)>,
    /// The least and the largest near end, and those of the far end, that textbook code may compute,
    /// before the rounding that [`END_ERROR`] allows.
    pub textbook_ends: [[f64; 2]; 2],
}

/// A closed interval with exact ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactInterval {
    /// Near end.
    pub min: End,
    /// Far end.
    pub max: End,
}

/// An end of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// Minus infinity: the range of the ray or a slab of the box is unbounded.
    MinusInfinity,
    /// A finite `t`.
    At(BigFloat),
    /// Plus infinity: the range of the ray or a slab of the box is unbounded.
    PlusInfinity,
}

impl End {
    /// Returns the nearest `f64`.
    pub fn to_f64(&self) -> f64 {
        match self {
            End::MinusInfinity => f64::NEG_INFINITY,
            End::At(t) => t.to_f64(),
            End::PlusInfinity => f64::INFINITY,
        }
    }
}

/// The result of judging a box test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BoxJudgement {
    /// Hit or miss is correct, and so are the ends of the interval.
    Right,
    /// Hit and miss both score for this ray.
    Either,
    /// The answer is a hit; the ray misses by more than the tolerance.
    FalseHit,
    /// The answer is a miss; the ray hits. A tree traversal would lose the contents of the box.
    FalseMiss,
    /// The ray hits, but the near end is wrong. Holds the true `t`.
    WrongStart(f64),
    /// The ray hits, but the far end is wrong. Holds the true `t`.
    WrongEnd(f64),
}

impl BoxJudgement {
    /// Whether the answer scores.
    pub fn scores(&self) -> bool {
        matches!(self, BoxJudgement::Right | BoxJudgement::Either)
    }
}

impl BoxVerdict {
    fn miss(why: Miss) -> BoxVerdict {
        // The result for a direction of 0 is not specified.
        let any_scores = matches!(why, Miss::NotFinite | Miss::ZeroDirection);
        BoxVerdict {
            inside: Err(why),
            touches: false,
            gap: f64::INFINITY,
            miss_scores: PerKernel::each(|_| true),
            hit_scores: PerKernel::each(|_| any_scores),
            any_scores: PerKernel::each(|_| any_scores),
            ends: None,
            textbook_ends: [[f64::NEG_INFINITY, f64::INFINITY]; 2],
        }
    }

    /// Whether the ray meets the box, by exact arithmetic; faces and both ends of the range count.
    pub fn hits(&self) -> bool {
        self.inside.is_ok()
    }

    /// Whether correct code of this class may return a hit or a miss.
    pub fn undecidable(&self, kernel: KernelClass) -> bool {
        *self.any_scores.get(kernel)
            || (*self.hit_scores.get(kernel) && *self.miss_scores.get(kernel))
    }

    /// Judges an answer: the interval, or `None` for a miss.
    pub fn judge(&self, kernel: KernelClass, answer: Option<Interval>) -> BoxJudgement {
        if *self.any_scores.get(kernel) {
            return BoxJudgement::Either;
        }
        let right = match self.undecidable(kernel) {
            true => BoxJudgement::Either,
            false => BoxJudgement::Right,
        };
        let Some(answer) = answer else {
            return match self.miss_scores.get(kernel) {
                true => right,
                false => BoxJudgement::FalseMiss,
            };
        };
        if !self.hit_scores.get(kernel) {
            return BoxJudgement::FalseHit;
        }
        let Some((near, far)) = self.ends else {
            return right;
        };
        let [may_start, may_end] = match kernel {
            KernelClass::Textbook => self.textbook_ends,
            KernelClass::Robust => [near, far].map(|end| [end.to_f64(); 2]),
        };
        if !is_end(answer.min, near, may_start) {
            return BoxJudgement::WrongStart(near.to_f64());
        }
        if !is_end(answer.max, far, may_end) {
            return BoxJudgement::WrongEnd(far.to_f64());
        }
        right
    }
}

/// Whether an end of the answered interval is correct, up to [`END_ERROR`], or between the `least`
/// and the `largest` that code of its class computes.
fn is_end(answer: f64, truth: End, [least, largest]: [f64; 2]) -> bool {
    let truth = truth.to_f64();
    let rounding = (END_ERROR * truth.abs()).max(f64::MIN_POSITIVE);
    answer == truth
        || (answer - truth).abs() <= rounding
        || truth.is_finite() && least - rounding <= answer && answer <= largest + rounding
}

/// Decides exactly where `ray` is inside `b`, and which answers in `f64` score.
///
/// Faces, edges, corners and both ends of the range count. If a component of `d` is 0, of either
/// sign, the ray is inside that slab if its origin is between the two planes or on one of them. An
/// empty box and NaN anywhere are misses. The result for `d = 0` is not specified.
pub fn bbox(b: &Aabb, ray: &Ray) -> BoxVerdict {
    if let Some(why) = conventional_miss(b, ray) {
        return BoxVerdict::miss(why);
    }
    BoxVerdict {
        any_scores: PerKernel::each(|kernel| !fits_f64(kernel, b, ray)),
        ..decide(b, ray)
    }
}

/// Returns the verdict for finite numbers, whether or not they fit `f64` arithmetic.
fn decide(b: &Aabb, ray: &Ray) -> BoxVerdict {
    let (mut near, mut far) = (vec![Limit::range(ray.min_t)], vec![Limit::range(ray.max_t)]);
    let mut misses_a_slab = false;
    for axis in 0..3 {
        let (o, d) = (ray.o[axis], ray.d[axis]);
        let (min, max) = (b.min[axis], b.max[axis]);
        if d == 0.0 {
            misses_a_slab |= !(min <= o && o <= max);
            continue;
        }
        let (enter, leave) = if d > 0.0 { (min, max) } else { (max, min) };
        let blur = blur([min, max, o], d);
        near.push(Limit::slab(axis, enter, o, d, blur));
        far.push(Limit::slab(axis, leave, o, d, blur));
    }
    if misses_a_slab {
        // Division by 0 puts the ends of this slab at infinity. If no other limit makes the
        // interval empty, plain code finds a hit there.
        let never_leaves = far.iter().all(|limit| limit.t == f64::INFINITY);
        let never_enters = near.iter().all(|limit| limit.t == f64::NEG_INFINITY);
        return BoxVerdict {
            hit_scores: PerKernel::each(|_| never_leaves || never_enters),
            ..BoxVerdict::miss(Miss::LineMisses)
        };
    }
    let textbook_ends = textbook_ends(&near, &far);
    match filter(&mut near, &mut far) {
        Some(miss) => miss,
        None => BoxVerdict {
            textbook_ends,
            ..ExactLimits::new(&near, &far).verdict()
        },
    }
}

/// How far textbook code may move the limits of a slab along the ray; see [`PLANE_ERROR`]. An
/// infinite plane has no rounding errors.
fn blur(planes_and_origin: [f64; 3], d: f64) -> f64 {
    let size = |x: f64| if x.is_finite() { x.abs() } else { 0.0 };
    let sizes: f64 = planes_and_origin.map(size).iter().sum();
    let blur = PLANE_ERROR * sizes / d.abs();
    if blur.is_finite() { blur } else { 0.0 }
}

/// The least and the largest near end, and those of the far end, that textbook code may compute.
fn textbook_ends(near: &[Limit], far: &[Limit]) -> [[f64; 2]; 2] {
    let last = |of: fn(&Limit) -> f64| near.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let first = |of: fn(&Limit) -> f64| far.iter().map(of).fold(f64::INFINITY, f64::min);
    let least = |limit: &Limit| limit.t - limit.blur;
    let largest = |limit: &Limit| limit.t + limit.blur;
    [[last(least), last(largest)], [first(least), first(largest)]]
}

/// Whether no difference of positions overflows and `1/d` is a normal number. A robust test must
/// also handle the smallest directions (the reciprocal of a denormal overflows).
fn fits_f64(kernel: KernelClass, b: &Aabb, ray: &Ray) -> bool {
    let is_finite = |x: &f64| x.is_finite();
    let points = [b.min, b.max, ray.o].map(|v| v.to_array());
    let direction = ray.d.to_array();
    let slowest = match kernel {
        KernelClass::Textbook => LARGEST.recip(),
        KernelClass::Robust => 0.0,
    };
    let fits = |d: &f64| *d == 0.0 || (slowest..=LARGEST).contains(&d.abs());
    let mut points = points.iter().flatten().filter(|x| is_finite(x));
    points.all(|x| x.abs() <= LARGEST) && direction.iter().all(fits)
}

/// Returns the misses that need no arithmetic.
fn conventional_miss(b: &Aabb, ray: &Ray) -> Option<Miss> {
    if b.min.is_nan() || b.max.is_nan() || ray.o.is_nan() || ray.d.is_nan() {
        return Some(Miss::NotANumber);
    }
    if b.is_empty() {
        return Some(Miss::Degenerate);
    }
    if !ray.o.is_finite() || !ray.d.is_finite() {
        return Some(Miss::NotFinite);
    }
    invalid_ray(ray)
}

/// A limit of the interval: an end of the ray's range, or a plane of the box.
struct Limit {
    /// The axis of the plane; `None` for the range.
    axis: Option<usize>,
    /// The plane's coordinate on its axis, and the ray's origin and direction there. An end of the
    /// range is its own plane, with origin 0 and direction 1.
    plane: f64,
    o: f64,
    d: f64,
    /// The ray's `t` at the limit, `(plane - o) / d`, rounded.
    t: f64,
    /// How far textbook code may move it; see [`blur`].
    blur: f64,
}

impl Limit {
    fn range(end: f64) -> Limit {
        Limit {
            axis: None,
            plane: end,
            o: 0.0,
            d: 1.0,
            t: end,
            blur: 0.0,
        }
    }

    fn slab(axis: usize, plane: f64, o: f64, d: f64, blur: f64) -> Limit {
        Limit {
            axis: Some(axis),
            plane,
            o,
            d,
            t: (plane - o) / d,
            blur,
        }
    }
}

/// Removes the limits that cannot decide anything, and returns the verdict if the ray clearly
/// misses; in `f64`.
///
/// A rounded `t` has a relative error of 2 U, unless it is so small or so large that it may have
/// lost bits; then nothing is removed. Ten times the slack keeps every limit that can matter.
fn filter(near: &mut Vec<Limit>, far: &mut Vec<Limit>) -> Option<BoxVerdict> {
    let widest = near.iter().chain(&*far);
    let blur = widest.map(|limit| limit.blur).fold(0.0, f64::max);
    let last = near
        .iter()
        .map(|limit| limit.t)
        .fold(f64::NEG_INFINITY, f64::max);
    let first = far
        .iter()
        .map(|limit| limit.t)
        .fold(f64::INFINITY, f64::min);
    let is_before = |a: f64, b: f64| {
        let size = a.abs().max(b.abs());
        (1e-290..1e290).contains(&size) && b - a > 10.0 * SLACK * size + 2.0 * blur
    };
    if is_before(first, last) {
        return Some(BoxVerdict {
            gap: (last - first) / last.abs().max(first.abs()),
            ..BoxVerdict::miss(Miss::LineMisses)
        });
    }
    near.retain(|limit| !is_before(limit.t, last));
    far.retain(|limit| !is_before(first, limit.t));
    None
}

/// A limit of the interval, computed exactly.
struct ExactLimit {
    axis: Option<usize>,
    end: End,
    /// The exact quotient of a finite end, with a positive divisor: it distinguishes two ends that
    /// agree in 126 bits.
    quotient: Option<(Dyadic, Dyadic)>,
    /// Whether a plain slab test computes this end without rounding.
    is_exact: bool,
    /// How far textbook code may move it; see [`blur`].
    blur: f64,
}

impl ExactLimit {
    fn new(limit: &Limit) -> ExactLimit {
        let axis = limit.axis;
        if limit.plane.is_infinite() {
            return ExactLimit {
                axis,
                end: match (limit.plane > 0.0) == (limit.d > 0.0) {
                    true => End::PlusInfinity,
                    false => End::MinusInfinity,
                },
                quotient: None,
                is_exact: true,
                blur: 0.0,
            };
        }
        let distance = &Dyadic::new(limit.plane) - &Dyadic::new(limit.o);
        let d = Dyadic::new(limit.d);
        let t = BigFloat::ratio(&distance, &d);
        let subtracts_exactly = BigFloat::from(&distance).ulps(limit.plane - limit.o) == 0.0;
        let is_exact = d.is_power_of_two() && subtracts_exactly && t.ulps(t.to_f64()) == 0.0;
        let quotient = match d.sign() < 0 {
            true => (-&distance, -&d),
            false => (distance, d),
        };
        ExactLimit {
            axis,
            end: End::At(t),
            quotient: Some(quotient),
            is_exact,
            blur: limit.blur,
        }
    }

    fn compare(&self, other: &ExactLimit) -> Ordering {
        let exactly = || match (&self.quotient, &other.quotient) {
            (Some((a, b)), Some((c, d))) => (a * d).compare(&(c * b)),
            _ => Ordering::Equal,
        };
        self.end.cmp(&other.end).then_with(exactly)
    }
}

/// The limits of the interval: it starts at the largest near one and ends at the smallest far one.
struct ExactLimits {
    near: Vec<ExactLimit>,
    far: Vec<ExactLimit>,
}

impl ExactLimits {
    fn new(near: &[Limit], far: &[Limit]) -> ExactLimits {
        ExactLimits {
            near: near.iter().map(ExactLimit::new).collect(),
            far: far.iter().map(ExactLimit::new).collect(),
        }
    }

    fn verdict(&self) -> BoxVerdict {
        let near = self.near.iter().max_by(|a, b| a.compare(b));
        let far = self.far.iter().min_by(|a, b| a.compare(b));
        let (Some(near), Some(far)) = (near, far) else {
            unreachable!("the filter keeps at least one near and one far limit")
        };
        let order = near.compare(far);
        let gap = relative_gap(near, far);
        let overlap_by_blur = is_within_blur(near, far);
        let (near, far) = (near.end, far.end);
        let hits = order.is_le();
        let beyond_f64 = |end: End| matches!(end, End::At(t) if t.to_f64().is_infinite());
        // Beyond the largest f64 no two values of t can be distinguished.
        let lost = beyond_f64(near) || beyond_f64(far);
        BoxVerdict {
            inside: if hits {
                Ok(ExactInterval {
                    min: near,
                    max: far,
                })
            } else {
                Err(Miss::LineMisses)
            },
            touches: order.is_eq(),
            gap,
            miss_scores: PerKernel {
                textbook: !hits || lost || self.corner_may_round(),
                robust: !hits || lost,
            },
            hit_scores: PerKernel {
                textbook: hits || lost || gap <= SLACK || overlap_by_blur,
                robust: hits || lost || gap <= SLACK,
            },
            any_scores: PerKernel::default(),
            ends: Some((near, far)),
            textbook_ends: [near, far].map(|end| [end.to_f64(); 2]),
        }
    }

    /// Whether a plain slab test may round a near end past a far end of another axis. Ends of the
    /// same axis round in the same way, so a flat box is always decided.
    fn corner_may_round(&self) -> bool {
        self.near.iter().any(|near| {
            self.far.iter().any(|far| {
                let alike = near.axis == far.axis || (near.is_exact && far.is_exact);
                let is_close = relative_gap(near, far) >= -SLACK || is_within_blur(near, far);
                !alike && is_close
            })
        })
    }
}

/// Whether textbook code may compute two limits of different axes in the other order. Both limits of
/// one axis move in the same way.
fn is_within_blur(near: &ExactLimit, far: &ExactLimit) -> bool {
    let gap = (near.end.to_f64() - far.end.to_f64()).abs();
    near.axis != far.axis && gap <= near.blur + far.blur
}

/// Returns `near - far`, relative to the larger of the two in size; positive if the interval is
/// empty.
fn relative_gap(near: &ExactLimit, far: &ExactLimit) -> f64 {
    let order = near.compare(far);
    let (a, b) = (near.end.to_f64(), far.end.to_f64());
    if a.is_infinite() || b.is_infinite() {
        return match order {
            Ordering::Less => f64::NEG_INFINITY,
            Ordering::Equal => 0.0,
            Ordering::Greater => f64::INFINITY,
        };
    }
    // Halved, so that no difference overflows; rounded, but the sign is exact.
    let (half_a, half_b) = (a / 2.0, b / 2.0);
    let gap = (half_a - half_b) / half_a.abs().max(half_b.abs());
    match order {
        Ordering::Equal => 0.0,
        Ordering::Less => gap.min(-f64::MIN_POSITIVE),
        Ordering::Greater => gap.max(f64::MIN_POSITIVE),
    }
}
