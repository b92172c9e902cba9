// BEGIN SOLUTION(part6.task1)
//! A ray against the eight boxes of a node at once.

use crate::node::Node;
use crate::probe::{Met, Probe};
use crate::space::{LocalRay, ORDINARY, Space};
use fearless_simd::{Simd, f32x8, prelude::*, u32x8};
use kit::Ray;

/// All eight lanes at once, in single precision, for rays of ordinary sizes.
///
/// A plane at `b` is crossed at `t = (b - o)/d`. Here that is `b·i + c` in one rounding, with `i = 1/d` rounded and
/// `c = -o·i` rounded down where the ray enters and up where it leaves. So the only error is relative to `t`: 2⁻²³ from `i` and
/// 2⁻²⁴ from the sum. [`RELATIVE`] takes it up, however far the origin is from the box and the box from 0.
pub(crate) struct Lanes<S: Simd> {
    simd: S,
    /// Here a point is at `t·speed`, where in the world it is at `t`.
    speed: f64,
    /// By axis.
    slabs: [Slabs; 3],
    min_t: f32,
    /// The end of the range, and its bits.
    max_t: f32,
    end: u32,
}

/// The boxes' two planes across one axis. Numbers are kept, not lanes of them: filling lanes from memory costs nothing,
/// and what is not asked need not be filled.
struct Slabs {
    /// Which of the two the ray crosses first: 0 for the lower one.
    first: usize,
    inverse: f32,
    entering: f32,
    leaving: f32,
}

impl Slabs {
    #[inline(always)]
    fn new(o: f64, d: f64) -> Slabs {
        let d = d as f32;
        let inverse = 1.0 / d.abs().max(SLOWEST).copysign(d);
        let offset = -(o as f32) * inverse;
        // Two units in the last place: more than the rounding of the origin and of the product.
        let margin = 2.0 * f32::EPSILON * offset.abs() + ABSOLUTE;
        Slabs {
            first: usize::from(inverse < 0.0),
            inverse,
            entering: offset - margin,
            leaving: offset + margin,
        }
    }

    #[inline(always)]
    fn enter<S: Simd>(&self, simd: S, node: &Node, axis: usize) -> f32x8<S> {
        let planes = f32x8::load_array_ref(simd, &node.planes[axis][self.first & 1]);
        planes.mul_add_precise(self.inverse, self.entering)
    }

    #[inline(always)]
    fn leave<S: Simd>(&self, simd: S, node: &Node, axis: usize) -> f32x8<S> {
        let planes = f32x8::load_array_ref(simd, &node.planes[axis][(1 - self.first) & 1]);
        planes.mul_add_precise(self.inverse, self.leaving)
    }
}

/// Exits and ends are this much later than computed: more than twice the error of two crossings.
const RELATIVE: f32 = 1.0 + 1.0 / (1 << 20) as f32;

/// And by this, where numbers are too small to have 24 digits.
const ABSOLUTE: f32 = 1e-36;

/// Rays come from no farther than this.
const FARTHEST: f64 = (1 << 18) as f64;

/// And meet nothing beyond this: the scene is about 1 in size, and no direction is shorter than a tenth.
const END: f64 = (1 << 22) as f64;

/// Components of a direction are at least this, in size. Before [`END`] a ray with a smaller one moves by less than half of
/// what boxes are widened by; so they meet the same ones, and nothing is divided by 0.
const SLOWEST: f32 = 1.0 / (1_u128 << 84) as f32;

impl<S: Simd> Lanes<S> {
    /// `None` for rays that this is not for: of extreme size, from very far away, or that look behind their origin.
    #[inline(always)]
    pub(crate) fn new(simd: S, ray: &Ray, space: &Space) -> Option<Lanes<S>> {
        let LocalRay { o, d, speed } = space.ray(ray);
        // A NaN is within no bounds.
        let is_ordinary = ORDINARY.contains(&d.abs().element_sum())
            && o.abs().element_sum() < FARTHEST
            && ray.min_t >= 0.0
            && !ray.max_t.is_nan();
        if !is_ordinary {
            return None;
        }
        let min_t = (ray.min_t * speed) as f32 * (1.0 / RELATIVE);
        let mut lanes = Lanes {
            simd,
            speed,
            slabs: [
                Slabs::new(o.x, d.x),
                Slabs::new(o.y, d.y),
                Slabs::new(o.z, d.z),
            ],
            min_t,
            max_t: 0.0,
            end: 0,
        };
        lanes.shorten(ray.max_t);
        Some(lanes)
    }
}

impl<S: Simd> Probe for Lanes<S> {
    #[inline(always)]
    fn meet(&self, node: &Node) -> Met {
        let simd = self.simd;
        let [x, y, z] = &self.slabs;
        let entry = x.enter(simd, node, 0).max(y.enter(simd, node, 1));
        let entry = entry.max(z.enter(simd, node, 2).max(self.min_t));
        let exit = x.leave(simd, node, 0).min(y.leave(simd, node, 1));
        let exit = exit.min(z.leave(simd, node, 2).min(self.max_t));
        let exit = exit.mul_add_precise(RELATIVE, ABSOLUTE);
        Met {
            lanes: entry.simd_le(exit).to_bitmask() as u32,
            // Not negative, so their bits are in the same order as they are.
            entries: entry.bitcast::<u32x8<S>>().to_array(),
        }
    }

    #[inline(always)]
    fn shorten(&mut self, max_t: f64) {
        self.max_t = (max_t * self.speed).min(END) as f32 * RELATIVE + ABSOLUTE;
        self.end = self.max_t.max(0.0).to_bits();
    }

    #[inline(always)]
    fn is_within(&self, entry: u32) -> bool {
        entry <= self.end
    }
}
// END SOLUTION(part6.task1)
