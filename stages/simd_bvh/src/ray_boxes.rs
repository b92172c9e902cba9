// BEGIN SOLUTION(part6.task1)
//! A ray against the eight boxes of a node.

use crate::node::Node;
use fearless_simd::{Simd, f32x8, prelude::*, u32x8};
use kit::{Ray, Vec3};

/// The boxes of a node that a ray meets.
pub(crate) struct Met {
    /// One bit a lane.
    pub(crate) lanes: u32,
    /// For these lanes: numbers that are in the order of the rays' entries, none later than the entry really is.
    pub(crate) entries: [u32; 8],
}

/// Boxes met by one ray. What it says is never a false miss, for any hit that a primitive below may have.
pub(crate) trait Boxes {
    /// The boxes of `node` that the ray meets within its range.
    fn meet(&self, node: &Node) -> Met;

    /// Nothing beyond `max_t` counts any more.
    fn shorten(&mut self, max_t: f64);

    /// Whether a box that was entered at `entry` is still within the range.
    fn is_within(&self, entry: u32) -> bool;
}

/// All eight lanes at once, in single precision, for rays of ordinary sizes.
///
/// A plane at `b` is crossed at `t = (b - o)/d`. Here that is `b·i + c` in one rounding, with `i = 1/d` rounded and
/// `c = -o·i` rounded down where the ray enters and up where it leaves. So the only error is relative to `t`: 2⁻²⁴ from `i` and
/// from the sum. [`RELATIVE`] takes it up, however far the origin is from the box and the box from 0.
pub(crate) struct Lanes<S: Simd> {
    /// By axis.
    slabs: [Slabs<S>; 3],
    min_t: f32x8<S>,
    max_t: f32x8<S>,
    relative: f32x8<S>,
    absolute: f32x8<S>,
    end: u32,
}

/// The boxes' two planes across one axis.
struct Slabs<S: Simd> {
    /// Which of the two the ray crosses first: 0 for the lower one.
    first: usize,
    inverse: f32x8<S>,
    entering: f32x8<S>,
    leaving: f32x8<S>,
}

impl<S: Simd> Slabs<S> {
    #[inline(always)]
    fn new(simd: S, o: f64, inverse: f32) -> Slabs<S> {
        let offset = (-o * f64::from(inverse)) as f32;
        // Two units in the last place: more than the conversion's rounding.
        let margin = 2.0 * f32::EPSILON * offset.abs() + ABSOLUTE;
        Slabs {
            first: usize::from(inverse < 0.0),
            inverse: f32x8::splat(simd, inverse),
            entering: f32x8::splat(simd, offset - margin),
            leaving: f32x8::splat(simd, offset + margin),
        }
    }

    #[inline(always)]
    fn enter(&self, node: &Node, axis: usize) -> f32x8<S> {
        let planes = f32x8::load_array_ref(self.inverse.token(), &node.planes[axis][self.first]);
        planes.mul_add_precise(self.inverse, self.entering)
    }

    #[inline(always)]
    fn leave(&self, node: &Node, axis: usize) -> f32x8<S> {
        let planes = &node.planes[axis][1 - self.first];
        let planes = f32x8::load_array_ref(self.inverse.token(), planes);
        planes.mul_add_precise(self.inverse, self.leaving)
    }
}

/// Exits and ends are this much later than computed: four times the error of two crossings.
const RELATIVE: f32 = 1.0 + 1.0 / (1 << 20) as f32;

/// And by this, where numbers are too small to have 24 digits.
const ABSOLUTE: f32 = 1e-36;

/// Coordinates and directions between the inverse of this and this can be multiplied in single precision.
const LARGEST: f64 = 1e18;

impl<S: Simd> Lanes<S> {
    /// `None` for rays that this is not for: along an axis, of extreme size, or that look behind their origin.
    #[inline(always)]
    pub(crate) fn new(simd: S, ray: &Ray) -> Option<Lanes<S>> {
        let inverse = 1.0 / ray.d;
        let size = inverse.abs();
        let is_ordinary = size.max_element() < LARGEST
            && size.min_element() > 1.0 / LARGEST
            && ray.o.abs().max_element() < LARGEST
            && ray.min_t >= 0.0
            // A NaN is no larger and no smaller than anything.
            && !(ray.o.is_nan() || inverse.is_nan() || ray.max_t.is_nan());
        if !is_ordinary {
            return None;
        }
        let (x, y, z) = (
            Slabs::new(simd, ray.o.x, inverse.x as f32),
            Slabs::new(simd, ray.o.y, inverse.y as f32),
            Slabs::new(simd, ray.o.z, inverse.z as f32),
        );
        let mut lanes = Lanes {
            slabs: [x, y, z],
            min_t: f32x8::splat(simd, (ray.min_t as f32) / RELATIVE),
            max_t: f32x8::splat(simd, 0.0),
            relative: f32x8::splat(simd, RELATIVE),
            absolute: f32x8::splat(simd, ABSOLUTE),
            end: 0,
        };
        lanes.shorten(ray.max_t);
        Some(lanes)
    }
}

impl<S: Simd> Boxes for Lanes<S> {
    #[inline(always)]
    fn meet(&self, node: &Node) -> Met {
        let [x, y, z] = &self.slabs;
        let entry = x.enter(node, 0).max(y.enter(node, 1));
        let entry = entry.max(z.enter(node, 2).max(self.min_t));
        let exit = x.leave(node, 0).min(y.leave(node, 1));
        let exit = exit.min(z.leave(node, 2).min(self.max_t));
        let exit = exit.mul_add_precise(self.relative, self.absolute);
        Met {
            lanes: entry.simd_le(exit).to_bitmask() as u32,
            // Not negative, so their bits are in the same order as they are.
            entries: entry.bitcast::<u32x8<S>>().to_array(),
        }
    }

    #[inline(always)]
    fn shorten(&mut self, max_t: f64) {
        let end = (max_t as f32) * RELATIVE + ABSOLUTE;
        self.max_t = f32x8::splat(self.min_t.token(), end);
        self.end = if end >= 0.0 { end.to_bits() } else { 0 };
    }

    #[inline(always)]
    fn is_within(&self, entry: u32) -> bool {
        entry <= self.end
    }
}

/// One box after the other, in double precision, for every ray: the plain twin.
pub(crate) struct Plain {
    ray: Ray,
}

/// The range and the exits are widened by so much: more than the rounding errors of a crossing and of any hit's `t`.
const SLACK: f64 = 64.0 * f64::EPSILON;

impl Plain {
    pub(crate) fn new(ray: &Ray) -> Plain {
        let min_t = ray.min_t - SLACK * ray.min_t.abs();
        Plain {
            ray: Ray { min_t, ..*ray },
        }
    }

    /// Where the ray enters the box from `min` to `max`, if it does. A slab is divided by a direction of 0, too: the
    /// quotient is infinite, or NaN for a ray in the plane, which is passed over.
    fn entry(&self, min: Vec3, max: Vec3) -> Option<f64> {
        let Ray { o, d, min_t, max_t } = self.ray;
        let (mut entry, mut exit) = (min_t, max_t);
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

impl Boxes for Plain {
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
        self.ray.max_t = max_t;
    }

    fn is_within(&self, entry: u32) -> bool {
        entry <= ordered((self.ray.max_t as f32).next_up())
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
