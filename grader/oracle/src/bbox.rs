//! Rays and boxes.

use std::cmp::Ordering;

use kit::{Aabb, Interval, Ray};

use super::dyadic::Dyadic;
use super::real::Real;
use super::roundoff::U;
use super::triangle::range_misses;
use super::verdict::{Kernel, Miss, PerKernel};

/// How far, relative to `t`, a box test may err on the side of a hit, and how close to a corner the
/// plain slab test may err on the other side.
///
/// A slab's `t = (plane - o) · (1/d)` has three roundings, on either end of the interval; a
/// conservative test (Ize, *Robust BVH Ray Traversal*, JCGT 2013) widens the far end by 2 ulp, which is 4
/// more at most: 10 in all, rounded up.
pub const SLACK: f64 = 16.0 * U;

/// How far an end of the interval may be off, relative to it: 7 roundings and widenings, doubled.
pub const END_ERROR: f64 = 16.0 * U;

/// Positions up to here can be subtracted, and numbers up to here have a reciprocal that is not denormal: 2^1000.
const LARGEST: f64 = f64::from_bits((1023 + 1000) << 52);

/// All there is to say about one ray and one box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxVerdict {
    /// Where the ray is inside the box, exactly; or why nowhere.
    pub inside: Result<RealInterval, Miss>,
    /// Whether the interval is a single point: the ray touches an edge, a corner, a flat box,
    /// or the box from outside with an end of its range.
    pub touches: bool,
    /// By how much the ray misses: the far end is this much less than the near end, relative to the larger of
    /// the two. Negative where it hits; 0 where it touches; infinite where it runs beside.
    pub gap: f64,
    /// Whether "no hit" scores.
    pub miss_scores: PerKernel<bool>,
    /// Whether "hit" scores: a test for a tree may see a hit where there is none, by a few ulp, but never the
    /// other way round.
    pub hit_scores: bool,
    /// Whether every answer scores, for the numbers leave the range in which `f64` works.
    pub free: PerKernel<bool>,
    /// Ends of the interval as the slabs give them, near and far, also where the far one is less; `None`
    /// where the ray misses by a mile.
    pub ends: Option<(End, End)>,
}

/// A closed interval of exact ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RealInterval {
    /// Where it starts.
    pub min: End,
    /// Where it ends.
    pub max: End,
}

/// An end of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// The far end of a ray to the left, or of a box that has none there.
    MinusInfinity,
    /// A `t`.
    At(Real),
    /// The far end of a ray, or of a box that has none there.
    PlusInfinity,
}

impl End {
    /// The nearest `f64`.
    pub fn to_f64(&self) -> f64 {
        match self {
            End::MinusInfinity => f64::NEG_INFINITY,
            End::At(t) => t.to_f64(),
            End::PlusInfinity => f64::INFINITY,
        }
    }
}

/// What a box test's answer is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BoxJudgement {
    /// Hit or miss is right, and so are the ends.
    Right,
    /// Hit and miss both score here.
    Either,
    /// There is no hit, not even nearly.
    FalseHit,
    /// There is a hit; a tree would lose what is in the box.
    FalseMiss,
    /// There is a hit, but it starts elsewhere. The true `t`.
    WrongStart(f64),
    /// There is a hit, but it ends elsewhere. The true `t`.
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
        // A ray that goes nowhere may as well be inside a box.
        let free = matches!(why, Miss::NotFinite | Miss::NoDirection);
        BoxVerdict {
            inside: Err(why),
            touches: false,
            gap: f64::INFINITY,
            miss_scores: PerKernel::each(|_| true),
            hit_scores: free,
            free: PerKernel::each(|_| free),
            ends: None,
        }
    }

    /// Whether the ray truly meets the box, faces and both ends of the range included.
    pub fn hits(&self) -> bool {
        self.inside.is_ok()
    }

    /// Whether correct code of this kind may answer either way.
    pub fn undecidable(&self, kernel: Kernel) -> bool {
        *self.free.get(kernel) || (self.hit_scores && *self.miss_scores.get(kernel))
    }

    /// Judges an answer: the interval, or `None` for a miss.
    pub fn judge(&self, kernel: Kernel, answer: Option<Interval>) -> BoxJudgement {
        if *self.free.get(kernel) {
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
        if !self.hit_scores {
            return BoxJudgement::FalseHit;
        }
        let Some((near, far)) = self.ends else {
            return right;
        };
        if !is_end(answer.min, near) {
            return BoxJudgement::WrongStart(near.to_f64());
        }
        if !is_end(answer.max, far) {
            return BoxJudgement::WrongEnd(far.to_f64());
        }
        right
    }
}

/// Whether an answer's end is where it should be, up to [`END_ERROR`].
fn is_end(answer: f64, truth: End) -> bool {
    let truth = truth.to_f64();
    answer == truth || (answer - truth).abs() <= (END_ERROR * truth.abs()).max(f64::MIN_POSITIVE)
}

/// Decides where `ray` is inside `b`, exactly, and which answers in `f64` score.
///
/// Faces, edges, corners and both ends of the range count. Where a component of `d` is 0, of
/// either sign, the ray stays between that pair of planes if its origin is between them or on
/// one. An empty box and NaN anywhere are misses; about `d = 0` nothing is said.
pub fn bbox(b: &Aabb, ray: &Ray) -> BoxVerdict {
    if let Some(why) = by_convention(b, ray) {
        return BoxVerdict::miss(why);
    }
    BoxVerdict {
        free: PerKernel::each(|kernel| !in_reach(kernel, b, ray)),
        ..decide(b, ray)
    }
}

/// The verdict on finite numbers, whether or not `f64` can work with them.
fn decide(b: &Aabb, ray: &Ray) -> BoxVerdict {
    let (mut near, mut far) = (vec![Cut::range(ray.min_t)], vec![Cut::range(ray.max_t)]);
    let mut runs_beside = false;
    for axis in 0..3 {
        let (o, d) = (ray.o[axis], ray.d[axis]);
        let (min, max) = (b.min[axis], b.max[axis]);
        if d == 0.0 {
            runs_beside |= !(min <= o && o <= max);
            continue;
        }
        let (enter, leave) = if d > 0.0 { (min, max) } else { (max, min) };
        near.push(Cut::slab(axis, enter, o, d));
        far.push(Cut::slab(axis, leave, o, d));
    }
    if runs_beside {
        // A quotient by 0 puts the ray into the slab at infinity: where nothing else ends the interval
        // before, plain code sees it hit there.
        let never_leaves = far.iter().all(|cut| cut.t == f64::INFINITY);
        let never_enters = near.iter().all(|cut| cut.t == f64::NEG_INFINITY);
        return BoxVerdict {
            hit_scores: never_leaves || never_enters,
            ..BoxVerdict::miss(Miss::Beside)
        };
    }
    match filter(&mut near, &mut far) {
        Some(miss) => miss,
        None => Bounds::new(&near, &far).verdict(),
    }
}

/// Whether `f64` can work with these numbers: no difference of positions overflows, and `1/d` is a normal number.
/// A robust test must know its way about the slowest directions (a denormal's reciprocal overflows).
fn in_reach(kernel: Kernel, b: &Aabb, ray: &Ray) -> bool {
    let is_finite = |x: &f64| x.is_finite();
    let places = [b.min, b.max, ray.o].map(|v| v.to_array());
    let moves = ray.d.to_array();
    let slowest = match kernel {
        Kernel::Textbook => LARGEST.recip(),
        Kernel::Robust => 0.0,
    };
    let fits = |d: &f64| *d == 0.0 || (slowest..=LARGEST).contains(&d.abs());
    let mut places = places.iter().flatten().filter(|x| is_finite(x));
    places.all(|x| x.abs() <= LARGEST) && moves.iter().all(fits)
}

/// The misses that need no arithmetic.
fn by_convention(b: &Aabb, ray: &Ray) -> Option<Miss> {
    if b.min.is_nan() || b.max.is_nan() || ray.o.is_nan() || ray.d.is_nan() {
        return Some(Miss::NotANumber);
    }
    if b.is_empty() {
        return Some(Miss::Degenerate);
    }
    if !ray.o.is_finite() || !ray.d.is_finite() {
        return Some(Miss::NotFinite);
    }
    range_misses(ray)
}

/// Something that cuts the interval: an end of the ray's range, or a plane of the box.
struct Cut {
    /// `None` for the range.
    axis: Option<usize>,
    /// Where the plane is, on its axis, and the ray's origin and direction there; a range end is its own plane.
    plane: f64,
    o: f64,
    d: f64,
    /// Where the cut is along the ray, `(plane - o) / d`, rounded.
    t: f64,
}

impl Cut {
    fn range(end: f64) -> Cut {
        Cut {
            axis: None,
            plane: end,
            o: 0.0,
            d: 1.0,
            t: end,
        }
    }

    fn slab(axis: usize, plane: f64, o: f64, d: f64) -> Cut {
        Cut {
            axis: Some(axis),
            plane,
            o,
            d,
            t: (plane - o) / d,
        }
    }
}

/// Drops the cuts that are far from deciding anything, and finds the misses by a mile; in `f64`.
///
/// A rounded `t` is right to 2 U, unless it is so small or so large that it may have lost bits:
/// then nothing is dropped. Ten times the slack leaves out no cut that could matter.
fn filter(near: &mut Vec<Cut>, far: &mut Vec<Cut>) -> Option<BoxVerdict> {
    let last = near
        .iter()
        .map(|cut| cut.t)
        .fold(f64::NEG_INFINITY, f64::max);
    let first = far.iter().map(|cut| cut.t).fold(f64::INFINITY, f64::min);
    let is_before = |a: f64, b: f64| {
        let size = a.abs().max(b.abs());
        (1e-290..1e290).contains(&size) && b - a > 10.0 * SLACK * size
    };
    if is_before(first, last) {
        return Some(BoxVerdict {
            gap: (last - first) / last.abs().max(first.abs()),
            ..BoxVerdict::miss(Miss::Beside)
        });
    }
    near.retain(|cut| !is_before(cut.t, last));
    far.retain(|cut| !is_before(first, cut.t));
    None
}

/// One end that the interval is cut at, exactly.
struct Bound {
    axis: Option<usize>,
    end: End,
    /// Where the end is finite, the quotient that it is, with a positive divisor: two ends that
    /// agree in 126 bits are still told apart.
    quotient: Option<(Dyadic, Dyadic)>,
    /// Whether a plain slab test finds this end without a rounding.
    is_exact: bool,
}

impl Bound {
    fn new(cut: &Cut) -> Bound {
        let axis = cut.axis;
        if cut.plane.is_infinite() {
            return Bound {
                axis,
                end: match (cut.plane > 0.0) == (cut.d > 0.0) {
                    true => End::PlusInfinity,
                    false => End::MinusInfinity,
                },
                quotient: None,
                is_exact: true,
            };
        }
        let distance = &Dyadic::new(cut.plane) - &Dyadic::new(cut.o);
        let d = Dyadic::new(cut.d);
        let t = Real::ratio(&distance, &d);
        let subtracts_exactly = Real::from(&distance).ulps(cut.plane - cut.o) == 0.0;
        let is_exact = d.is_power_of_two() && subtracts_exactly && t.ulps(t.to_f64()) == 0.0;
        let quotient = match d.sign() < 0 {
            true => (-&distance, -&d),
            false => (distance, d),
        };
        Bound {
            axis,
            end: End::At(t),
            quotient: Some(quotient),
            is_exact,
        }
    }

    fn compare(&self, other: &Bound) -> Ordering {
        let exactly = || match (&self.quotient, &other.quotient) {
            (Some((a, b)), Some((c, d))) => (a * d).compare(&(c * b)),
            _ => Ordering::Equal,
        };
        self.end.cmp(&other.end).then_with(exactly)
    }
}

/// The ends that the interval is cut at: it starts at the largest near one and stops at the smallest far one.
struct Bounds {
    near: Vec<Bound>,
    far: Vec<Bound>,
}

impl Bounds {
    fn new(near: &[Cut], far: &[Cut]) -> Bounds {
        Bounds {
            near: near.iter().map(Bound::new).collect(),
            far: far.iter().map(Bound::new).collect(),
        }
    }

    fn verdict(&self) -> BoxVerdict {
        let near = self.near.iter().max_by(|a, b| a.compare(b));
        let far = self.far.iter().min_by(|a, b| a.compare(b));
        let (Some(near), Some(far)) = (near, far) else {
            unreachable!("the cut that is last, or first, was kept")
        };
        let order = near.compare(far);
        let gap = relative_gap(near, far);
        let (near, far) = (near.end, far.end);
        let hits = order.is_le();
        let beyond_f64 = |end: End| matches!(end, End::At(t) if t.to_f64().is_infinite());
        // Past the largest float there is no telling one t from another.
        let lost = beyond_f64(near) || beyond_f64(far);
        BoxVerdict {
            inside: if hits {
                Ok(RealInterval {
                    min: near,
                    max: far,
                })
            } else {
                Err(Miss::Beside)
            },
            touches: order.is_eq(),
            gap,
            miss_scores: PerKernel {
                textbook: !hits || lost || self.corner_may_round(),
                robust: !hits || lost,
            },
            hit_scores: hits || lost || gap <= SLACK,
            free: PerKernel::default(),
            ends: Some((near, far)),
        }
    }

    /// Whether a plain slab test may round a near end past a far end of another axis. Ends of the
    /// same axis round alike, so a flat box is never in doubt.
    fn corner_may_round(&self) -> bool {
        self.near.iter().any(|near| {
            self.far.iter().any(|far| {
                let alike = near.axis == far.axis || (near.is_exact && far.is_exact);
                !alike && relative_gap(near, far) >= -SLACK
            })
        })
    }
}

/// `near - far`, relative to the larger of the two in size; positive where the interval is empty.
fn relative_gap(near: &Bound, far: &Bound) -> f64 {
    let order = near.compare(far);
    let (a, b) = (near.end.to_f64(), far.end.to_f64());
    if a.is_infinite() || b.is_infinite() {
        return match order {
            Ordering::Less => f64::NEG_INFINITY,
            Ordering::Equal => 0.0,
            Ordering::Greater => f64::INFINITY,
        };
    }
    // Halved, so that no difference overflows; rounded, but never across 0.
    let (half_a, half_b) = (a / 2.0, b / 2.0);
    let gap = (half_a - half_b) / half_a.abs().max(half_b.abs());
    match order {
        Ordering::Equal => 0.0,
        Ordering::Less => gap.min(-f64::MIN_POSITIVE),
        Ordering::Greater => gap.max(f64::MIN_POSITIVE),
    }
}
