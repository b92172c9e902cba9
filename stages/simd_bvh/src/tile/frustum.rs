//! The region of all rays of a tile, and the boxes that are outside of it.
//!
//! # Why no box that a ray hits is outside
//!
//! Let `w` be the axis along which the rays advance most, `u` and `v` the others, and `s` the sign
//! of the advance. At depth `h = s·(p.w - o.w)` a ray is at `p.u = o.u + σ·h`, where its slope `σ`
//! is between the least slope `σ₀` and the greatest `σ₁`. A box from `lo` to `hi` with depths from
//! `near` to `far` contains such a point only if `lo.u - o.u <= σ₁·far` (`σ₁·near` if `σ₁` is
//! negative) and `hi.u - o.u >= σ₀·near` (`σ₀·far` if `σ₀` is negative), and the same for `v`. A
//! depth is `s·(W - o.w)` for a plane `W` of the box, so each condition is
//! `plane - k·W <= c` or `>= c` with `k = s·σ` and `c = o.u - k·o.w`.
//!
//! Errors: with `e = 2⁻²⁴`, slopes of at most 2.1 and coordinates of the tree of at most `size`, the
//! left side has at most `e·2.1·size` from rounding `k` and `e·3.1·size` from the operation; `c` has
//! `e·3.1·|o|`. [`SLACK`]`·(size + |o|)` is more than three times the sum, and also covers the
//! margin by which a kernel may report hits beside a primitive. Slopes are computed with three
//! roundings and that of two components, less than `5e·2.1`; [`SLOPE_MARGIN`] is twice as much.

use crate::kernels::fused::mul_add;
use crate::layout::LANES;
use crate::layout::node::{Node, Side, order_along};
use fearless_simd::{Simd, f32x8, prelude::*};
use kit::Vec3;

/// The largest slope of a ray in a tile.
pub(crate) const MAX_SLOPE: f32 = 2.0;

/// At least the error of a slope.
const SLOPE_MARGIN: f32 = 1.0 / (1 << 19) as f32;

/// At least the error of a distance, as a share of the coordinates.
const SLACK: f64 = 1.0 / (1 << 19) as f64;

/// Factor by which the end of the rays' depth is enlarged.
pub(crate) const RELATIVE: f32 = 1.0 + 1.0 / (1 << 20) as f32;

/// The region of all rays.
#[derive(Clone, Debug)]
pub(crate) struct Frustum {
    /// The axes `u`, `v` and `w`.
    pub(crate) axes: [usize; 3],
    /// The sign of the directions along `w`.
    sign: f32,
    /// The least and the greatest slope along `u` and `v`, with their margins.
    slopes: [[f32; 2]; 2],
    /// The apex in the tree's space.
    pub(crate) apex: Vec3,
    /// At least the error of coordinates relative to the apex.
    pub(crate) slack: f32,
    /// For `u` and `v` the conditions for the lower and the upper plane.
    conditions: [[Condition; 2]; 2],
    /// By which planes the rays enter and leave boxes along `w`.
    crossed: [Side; 2],
    order: (usize, bool),
}

/// A bound of `plane - slope·W`, where `W` is the plane `side` of a box along `w`.
#[derive(Clone, Copy, Debug, Default)]
struct Condition {
    slope: f32,
    side: Side,
    bound: f32,
}

impl Frustum {
    /// The frustum of rays from `apex` with slopes between `slopes`; `first` is the direction of one
    /// of them.
    #[inline(always)]
    pub(crate) fn new(
        axes: [usize; 3],
        first: Vec3,
        slopes: [[f32; 2]; 2],
        apex: Vec3,
        size: f64,
    ) -> Frustum {
        let [u, v, w] = axes;
        let o = apex.to_array();
        let sign = 1.0_f64.copysign(first[w]);
        let slack = SLACK * (apex.abs().element_sum() + size);
        let crossed = Side::crossed(sign);
        let mut frustum = Frustum {
            axes,
            sign: sign as f32,
            slopes,
            apex,
            slack: slack as f32,
            conditions: [[Condition::default(); 2]; 2],
            crossed,
            order: order_along(first),
        };
        for (side, axis) in [u, v].into_iter().enumerate() {
            let [least, greatest] = &mut frustum.slopes[side];
            *least -= SLOPE_MARGIN;
            *greatest += SLOPE_MARGIN;
            let [near, far] = crossed;
            let pairs = [
                (*greatest, slack, [near, far]),
                (*least, -slack, [far, near]),
            ];
            for (condition, (slope, slack, sides)) in frustum.conditions[side].iter_mut().zip(pairs)
            {
                let k = f64::from(slope) * sign;
                *condition = Condition {
                    slope: k as f32,
                    side: sides[usize::from(slope >= 0.0)],
                    bound: (o[axis] - k * o[w] + slack) as f32,
                };
            }
        }
        frustum
    }

    /// The depths at which the boxes of `node` begin, and one bit for each that may contain a point
    /// of a ray at a depth of at most `end`. Lanes without a child have any bit.
    #[inline(always)]
    pub(crate) fn boxes<S: Simd>(&self, simd: S, node: &Node, end: f32) -> ([f32; LANES], u32) {
        let [u, v, w] = self.axes;
        let at = self.apex.to_array()[w] as f32 * self.sign;
        let planes = |axis, side| f32x8::load_array_ref(simd, node.planes(axis, side));
        let near = planes(w, self.crossed[0]) * self.sign - (at + self.slack);
        let far = planes(w, self.crossed[1]) * self.sign - (at - self.slack);
        let mut outside = far.simd_lt(0.0) | near.simd_gt(end);
        for (conditions, axis) in self.conditions.iter().zip([u, v]) {
            let [lower, upper] = conditions;
            let distance = mul_add(
                simd,
                planes(w, lower.side),
                -lower.slope,
                planes(axis, Side::Lower),
            );
            outside |= distance.simd_gt(lower.bound);
            let distance = mul_add(
                simd,
                planes(w, upper.side),
                -upper.slope,
                planes(axis, Side::Upper),
            );
            outside |= distance.simd_lt(upper.bound);
        }
        (near.to_array(), !outside.to_bitmask() as u32)
    }

    /// The lanes of `node` from the farthest child to the nearest.
    #[inline(always)]
    pub(crate) fn far_to_near(&self, node: &Node) -> [usize; LANES] {
        let (order, is_reversed) = self.order;
        let bytes = u64::from_le_bytes(node.orders[order & 3]);
        let bytes = if is_reversed {
            bytes
        } else {
            bytes.swap_bytes()
        };
        bytes
            .to_le_bytes()
            .map(|byte| usize::from(byte / 4) & (LANES - 1))
    }

    /// Directions between which those of all rays are, up to a positive factor.
    #[inline(always)]
    pub(crate) fn corners(&self) -> [[f32; 3]; 4] {
        let [u, v, w] = self.axes;
        let mut corners = [[self.sign; 3]; 4];
        for (i, corner) in corners.iter_mut().enumerate() {
            corner[w] = self.sign;
            corner[u] = self.slopes[0][i & 1];
            corner[v] = self.slopes[1][i >> 1];
        }
        corners
    }
}
