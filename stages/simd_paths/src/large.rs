// BEGIN SOLUTION(part6.task2)
//! The few large primitives of a scene, such as the walls of a room.
//!
//! A ray in a room meets its walls far more often than what stands in the room. The walls are a
//! short list, which lanes test in less time than a tree, and only rays that also cross the box
//! around all other primitives need the tree.

use crate::primitive_list::PrimitiveList;
use crate::ray_packet::RayPacket;
use crate::vec3x8::Vec3x8;
use fearless_simd::{Simd, f64x8, prelude::*};
use kit::{Aabb, Scene, Vec3};

/// The large primitives of a scene, and where all others are.
#[derive(Clone, Debug)]
pub(crate) struct LargePrimitives {
    /// The large primitives.
    pub(crate) list: PrimitiveList,
    /// The box around all others.
    others: Aabb,
    /// The largest absolute value of its coordinates.
    reach: f64,
}

/// The largest number of large primitives.
const MOST: usize = 16;

/// The time of testing one primitive of a list against the time of tracing a ray through a tree
/// (measured with a room and a mesh of 30,000 triangles).
const COST_OF_TEST: f64 = 0.01;

/// Tests and the share of rays that need the tree as well have to cost less than this, relative to
/// tracing all rays through the tree.
const WORTHWHILE: f64 = 0.75;

/// The share of the coordinates by which the box is enlarged: much more than the rounding errors
/// of an intersection.
const MARGIN: f64 = 1e-10;

impl LargePrimitives {
    /// The primitives to be tested apart from the tree; `None` if that would not save time.
    ///
    /// They are the largest ones. As many are taken as make the expected time least, where a ray
    /// crosses the box of the others with a probability of the ratio of the surface areas, as in
    /// the surface area heuristic for trees.
    pub(crate) fn of(scene: &Scene) -> Option<LargePrimitives> {
        let bounds = scene.primitive_bounds();
        let all = scene.bounds().surface_area();
        let size = |id: &usize| bounds[*id].surface_area();
        let mut ids: Vec<usize> = (0..bounds.len()).collect();
        if ids.len() <= MOST {
            return None;
        }
        ids.select_nth_unstable_by(MOST, |a, b| size(b).total_cmp(&size(a)));
        let (large, small) = ids.split_at_mut(MOST);
        large.sort_by(|a, b| size(b).total_cmp(&size(a)));
        let around = |ids: &[usize]| {
            ids.iter()
                .fold(Aabb::EMPTY, |sum, &id| sum.union(bounds[id]))
        };
        let mut others = around(small);
        let mut best = (WORTHWHILE, None);
        for count in (1..=MOST).rev() {
            let cost = COST_OF_TEST * count as f64 + others.surface_area() / all;
            if cost < best.0 {
                best = (cost, Some((count, others)));
            }
            others = others.union(bounds[large[count - 1]]);
        }
        let (count, others) = best.1?;
        let listed = &mut large[..count];
        listed.sort_unstable();
        let list = PrimitiveList::with(scene, listed.iter().map(|&id| id as u32));
        let reach = others.min.abs().max(others.max.abs()).max_element();
        Some(LargePrimitives {
            list,
            others,
            reach,
        })
    }

    /// The lanes, one bit each, in which a ray may hit one of the other primitives up to `max_t`.
    #[inline(always)]
    pub(crate) fn may_hit_others<S: Simd>(
        &self,
        simd: S,
        rays: &RayPacket<S>,
        max_t: f64x8<S>,
    ) -> u64 {
        let o = rays.o;
        let margin = (o.x.abs() + o.y.abs() + o.z.abs() + self.reach) * MARGIN;
        let low = self.slab(simd, self.others.min, o, -margin);
        let high = self.slab(simd, self.others.max, o, margin);
        let (mut start, mut end) = (rays.min_t, max_t);
        for ((low, high), d) in low
            .into_iter()
            .zip(high)
            .zip([rays.d.x, rays.d.y, rays.d.z])
        {
            let inverse = 1.0 / d;
            let (a, b) = (low * inverse, high * inverse);
            start = start.max_precise(a.min_precise(b));
            end = end.min_precise(a.max_precise(b));
        }
        // Relative to `t`, too, because a hit's `t` is rounded. NaN counts as a hit.
        let end = end + end.abs() * MARGIN;
        !end.simd_lt(start).to_bitmask() & 0xff
    }

    /// From `o` to a corner of the box, moved by `margin`.
    #[inline(always)]
    fn slab<S: Simd>(
        &self,
        simd: S,
        corner: Vec3,
        o: Vec3x8<S>,
        margin: f64x8<S>,
    ) -> [f64x8<S>; 3] {
        let corner = Vec3x8::splat(simd, corner) - o;
        [corner.x + margin, corner.y + margin, corner.z + margin]
    }
}
// END SOLUTION(part6.task2)
