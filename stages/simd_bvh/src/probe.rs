// BEGIN SOLUTION(part6.task1)
//! What the walk asks about a ray: which boxes of a node it meets.

use crate::node::Node;
use crate::space::{LocalRay, Space};
use kit::{Ray, Vec3};

/// The boxes of a node that a ray meets.
pub(crate) struct Met {
    /// One bit a lane.
    pub(crate) lanes: u32,
    /// For these lanes: numbers that are in the order of the rays' entries, none later than the entry really is.
    pub(crate) entries: [u32; 8],
}

/// One ray, in the tree's space. What it says is never a false miss, for any hit that a primitive may have.
pub(crate) trait Probe {
    /// The boxes of `node` that the ray meets within its range.
    fn meet(&self, node: &Node) -> Met;

    /// Nothing beyond `max_t` of the world's ray counts any more.
    fn shorten(&mut self, max_t: f64);

    /// Whether a box that was entered at `entry` is still within the range.
    fn is_within(&self, entry: u32) -> bool;
}

/// One box after the other, in double precision, for every ray: the plain twin.
pub(crate) struct Plain {
    /// Its coordinates are finite, or all NaN: then all boxes are met.
    local: LocalRay,
    min_t: f64,
    max_t: f64,
}

/// The range and the exits are widened by so much: more than the rounding errors of a crossing and of any hit's `t`.
const SLACK: f64 = 64.0 * f64::EPSILON;

impl Plain {
    /// Few rays come here, and the others need not get ready for it.
    #[cold]
    #[inline(never)]
    pub(crate) fn new(ray: &Ray, space: &Space) -> Plain {
        let mut local = space.ray(ray);
        if !(local.o.is_finite() && local.d.is_finite()) {
            (local.o, local.d) = (Vec3::NAN, Vec3::NAN);
        }
        let min_t = ray.min_t * local.speed;
        let mut plain = Plain {
            local,
            // The smaller one also for a range that is not a number: nothing is hit, whatever is met.
            min_t: f64::NEG_INFINITY.max(min_t - SLACK * min_t.abs()),
            max_t: 0.0,
        };
        if plain.min_t == f64::INFINITY {
            plain.min_t = f64::NEG_INFINITY;
        }
        plain.shorten(ray.max_t);
        plain
    }

    /// Where the ray enters the box from `min` to `max`, if it does. A slab is divided by a direction of 0, too: the
    /// quotient is infinite, or NaN for a ray in the plane, which is passed over.
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

impl Probe for Plain {
    fn meet(&self, node: &Node) -> Met {
        let mut met = Met {
            lanes: 0,
            entries: [0; 8],
        };
        for lane in 0..node.count as usize {
            let bounds = node.bounds(lane);
            if let Some(entry) = self.entry(bounds.min, bounds.max) {
                met.lanes |= 1 << lane;
                met.entries[lane] = ordered((entry as f32).next_down());
            }
        }
        met
    }

    fn shorten(&mut self, max_t: f64) {
        self.max_t = max_t * self.local.speed;
        if self.max_t.is_nan() {
            self.max_t = f64::INFINITY;
        }
    }

    fn is_within(&self, entry: u32) -> bool {
        entry <= ordered((self.max_t as f32).next_up())
    }
}

/// The bits of `x`, made such that larger numbers have larger bits, negative ones, too.
fn ordered(x: f32) -> u32 {
    let bits = x.to_bits();
    if x.is_sign_negative() {
        !bits
    } else {
        bits | 1 << 31
    }
}
// END SOLUTION(part6.task1)
