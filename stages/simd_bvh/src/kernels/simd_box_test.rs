//! Tests a ray against the eight boxes of a node at once.

use crate::kernels::fused::mul_add;
use crate::kernels::ray_in_tree::RayInTree;
use crate::layout::LANES;
use crate::layout::node::{Node, Side, order_along};
use fearless_simd::{Simd, f32x4, f32x8, f64x4, i32x8, prelude::*, u8x32, u32x8};
use kit::Vec3;

/// The `t` at which a ray enters a box, as the bits of a number that is not negative: they have the
/// same order.
pub(crate) type Key = u32;

/// Tests eight boxes at once in single precision, for rays of ordinary size.
///
/// The ray crosses a plane at `b` at `t = (b - o)/d`. Here this is `b·i + c` with one rounding,
/// where `i = 1/d` is rounded and `c = -o·i` is rounded down for the entry and up for the exit. So
/// the only error is relative to `t`: 2⁻²³ from `i` and 2⁻²⁴ from the sum. [`SLACK`] covers it,
/// however far the origin is from the box and the box from 0.
///
/// A group of rays keeps its tests small, with numbers of type `f32`. A single ray has them in all
/// lanes, so that operations can read them from memory.
#[derive(Clone, Debug, Default)]
#[repr(C, align(32))]
pub(crate) struct SimdBoxTest<N = f32> {
    lines: Lines<N>,
    /// The bits of the start of the range, moved down. It is not negative.
    min_t: Key,
    /// The order of the children, and which of its bytes go where: the farthest child first.
    order: usize,
    places: [u8; 32],
}

/// Children of a node whose boxes a ray hits: the first `count` lanes.
pub(crate) struct BoxHits<S: Simd> {
    pub(crate) keys: u32x8<S>,
    pub(crate) children: u32x8<S>,
    pub(crate) count: usize,
}

/// For each axis the `t` at which the ray crosses planes at `b`: `b·slope + entering` for those by
/// which it enters boxes, `b·slope + leaving` for those by which it leaves.
#[derive(Clone, Debug, Default)]
#[repr(C)]
struct Lines<N> {
    slope: [N; 3],
    entering: [N; 3],
    leaving: [N; 3],
    first: [Side; 3],
    last: [Side; 3],
}

/// A number for all lanes.
pub(crate) trait Splat {
    fn splat<S: Simd>(&self, simd: S) -> f32x8<S>;
}

impl Splat for f32 {
    #[inline(always)]
    fn splat<S: Simd>(&self, simd: S) -> f32x8<S> {
        f32x8::splat(simd, *self)
    }
}

impl Splat for [f32; LANES] {
    #[inline(always)]
    fn splat<S: Simd>(&self, simd: S) -> f32x8<S> {
        f32x8::load_array_ref(simd, self)
    }
}

impl<N: Splat> Lines<N> {
    /// The bits of the `t` at which the ray enters and leaves the eight slabs of an axis, as signed
    /// integers.
    #[inline(always)]
    fn at<S: Simd>(&self, simd: S, node: &Node, axis: usize) -> [i32x8<S>; 2] {
        let slope = self.slope[axis].splat(simd);
        let first = f32x8::load_array_ref(simd, node.planes(axis, self.first[axis]));
        let last = f32x8::load_array_ref(simd, node.planes(axis, self.last[axis]));
        let entering = self.entering[axis].splat(simd);
        let leaving = self.leaving[axis].splat(simd);
        [
            mul_add(simd, first, slope, entering).bitcast(),
            mul_add(simd, last, slope, leaving).bitcast(),
        ]
    }
}

/// Added to the bits of exits. One enlarges a number by at least 2⁻²⁴ of its size, so this is more
/// than twice the error of two planes.
const SLACK: i32 = 16;

/// Factor by which ends of ranges are enlarged, as much as exits.
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

impl SimdBoxTest {
    #[inline(always)]
    pub(crate) fn new<S: Simd>(simd: S, ray: &RayInTree) -> SimdBoxTest {
        let (order, is_reversed) = order_along(ray.d);
        let d = rounded(simd, ray.d);
        let inverse = 1.0 / d.abs().max(SLOWEST).copysign(d);
        let o = rounded(simd, ray.o);
        // Four times the rounding error of the origin, because the sum and the product below round,
        // too. It does not depend on the inverse, so it does not wait for the division.
        let error = (o.abs() * (2.0 * f32::EPSILON)).copysign(d);
        let absolute = f32x4::splat(simd, ABSOLUTE);
        let entering = mul_add(simd, -o - error, inverse, -absolute);
        let leaving = mul_add(simd, error - o, inverse, absolute);
        let [x, y, z] = [
            Side::crossed(ray.d.x),
            Side::crossed(ray.d.y),
            Side::crossed(ray.d.z),
        ];
        SimdBoxTest {
            lines: Lines {
                slope: first_three(inverse),
                entering: first_three(entering),
                leaving: first_three(leaving),
                first: [x[0], y[0], z[0]],
                last: [x[1], y[1], z[1]],
            },
            // No part of the tree has a negative `t`. The sum with 0 is not -0.
            min_t: (ray.min_t.max(0.0) as f32 * (1.0 / RELATIVE) + 0.0).to_bits(),
            order,
            places: PLACES[usize::from(is_reversed)],
        }
    }

    /// The same test with its numbers in all lanes.
    #[inline(always)]
    pub(crate) fn widened<S: Simd>(&self, simd: S) -> SimdBoxTest<[f32; LANES]> {
        let Lines {
            slope,
            entering,
            leaving,
            first,
            last,
        } = self.lines;
        SimdBoxTest {
            lines: Lines {
                slope: in_all_lanes(simd, slope),
                entering: in_all_lanes(simd, entering),
                leaving: in_all_lanes(simd, leaving),
                first,
                last,
            },
            min_t: self.min_t,
            order: self.order,
            places: self.places,
        }
    }
}

impl<N: Splat> SimdBoxTest<N> {
    /// The children of `node` whose boxes the ray hits before `end`, a [`range_end`], the nearest
    /// last.
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(&self, simd: S, node: &Node, end: Key) -> BoxHits<S> {
        // The bits of two numbers compare like the numbers unless both are negative. The smallest
        // `t` is not negative, so the latest entry is right, and an exit before it is right or
        // negative. Comparing integers takes a cycle, comparing numbers four.
        let [x, y, z] = [
            self.lines.at(simd, node, 0),
            self.lines.at(simd, node, 1),
            self.lines.at(simd, node, 2),
        ];
        let entry = x[0].max(y[0]).max(z[0].max(self.min_t as i32));
        let exit = x[1].min(y[1]).min(z[1].min(end as i32)) + SLACK;
        // Every lane of an order is one byte: the first of the four bytes of a number.
        let order = f64x4::splat(
            simd,
            f64::from_bits(u64::from_le_bytes(node.orders[self.order & 3])),
        );
        let order = order.bitcast::<u8x32<S>>();
        let order = order.swizzle_dyn_within_blocks(u8x32::load_array_ref(simd, &self.places))
            | u8x32::load_array_ref(simd, &BYTES);
        let (entry, exit) = (entry.swizzle_dyn(order), exit.swizzle_dyn(order));
        let children = u32x8::load_array_ref(simd, &node.children).swizzle_dyn(order);
        let hit = entry.simd_le(exit);
        BoxHits {
            keys: entry.bitcast::<u32x8<S>>().compress(hit),
            children: children.compress(hit),
            count: hit.to_bitmask().count_ones() as usize,
        }
    }
}

/// The bits of the end of the range up to `max_t` of the local ray, enlarged. It is not negative.
#[inline(always)]
pub(crate) fn range_end(max_t: f32) -> Key {
    let end = max_t.min(END) * (RELATIVE * RELATIVE) + ABSOLUTE;
    // The bits of a negative number, or of -0, are a negative integer.
    (end.to_bits() as i32).max(0) as Key
}

#[inline(always)]
fn in_all_lanes<S: Simd>(simd: S, [x, y, z]: [f32; 3]) -> [[f32; LANES]; 3] {
    [
        f32x8::splat(simd, x).to_array(),
        f32x8::splat(simd, y).to_array(),
        f32x8::splat(simd, z).to_array(),
    ]
}

#[inline(always)]
fn first_three<S: Simd>(v: f32x4<S>) -> [f32; 3] {
    let [x, y, z, _] = v.to_array();
    [x, y, z]
}

/// A vector in single precision, with a 0 behind it.
#[inline(always)]
fn rounded<S: Simd>(simd: S, v: Vec3) -> f32x4<S> {
    f32x4::load_array(simd, [v.x as f32, v.y as f32, v.z as f32, 0.0])
}

/// Which of the eight bytes of an order become which numbers, from the farthest child to the
/// nearest: for an order from near to far, and for a reversed one.
const PLACES: [[u8; 4 * LANES]; 2] = [places(true), places(false)];

const fn places(reversed: bool) -> [u8; 4 * LANES] {
    let mut places = [0; 4 * LANES];
    let mut i = 0;
    while i < places.len() {
        let place = i / 4;
        places[i] = if reversed { LANES - 1 - place } else { place } as u8;
        i += 1;
    }
    places
}

/// The number of each byte in its lane.
const BYTES: [u8; 4 * LANES] = {
    let mut bytes = [0; 4 * LANES];
    let mut i = 0;
    while i < bytes.len() {
        bytes[i] = (i % 4) as u8;
        i += 1;
    }
    bytes
};
