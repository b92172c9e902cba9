// BEGIN SOLUTION(part6.task1)
//! Tests a ray against the eight boxes of a node at once.

use crate::box_test::{BoxHits, Key, LOW_BITS};
use crate::node::Node;
use crate::ray_in_tree::RayInTree;
use crate::sah::LANES;
use fearless_simd::{Simd, f32x8, prelude::*, u32x8};

/// Tests eight boxes at once in single precision, for rays of ordinary size.
///
/// The ray crosses a plane at `b` at `t = (b - o)/d`. Here this is `b·i + c` with one rounding,
/// where `i = 1/d` is rounded and `c = -o·i` is rounded down for the entry and up for the exit. So
/// the only error is relative to `t`: 2⁻²³ from `i` and 2⁻²⁴ from the sum. [`RELATIVE`] covers it,
/// however far the origin is from the box and the box from 0.
pub(crate) struct SimdBoxTest<S: Simd> {
    simd: S,
    /// One for each axis.
    slabs: [Slabs; 3],
    min_t: f32,
    /// The end of the range, enlarged, and its bits.
    max_t: f32,
    end: u32,
}

/// How the ray crosses the planes of one axis. The fields are scalars: broadcasting them from
/// memory costs nothing.
struct Slabs {
    /// The plane that the ray crosses first: 0 for the lower one, 1 for the upper one.
    first: usize,
    entering: Line,
    leaving: Line,
}

/// `t = b·slope + start` for a plane at `b`.
struct Line {
    slope: f32,
    start: f32,
}

impl Slabs {
    #[inline(always)]
    fn new(o: f64, d: f64) -> Slabs {
        let (o, d) = (o as f32, d as f32);
        let inverse = 1.0 / d.abs().max(SLOWEST).copysign(d);
        // The exits are enlarged.
        let outwards = inverse * RELATIVE;
        let (offset, outer_offset) = (-o * inverse, -o * outwards);
        // Two units in the last place: more than the rounding errors of the origin and the product.
        let margin = |offset: f32| 2.0 * f32::EPSILON * offset.abs() + ABSOLUTE;
        Slabs {
            first: usize::from(inverse < 0.0),
            entering: Line {
                slope: inverse,
                start: offset - margin(offset),
            },
            leaving: Line {
                slope: outwards,
                start: outer_offset + margin(outer_offset),
            },
        }
    }

    #[inline(always)]
    fn enter<S: Simd>(&self, simd: S, node: &Node, axis: usize) -> f32x8<S> {
        let planes = f32x8::load_array_ref(simd, &node.planes[axis][self.first & 1]);
        planes.mul_add_precise(self.entering.slope, self.entering.start)
    }

    #[inline(always)]
    fn leave<S: Simd>(&self, simd: S, node: &Node, axis: usize) -> f32x8<S> {
        let planes = f32x8::load_array_ref(simd, &node.planes[axis][(1 - self.first) & 1]);
        planes.mul_add_precise(self.leaving.slope, self.leaving.start)
    }
}

/// Factor by which exits and ends of ranges are enlarged: more than twice the error of two planes.
const RELATIVE: f32 = 1.0 + 1.0 / (1 << 20) as f32;

/// Added as well, for numbers too small to have 24 bits.
const ABSOLUTE: f32 = 1e-36;

/// The largest `t` of a hit: the scene has a size of about 1, and no direction is shorter than a
/// tenth.
const END: f32 = (1 << 22) as f32;

/// The smallest absolute value of a direction component; smaller ones are replaced by it, so that
/// no division is by 0. Up to [`END`] this moves a ray by less than half the margin of the boxes,
/// so it hits the same boxes.
const SLOWEST: f32 = 1.0 / (1_u128 << 84) as f32;

impl<S: Simd> SimdBoxTest<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, ray: &RayInTree) -> SimdBoxTest<S> {
        let (o, d) = (ray.o, ray.d);
        SimdBoxTest {
            simd,
            slabs: [
                Slabs::new(o.x, d.x),
                Slabs::new(o.y, d.y),
                Slabs::new(o.z, d.z),
            ],
            // No part of the tree has a negative `t`.
            min_t: ray.min_t.max(0.0) as f32 * (1.0 / RELATIVE),
            max_t: 0.0,
            end: 0,
        }
    }

    /// Shortens the range to `max_t` of the local ray.
    #[inline(always)]
    pub(crate) fn shorten(&mut self, max_t: f32) {
        self.max_t = max_t.min(END) * (RELATIVE * RELATIVE) + ABSOLUTE;
        self.end = self.max_t.max(0.0).to_bits();
    }

    /// The boxes of `node` that the ray hits in its range.
    #[inline(always)]
    pub(crate) fn test(&self, node: &Node) -> BoxHits {
        let simd = self.simd;
        let [x, y, z] = &self.slabs;
        let entry = x.enter(simd, node, 0).max(y.enter(simd, node, 1));
        let entry = entry.max(z.enter(simd, node, 2).max(self.min_t));
        let exit = x.leave(simd, node, 0).min(y.leave(simd, node, 1));
        let exit = exit.min(z.leave(simd, node, 2).min(self.max_t));
        let hit = entry.simd_le(exit);
        // The entries are not negative, so their bits have the same order.
        let keys =
            entry.bitcast::<u32x8<S>>() & !LOW_BITS | u32x8::load_array_ref(simd, &LANE_KEYS);
        BoxHits {
            lanes: hit.to_bitmask() as u32,
            keys: keys.compress(hit).to_array(),
        }
    }

    /// Whether `key`, from [`BoxHits::keys`], is still in the range.
    #[inline(always)]
    pub(crate) fn is_within(&self, key: Key) -> bool {
        key & !LOW_BITS <= self.end
    }
}

/// The low bits of the keys.
const LANE_KEYS: [Key; LANES] = [8, 9, 10, 11, 12, 13, 14, 15];
// END SOLUTION(part6.task1)
