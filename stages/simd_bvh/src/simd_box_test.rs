// BEGIN SOLUTION(part6.task1)
//! Tests a ray against the eight boxes of a node at once.

use crate::box_test::{BoxHits, BoxTest};
use crate::node::Node;
use crate::space::{LocalRay, ORDINARY, TreeSpace};
use fearless_simd::{Simd, f32x8, prelude::*, u32x8};
use kit::Ray;

/// Tests eight boxes at once in single precision, for rays of ordinary size.
///
/// The ray crosses a plane at `b` at `t = (b - o)/d`. Here this is `b·i + c` with one rounding,
/// where `i = 1/d` is rounded and `c = -o·i` is rounded down for the entry and up for the exit. So
/// the only error is relative to `t`: 2⁻²³ from `i` and 2⁻²⁴ from the sum. [`RELATIVE`] covers it,
/// however far the origin is from the box and the box from 0.
pub(crate) struct SimdBoxTest<S: Simd> {
    simd: S,
    /// A point at `t` on the world's ray is at `t·speed` on the local ray.
    speed: f64,
    /// One for each axis.
    slabs: [Slabs; 3],
    min_t: f32,
    /// The end of the range and its bits.
    max_t: f32,
    end: u32,
}

/// How the ray crosses the planes of one axis. The fields are scalars: broadcasting them from
/// memory costs nothing.
struct Slabs {
    /// The plane that the ray crosses first: 0 for the lower one, 1 for the upper one.
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
        // Two units in the last place: more than the rounding errors of the origin and the product.
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

/// Factor by which exits and ends of ranges are enlarged: more than twice the error of two planes.
const RELATIVE: f32 = 1.0 + 1.0 / (1 << 20) as f32;

/// Added as well, for numbers too small to have 24 bits.
const ABSOLUTE: f32 = 1e-36;

/// The largest distance of a ray origin, in the tree's space.
const FARTHEST: f64 = (1 << 18) as f64;

/// The largest `t` of a hit: the scene has a size of about 1, and no direction is shorter than a
/// tenth.
const END: f64 = (1 << 22) as f64;

/// The smallest absolute value of a direction component; smaller ones are replaced by it, so that
/// no division is by 0. Up to [`END`] this moves a ray by less than half the margin of the boxes,
/// so it hits the same boxes.
const SLOWEST: f32 = 1.0 / (1_u128 << 84) as f32;

impl<S: Simd> SimdBoxTest<S> {
    /// `None` for rays of extreme size, from very far away or with a negative `min_t`.
    #[inline(always)]
    pub(crate) fn new(simd: S, ray: &Ray, space: &TreeSpace) -> Option<SimdBoxTest<S>> {
        let LocalRay { o, d, speed } = space.ray(ray);
        // Every comparison with NaN is false.
        let is_ordinary = ORDINARY.contains(&d.abs().element_sum())
            && o.abs().element_sum() < FARTHEST
            && ray.min_t >= 0.0
            && !ray.max_t.is_nan();
        if !is_ordinary {
            return None;
        }
        let min_t = (ray.min_t * speed) as f32 * (1.0 / RELATIVE);
        let mut test = SimdBoxTest {
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
        test.shorten(ray.max_t);
        Some(test)
    }
}

impl<S: Simd> BoxTest for SimdBoxTest<S> {
    #[inline(always)]
    fn test(&self, node: &Node) -> BoxHits {
        let simd = self.simd;
        let [x, y, z] = &self.slabs;
        let entry = x.enter(simd, node, 0).max(y.enter(simd, node, 1));
        let entry = entry.max(z.enter(simd, node, 2).max(self.min_t));
        let exit = x.leave(simd, node, 0).min(y.leave(simd, node, 1));
        let exit = exit.min(z.leave(simd, node, 2).min(self.max_t));
        let exit = exit.mul_add_precise(RELATIVE, ABSOLUTE);
        BoxHits {
            lanes: entry.simd_le(exit).to_bitmask() as u32,
            // The entries are not negative, so their bits have the same order.
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
