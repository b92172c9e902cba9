//! The rays of a tile in single precision, in columns, and what each has hit so far.

use super::frustum::{Frustum, MAX_SLOPE, RELATIVE};
use super::planes::TileBounds;
use super::{GROUP, SIZE};
use crate::kernels::found::Found;
use crate::kernels::ray_in_tree::{FARTHEST, LARGEST, noise_within};
use crate::kernels::woop::axes_along;
use crate::layout::space::{ORDINARY, TreeSpace};
use crate::ray_tile::{RayTile, TileEnds};
use crate::rounding::{at_least, at_most};
use fearless_simd::{Simd, f32x16, f64x8, mask32x16, prelude::*, u32x16};
use kit::{PrimId, Vec3};

/// Stands for no primitive, and for no hit.
pub(crate) const NONE: u32 = u32::MAX;

/// Up to 64 rays in the tree's space. Lanes without a ray have any numbers.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(crate) struct TileRays {
    pub(crate) d: [[f32; SIZE]; 3],
    /// `1/d`, finite.
    inverse: [[f32; SIZE]; 3],
    /// The absolute values of the components along the axis `w` of the frustum.
    depth: [f32; SIZE],
    /// At most the start of the range, and not negative.
    pub(crate) start: f32,
    /// At least the end of the range, up to the closest hit.
    pub(crate) end: [f32; SIZE],
    /// The closest hit that is certain and not computed yet: its triangle, the block and lane of the
    /// triangle, and the least `t` that it can have. [`NONE`] and ∞ without one.
    pub(crate) id: [u32; SIZE],
    pub(crate) place: [u32; SIZE],
    pub(crate) nearest: [f32; SIZE],
    /// The primitives that the rays cannot hit.
    pub(crate) skip: [u32; SIZE],
    /// The closest hits that are computed.
    pub(crate) found: [Found; SIZE],
}

impl Default for TileRays {
    fn default() -> TileRays {
        TileRays {
            d: [[0.0; SIZE]; 3],
            inverse: [[0.0; SIZE]; 3],
            depth: [0.0; SIZE],
            start: 0.0,
            end: [0.0; SIZE],
            id: [NONE; SIZE],
            place: [0; SIZE],
            nearest: [0.0; SIZE],
            skip: [NONE; SIZE],
            found: [Found::default(); SIZE],
        }
    }
}

/// The rays that are traced together, one bit each, and what they have in common.
pub(crate) struct Together {
    pub(crate) rays: u64,
    pub(crate) frustum: Frustum,
    pub(crate) bounds: TileBounds,
    /// At least the depth of every point of a ray.
    pub(crate) end: f32,
    /// The factor of [`Planes::outside`](super::planes::Planes::outside).
    pub(crate) corner_factor: f32,
}

/// The least absolute value of a component whose inverse is used. Smaller ones are replaced by it,
/// which moves a ray by far less than the slack of a box.
const SLOWEST: f32 = 1.0 / (1_u64 << 60) as f32;

/// The least component along `w`: with slopes of at most 2, that of an ordinary direction is at
/// least 1/20.
const LEAST_DEPTH: f32 = 1.0 / 32.0;

/// The first `SIZE` elements of a column, the first element in place of those that it does not
/// have.
#[inline(always)]
fn filled<'a>(column: &'a [f64], buffer: &'a mut [f64; SIZE]) -> &'a [f64; SIZE] {
    match column.first_chunk() {
        Some(all) => all,
        None => {
            buffer.fill(column[0]);
            buffer[..column.len()].copy_from_slice(column);
            buffer
        }
    }
}

/// Sixteen numbers of `column` from number `first`, times `factor`, in single precision.
#[inline(always)]
fn narrowed<S: Simd>(simd: S, column: &[f64; SIZE], first: usize, factor: f64) -> f32x16<S> {
    let low = f64x8::from_slice(simd, &column[first..first + GROUP / 2]);
    let high = f64x8::from_slice(simd, &column[first + GROUP / 2..first + GROUP]);
    (low * factor).narrow(high * factor)
}

impl TileRays {
    /// Prepares `rays`, at least one and at most 64. `None` if none of them can be traced together.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(
        &mut self,
        simd: S,
        rays: &RayTile,
        space: &TreeSpace,
    ) -> Option<Together> {
        let apex = space.point(rays.o);
        let distance = apex.abs().element_sum();
        // Every comparison with NaN is false.
        let is_ordinary = distance < FARTHEST && space.size <= LARGEST && rays.min_t >= 0.0;
        if !is_ordinary {
            return None;
        }
        let first = Vec3::new(rays.d[0][0], rays.d[1][0], rays.d[2][0]);
        let axes = axes_along(first);
        let sign = 1.0_f32.copysign(first[axes[2]] as f32);
        self.load_ends(simd, rays, space.scale);
        self.start = at_most(rays.min_t * space.scale).max(0.0);
        let mut buffers = [[0.0; SIZE]; 3];
        let [x, y, z] = &mut buffers;
        let columns = [
            filled(rays.d[0], x),
            filled(rays.d[1], y),
            filled(rays.d[2], z),
        ];
        let infinity = f32x16::splat(simd, f32::INFINITY);
        let (mut least, mut greatest) = ([infinity; 2], [-infinity; 2]);
        let (mut slowest, mut longest2) = (infinity, f32x16::splat(simd, 0.0));
        let mut together = 0;
        for first in (0..rays.len()).step_by(GROUP) {
            let mut d = [infinity; 3];
            for axis in 0..3 {
                d[axis] = narrowed(simd, columns[axis], first, 1.0);
                d[axis].store_slice(&mut self.d[axis][first..first + GROUP]);
                let size = d[axis].abs().max(SLOWEST).copysign(d[axis]);
                (1.0 / size).store_slice(&mut self.inverse[axis][first..first + GROUP]);
            }
            let depth = d[axes[2]] * sign;
            depth.store_slice(&mut self.depth[first..first + GROUP]);
            let inverse = f32x16::from_slice(simd, &self.inverse[axes[2]][first..first + GROUP]);
            let slopes = [d[axes[0]] * (inverse * sign), d[axes[1]] * (inverse * sign)];
            let size = d[0].abs() + d[1].abs() + d[2].abs();
            // A margin for the rounding of this sum.
            let is_ordinary = size.simd_gt(ORDINARY.start as f32 * RELATIVE)
                & size.simd_lt(ORDINARY.end as f32 / RELATIVE)
                & depth.simd_gt(LEAST_DEPTH)
                & slopes[0].abs().simd_lt(MAX_SLOPE)
                & slopes[1].abs().simd_lt(MAX_SLOPE);
            together |= is_ordinary.to_bitmask() << first;
            for side in 0..2 {
                least[side] = least[side].min(is_ordinary.select(slopes[side], infinity));
                greatest[side] = greatest[side].max(is_ordinary.select(slopes[side], -infinity));
            }
            slowest = slowest.min(is_ordinary.select(depth, infinity));
            let length2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            longest2 = longest2.max(is_ordinary.select(length2, f32x16::splat(simd, 0.0)));
            let at = first..first + GROUP;
            infinity.store_slice(&mut self.nearest[at.clone()]);
            u32x16::splat(simd, NONE).store_slice(&mut self.id[at.clone()]);
            self.found[at].fill(Found::default());
        }
        together &= u64::MAX >> (SIZE - rays.len());
        together &= self.load_skips(rays);
        if together == 0 {
            return None;
        }
        for i in 0..SIZE {
            if together >> i & 1 == 0 {
                // No range, so that it does not make that of the others longer.
                (self.end[i], self.depth[i]) = (f32::NEG_INFINITY, 1.0);
            }
        }
        let slopes = [
            [least[0].reduce_min(), greatest[0].reduce_max()],
            [least[1].reduce_min(), greatest[1].reduce_max()],
        ];
        let longest = f64::from(longest2.reduce_max()).sqrt() * f64::from(RELATIVE);
        Some(Together {
            rays: together,
            frustum: Frustum::new(axes, first, slopes, apex, space.size),
            bounds: TileBounds {
                noise: 2.0 * f64::from(noise_within(distance + 3.0 * space.size)),
                longest,
            },
            end: self.farthest(simd, rays.len()),
            // A ray is a mean of the corners times at least the least depth, so an error grows by
            // its inverse. The corners are at most 3.2 long and the rays at least 1/7.
            corner_factor: 1.01 / slowest.reduce_min() + 24.0,
        })
    }

    /// The ends of the ranges.
    #[inline(always)]
    fn load_ends<S: Simd>(&mut self, simd: S, rays: &RayTile, scale: f64) {
        match rays.max_t {
            TileEnds::All(max_t) => self.end.fill(at_least(max_t * scale)),
            TileEnds::Each(ends) => {
                let buffer = &mut [0.0; SIZE];
                let ends = filled(ends, buffer);
                for first in (0..rays.len()).step_by(GROUP) {
                    let end = narrowed(simd, ends, first, scale);
                    let rounding = end.abs() * f32::EPSILON + f32::MIN_POSITIVE;
                    (end + rounding).store_slice(&mut self.end[first..first + GROUP]);
                }
            }
        }
    }

    /// What rays cannot hit. Returns one bit for each ray whose range is not NaN.
    #[inline(always)]
    fn load_skips(&mut self, rays: &RayTile) -> u64 {
        if rays.skips.is_empty() {
            self.skip.fill(NONE);
        } else {
            for (skip, id) in self.skip.iter_mut().zip(rays.skips) {
                *skip = id.map_or(NONE, |PrimId(id)| id);
            }
        }
        let is_range = |end: &f32| !end.is_nan();
        match rays.max_t {
            TileEnds::All(_) if is_range(&self.end[0]) => u64::MAX,
            _ => {
                let mut ranges = 0;
                for (i, end) in self.end.iter().enumerate() {
                    ranges |= u64::from(is_range(end)) << i;
                }
                ranges
            }
        }
    }

    /// At least the greatest depth of a point of the first `count` rays in their ranges.
    #[inline(always)]
    pub(crate) fn farthest<S: Simd>(&self, simd: S, count: usize) -> f32 {
        let mut farthest = f32x16::splat(simd, 0.0);
        for first in (0..count).step_by(GROUP) {
            let end = f32x16::from_slice(simd, &self.end[first..first + GROUP]);
            let depth = f32x16::from_slice(simd, &self.depth[first..first + GROUP]);
            farthest = farthest.max(end * depth);
        }
        farthest.reduce_max() * RELATIVE + f32::MIN_POSITIVE
    }

    /// Those of `active`, one bit each, that enter a box in their ranges. `low` and `high` are its
    /// corners relative to the apex, moved outwards by the slack.
    #[inline(always)]
    pub(crate) fn entering<S: Simd>(
        &self,
        simd: S,
        low: [f32; 3],
        high: [f32; 3],
        active: u64,
    ) -> u64 {
        let mut entering = 0;
        for first in (0..SIZE).step_by(GROUP) {
            if active >> first & 0xffff == 0 {
                continue;
            }
            let mut entry = f32x16::splat(simd, 0.0);
            let mut exit = f32x16::from_slice(simd, &self.end[first..first + GROUP]);
            for axis in 0..3 {
                let inverse = f32x16::from_slice(simd, &self.inverse[axis][first..first + GROUP]);
                let (a, b) = (inverse * low[axis], inverse * high[axis]);
                entry = entry.max(a.min(b));
                exit = exit.min(a.max(b));
            }
            entering |= entry.simd_le(exit * RELATIVE).to_bitmask() << first;
        }
        entering & active
    }

    /// Remembers a hit that is certain for the rays `lanes` of the group from number `first`.
    #[inline(always)]
    pub(crate) fn remember<S: Simd>(
        &mut self,
        simd: S,
        first: usize,
        lanes: u64,
        [id, place]: [u32; 2],
        [nearest, farthest]: [f32x16<S>; 2],
    ) {
        let lanes = mask32x16::from_bitmask(simd, lanes);
        let at = first..first + GROUP;
        let old = f32x16::from_slice(simd, &self.nearest[at.clone()]);
        lanes
            .select(nearest, old)
            .store_slice(&mut self.nearest[at.clone()]);
        let old = f32x16::from_slice(simd, &self.end[at.clone()]);
        lanes
            .select(farthest, old)
            .store_slice(&mut self.end[at.clone()]);
        for (column, number) in [(&mut self.id, id), (&mut self.place, place)] {
            let old = u32x16::from_slice(simd, &column[at.clone()]);
            let number = u32x16::splat(simd, number);
            lanes
                .select(number, old)
                .store_slice(&mut column[at.clone()]);
        }
    }

    /// Those of the group from number `first`, one bit each, that may not hit triangle `id` or have
    /// hit it already.
    #[inline(always)]
    pub(crate) fn ignoring<S: Simd>(&self, simd: S, first: usize, id: u32) -> u64 {
        let ids = u32x16::from_slice(simd, &self.id[first..first + GROUP]);
        let skips = u32x16::from_slice(simd, &self.skip[first..first + GROUP]);
        (ids.simd_eq(id) | skips.simd_eq(id)).to_bitmask()
    }
}
