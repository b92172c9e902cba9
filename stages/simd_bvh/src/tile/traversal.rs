//! The traversal of the tree by a tile.
//!
//! If a ray hits a triangle for certain, and before all others, it remembers the triangle, with an
//! interval that contains `t`; this hit is computed in the end, one for each ray. If two intervals
//! overlap, or single precision cannot decide, the hit is computed at once, as the traversal by one
//! ray does. So the hits are those of the scalar kernel, bit for bit. A triangle that was divided
//! before the build is in several blocks; a ray that remembers it ignores it in the other blocks.

use super::planes::{PlaneBlock, PlaneHits};
use super::rays::{NONE, TileRays, Together};
use super::{GROUP, SIZE};
use crate::intersect::{ExactTest, TestCounts};
use crate::kernels::triangle_filter::first_lanes;
use crate::kernels::woop::{self, Decision, axes_along};
use crate::layout::LANES;
use crate::layout::node::{Child, ChildKind};
use crate::ray_tile::RayTile;
use crate::rounding::at_least;
use crate::wide::{Subset, WideBvh};
use fearless_simd::{Simd, f32x8, f32x16, prelude::*};
use kit::{PrimId, TriangleHit};

/// If at most this many rays enter the box of a block, each ray is tested against all triangles of
/// the block at once; if more do, each triangle is tested against many rays at once.
const FEW_RAYS: u32 = 14;

/// A child that is still to be visited: `near`, which is at most the depth at which its box begins,
/// the child itself, and where its box is stored.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    near: f32,
    child: Child,
    /// The node and the lane of the box: `8·node + lane`, or [`NONE`] for a root.
    place: u32,
}

/// Adds the closest hit of each of `rays`, at most 64, to `hits`.
#[expect(
    clippy::too_many_arguments,
    reason = "what a caller of the tree passes"
)]
#[inline(always)]
pub(crate) fn trace<S: Simd>(
    simd: S,
    tree: &WideBvh,
    subset: Subset,
    rays: &RayTile,
    columns: &mut TileRays,
    stack: &mut Vec<Entry>,
    exact: &mut ExactTest,
    counts: &mut TestCounts,
    hits: &mut Vec<Option<(PrimId, TriangleHit)>>,
) {
    let mut together = 0;
    if let Some(start) = columns.load(simd, rays, &tree.space) {
        together = start.rays;
        let mut traversal = TileTraversal {
            simd,
            tree,
            rays,
            columns,
            end: start.end,
            together: start,
            exact,
        };
        traversal.visit(subset, stack, counts);
        traversal.finish();
    }
    for i in 0..rays.len() {
        hits.push(if together >> i & 1 == 1 {
            columns.found[i].closest
        } else {
            tree.closest(&rays.ray(i), rays.skip(i), exact, counts)
        });
    }
}

struct TileTraversal<'a, 'e, S: Simd> {
    simd: S,
    tree: &'a WideBvh,
    rays: &'a RayTile<'a>,
    columns: &'a mut TileRays,
    together: Together,
    /// No point of a ray in the ray's range is deeper than this.
    end: f32,
    exact: &'a mut ExactTest<'e>,
}

impl<S: Simd> TileTraversal<'_, '_, S> {
    /// Visits nodes and blocks, nearer ones first.
    #[inline(always)]
    fn visit(&mut self, subset: Subset, stack: &mut Vec<Entry>, counts: &mut TestCounts) {
        let tree = self.tree;
        stack.clear();
        stack.extend(tree.roots_of(subset).iter().map(|&child| Entry {
            near: 0.0,
            child,
            place: NONE,
        }));
        while let Some(Entry { near, child, place }) = stack.pop() {
            if near > self.end {
                continue;
            }
            match child.kind() {
                ChildKind::Node { index, count } => {
                    counts.box_tests += u64::from(count);
                    let node = &tree.nodes[index];
                    let frustum = &self.together.frustum;
                    let (near, inside) = frustum.boxes(self.simd, node, self.end);
                    let inside = inside & first_lanes(count);
                    for lane in frustum.far_to_near(node) {
                        if inside >> lane & 1 == 1 {
                            let child = Child(node.children[lane]);
                            tree.prefetch(child);
                            stack.push(Entry {
                                near: near[lane],
                                child,
                                place: (LANES * index + lane) as u32,
                            });
                        }
                    }
                }
                ChildKind::Triangles { index, count } => {
                    let entering = self.entering(place);
                    if entering != 0 {
                        counts.prim_tests += u64::from(count);
                        self.test_triangles(index, count, entering);
                    }
                }
                ChildKind::Spheres { index, count } => {
                    let entering = self.entering(place);
                    if entering != 0 {
                        counts.prim_tests += u64::from(count);
                        self.test_spheres(index, entering);
                    }
                }
            }
        }
    }

    /// The rays that enter the box at `place` in their ranges.
    #[inline(always)]
    fn entering(&self, place: u32) -> u64 {
        let rays = self.together.rays;
        if place == NONE {
            return rays;
        }
        let node = &self.tree.nodes[place as usize / LANES];
        let [low, high] = node.corners(place as usize % LANES);
        let frustum = &self.together.frustum;
        let apex = frustum.apex.to_array();
        let (mut from, mut to) = ([0.0; 3], [0.0; 3]);
        for axis in 0..3 {
            from[axis] = low[axis] - apex[axis] as f32 - frustum.slack;
            to[axis] = high[axis] - apex[axis] as f32 + frustum.slack;
        }
        self.columns.entering(self.simd, from, to, rays)
    }

    /// Tests the `count` triangles of block number `index` against the rays `entering`.
    #[inline(always)]
    fn test_triangles(&mut self, index: usize, count: u32, entering: u64) {
        let together = &self.together;
        let block = &self.tree.blocks[index];
        let apex = together.frustum.apex;
        let planes = PlaneBlock::new(self.simd, block, apex, &together.bounds);
        let is_changed = if entering.count_ones() <= FEW_RAYS {
            self.test_ray_by_ray(&planes, index, count, entering)
        } else {
            self.test_triangle_by_triangle(&planes, index, count, entering)
        };
        if is_changed {
            self.end = self.columns.farthest(self.simd, self.rays.len());
        }
    }

    /// Tests each ray against the block's triangles. Returns whether a range may be shorter.
    #[inline(always)]
    fn test_ray_by_ray(
        &mut self,
        planes: &PlaneBlock,
        index: usize,
        count: u32,
        mut entering: u64,
    ) -> bool {
        let simd = self.simd;
        let planes = planes.all(simd);
        let block = &self.tree.blocks[index];
        let present = u64::from(first_lanes(count));
        let start = f32x8::splat(simd, self.columns.start);
        let mut is_changed = false;
        while entering != 0 {
            let i = entering.trailing_zeros() as usize % SIZE;
            entering &= entering - 1;
            let d = &self.columns.d;
            let d = [
                f32x8::splat(simd, d[0][i]),
                f32x8::splat(simd, d[1][i]),
                f32x8::splat(simd, d[2][i]),
            ];
            let edges = planes.edges(simd, &d);
            if edges.possible & present == 0 {
                continue;
            }
            let end = f32x8::splat(simd, self.columns.end[i]);
            let hits = planes.hits(simd, &edges, start, end);
            let mut lanes = hits.possible & present;
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize % LANES;
                lanes &= lanes - 1;
                let PrimId(id) = block.id(lane);
                if id == self.columns.id[i] || id == self.columns.skip[i] {
                    continue;
                }
                is_changed = true;
                let columns = &mut *self.columns;
                let is_sure = hits.sure >> lane & 1 == 1;
                let (nearest, farthest) = (hits.nearest[lane], hits.farthest[lane]);
                if is_sure && farthest < columns.nearest[i] && farthest <= columns.end[i] {
                    self.tree.prefetch_vertices(index, lane);
                    columns.id[i] = id;
                    columns.place[i] = (LANES * index + lane) as u32;
                    columns.nearest[i] = nearest;
                    columns.end[i] = farthest;
                } else if !is_sure || nearest <= columns.end[i] {
                    self.compute(i, (LANES * index + lane) as u32, id);
                }
            }
        }
        is_changed
    }

    /// Tests each triangle against sixteen rays at once. Returns whether a range may be shorter.
    #[inline(always)]
    fn test_triangle_by_triangle(
        &mut self,
        planes: &PlaneBlock,
        index: usize,
        count: u32,
        entering: u64,
    ) -> bool {
        let simd = self.simd;
        let block = &self.tree.blocks[index];
        let corners = self.together.frustum.corners();
        let factor = self.together.corner_factor;
        let outside = planes.all(simd).outside(simd, &corners, factor);
        let mut triangles = first_lanes(count) & !(outside as u32);
        let start = f32x16::splat(simd, self.columns.start);
        let mut is_changed = false;
        while triangles != 0 {
            let lane = triangles.trailing_zeros() as usize % LANES;
            triangles &= triangles - 1;
            let PrimId(id) = block.id(lane);
            let place = (LANES * index + lane) as u32;
            let planes = planes.one::<S, f32x16<S>>(simd, lane);
            for first in (0..SIZE).step_by(GROUP) {
                let active = entering >> first & 0xffff;
                if active == 0 {
                    continue;
                }
                let d = &self.columns.d;
                let d = [
                    f32x16::from_slice(simd, &d[0][first..first + GROUP]),
                    f32x16::from_slice(simd, &d[1][first..first + GROUP]),
                    f32x16::from_slice(simd, &d[2][first..first + GROUP]),
                ];
                let edges = planes.edges(simd, &d);
                if edges.possible & active == 0 {
                    continue;
                }
                let end = f32x16::from_slice(simd, &self.columns.end[first..first + GROUP]);
                let hits: PlaneHits<f32x16<S>> = planes.hits(simd, &edges, start, end);
                let possible = hits.possible & active & !self.columns.ignoring(simd, first, id);
                if possible == 0 {
                    continue;
                }
                is_changed = true;
                let old = f32x16::from_slice(simd, &self.columns.nearest[first..first + GROUP]);
                let before = (hits.farthest.simd_lt(old) & hits.farthest.simd_le(end)).to_bitmask();
                let taken = possible & hits.sure & before;
                if taken != 0 {
                    self.tree.prefetch_vertices(index, lane);
                }
                let interval = [hits.nearest, hits.farthest];
                self.columns
                    .remember(simd, first, taken, [id, place], interval);
                let mut others = possible & !taken;
                while others != 0 {
                    let i = first + others.trailing_zeros() as usize;
                    others &= others - 1;
                    self.compute(i, place, id);
                }
            }
        }
        is_changed
    }

    #[inline(always)]
    fn test_spheres(&mut self, index: usize, mut entering: u64) {
        let spheres = &self.tree.spheres[index];
        while entering != 0 {
            let i = entering.trailing_zeros() as usize % SIZE;
            entering &= entering - 1;
            let mut lanes = spheres.candidates(self.simd, &self.rays.ray(i));
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize % LANES;
                lanes &= lanes - 1;
                let id = spheres.id(lane);
                if id.0 != self.columns.skip[i] {
                    self.test_scalar(i, id);
                }
            }
        }
        self.end = self.columns.farthest(self.simd, self.rays.len());
    }

    /// Computes the hit of ray number `i` with triangle `id` at `place`, if there is one.
    #[inline(always)]
    fn compute(&mut self, i: usize, place: u32, id: u32) {
        let (index, lane) = (place as usize / LANES, place as usize % LANES);
        let vertices = self.tree.vertices(index, lane);
        let ray = &self.rays.ray(i);
        match woop::test(vertices, ray, axes_along(ray.d)) {
            Decision::Hit(hit) => {
                self.columns.found[i].accept(PrimId(id), hit);
                self.shorten(i, hit.t);
            }
            Decision::Miss => {}
            Decision::Undecided => self.test_scalar(i, PrimId(id)),
        }
    }

    /// Tests ray number `i` against primitive `id` with the scalar kernel.
    #[inline(never)]
    fn test_scalar(&mut self, i: usize, id: PrimId) {
        let ray = &self.rays.ray(i);
        if let Some(t) = self.columns.found[i].test(id, ray, self.exact) {
            self.shorten(i, t);
        }
    }

    /// Ends the range of ray number `i` at `t` of the ray in the world, if the range ends later.
    #[inline(always)]
    fn shorten(&mut self, i: usize, t: f64) {
        let end = &mut self.columns.end[i];
        *end = end.min(at_least(t * self.tree.space.scale));
    }

    /// Computes the hits with the triangles that are still only remembered.
    #[inline(always)]
    fn finish(&mut self) {
        for i in 0..self.rays.len() {
            let (id, place) = (self.columns.id[i], self.columns.place[i]);
            if id != NONE {
                self.compute(i, place, id);
            }
        }
    }
}
