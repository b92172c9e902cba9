// BEGIN SOLUTION(part6.task1)
//! Ray/box tests: which boxes of a node a ray hits. They are conservative: they never miss a box
//! with a primitive that the ray hits.

use crate::node::Node;
use crate::sah::LANES;
use crate::space::{LocalRay, TreeSpace};
use kit::{Ray, Vec3};

/// The boxes of a node that a ray hits.
pub(crate) struct BoxHits {
    /// Their lanes, one bit each.
    pub(crate) lanes: u32,
    /// One key for each, in the order of the lanes; then zeros.
    pub(crate) keys: [Key; LANES],
}

/// A number that orders the boxes of a node by the `t` at which the ray enters: the bits of `t`,
/// rounded down to a multiple of 16, plus 8, so that no key is 0, plus the lane.
pub(crate) type Key = u32;

/// The bits of a key that are its lane.
pub(crate) const LANE_BITS: Key = LANES as Key - 1;

/// The bits of a key that are not from `t`.
pub(crate) const LOW_BITS: Key = 15;

/// The bit that is set in every key.
pub(crate) const KEY_BIT: Key = 8;

/// Tests one box after the other in double precision. For any ray.
pub(crate) struct ScalarBoxTest {
    /// The coordinates are finite, or all NaN, which hits every box.
    local: LocalRay,
    min_t: f64,
    max_t: f64,
}

/// The range and the exits are widened by this share: more than the rounding errors of a plane's
/// `t` and of any hit's `t`.
const SLACK: f64 = 64.0 * f64::EPSILON;

impl ScalarBoxTest {
    /// Cold: few rays need this test.
    #[cold]
    #[inline(never)]
    pub(crate) fn new(ray: &Ray, space: &TreeSpace) -> ScalarBoxTest {
        let mut local = space.ray(ray);
        if !(local.o.is_finite() && local.d.is_finite()) {
            (local.o, local.d) = (Vec3::NAN, Vec3::NAN);
        }
        let min_t = ray.min_t * local.speed;
        let mut test = ScalarBoxTest {
            local,
            // `max` ignores a NaN: such a range has no hits anyway.
            min_t: f64::NEG_INFINITY.max(min_t - SLACK * min_t.abs()),
            max_t: 0.0,
        };
        if test.min_t == f64::INFINITY {
            test.min_t = f64::NEG_INFINITY;
        }
        test.shorten(ray.max_t);
        test
    }

    /// The `t` at which the ray enters the box from `min` to `max`, if it hits. For a direction
    /// component of 0 the quotients are infinite, or NaN for an origin in the plane; comparisons
    /// ignore NaN.
    fn entry(&self, min: Vec3, max: Vec3) -> Option<f64> {
        let LocalRay { o, d, .. } = self.local;
        let (mut entry, mut exit) = (self.min_t, self.max_t);
        for axis in 0..3 {
            let (first, last) = if d[axis].is_sign_negative() {
                (max[axis], min[axis])
            } else {
                (min[axis], max[axis])
            };
            let (t_first, t_last) = ((first - o[axis]) / d[axis], (last - o[axis]) / d[axis]);
            if t_first > entry {
                entry = t_first;
            }
            if t_last < exit {
                exit = t_last;
            }
        }
        (min.cmple(max).all() && entry <= exit + SLACK * exit.abs()).then_some(entry)
    }
}

impl ScalarBoxTest {
    /// The boxes of `node` that the ray hits in its range.
    pub(crate) fn test(&self, node: &Node) -> BoxHits {
        let mut hits = BoxHits {
            lanes: 0,
            keys: [0; LANES],
        };
        let mut count = 0;
        for lane in 0..node.count as usize {
            let bounds = node.bounds(lane);
            if let Some(entry) = self.entry(bounds.min, bounds.max) {
                hits.lanes |= 1 << lane;
                let entry = ordered((entry as f32).next_down());
                hits.keys[count] = entry & !LOW_BITS | KEY_BIT | lane as Key;
                count += 1;
            }
        }
        hits
    }

    /// Shortens the range to `max_t` of the ray in world space.
    pub(crate) fn shorten(&mut self, max_t: f64) {
        self.max_t = max_t * self.local.speed;
        if self.max_t.is_nan() {
            self.max_t = f64::INFINITY;
        }
    }

    /// Whether `key`, from [`BoxHits::keys`], is still in the range.
    pub(crate) fn is_within(&self, key: Key) -> bool {
        key & !LOW_BITS <= ordered((self.max_t as f32).next_up())
    }
}

/// Maps `x` to an integer so that the order is kept, also for negative numbers.
fn ordered(x: f32) -> u32 {
    let bits = x.to_bits();
    if x.is_sign_negative() {
        !bits
    } else {
        bits | 1 << 31
    }
}
// END SOLUTION(part6.task1)
