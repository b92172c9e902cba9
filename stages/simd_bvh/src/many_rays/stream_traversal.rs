//! The traversal of the tree by a group of rays together.
//!
//! One ray waits most of the time: each step depends on the one before, and the processor often
//! mispredicts whether a node or a block comes next and whether a triangle is hit. Here each loop
//! does the same step for all rays that need it, so steps of different rays overlap and few
//! branches are mispredicted: first nodes, until no ray needs one, then a block of triangles for
//! each ray, and then what the blocks leave undecided.

use crate::intersect::{ExactTest, TestCounts};
use crate::kernels::ray_in_tree::RayInTree;
use crate::kernels::triangle_filter::FilterEdges;
use crate::layout::node::Child;
use crate::many_rays::ray_slot::{RaySlot, TriangleAt};
use crate::many_rays::slot_queue::{GROUP_SIZE, SlotQueues};
use crate::wide::WideBvh;
use fearless_simd::Simd;
use kit::{PrimId, Ray};
use std::hint::select_unpredictable;

/// The traversal of the tree by up to [`GROUP_SIZE`] rays. With `ANY` each ends at its first hit.
pub(crate) struct StreamTraversal<'a, 'e, S: Simd, const ANY: bool> {
    pub(crate) simd: S,
    pub(crate) tree: &'a WideBvh,
    /// Where all rays start.
    pub(crate) roots: &'a [Child],
    /// Each with the primitive that it cannot hit.
    pub(crate) rays: &'a [(Ray, Option<PrimId>)],
    /// One for each ray. They have its hit when the traversal is done.
    pub(crate) slots: &'a mut [RaySlot; GROUP_SIZE],
    pub(crate) exact: &'a mut ExactTest<'e>,
    pub(crate) counts: &'a mut TestCounts,
}

/// The number of blocks that are tested before what they leave undecided: few, so that the results
/// in between stay in the first-level cache.
const BLOCKS_AT_ONCE: usize = 16;

impl<S: Simd, const ANY: bool> StreamTraversal<'_, '_, S, ANY> {
    /// Traces all rays.
    #[inline(always)]
    pub(crate) fn trace(&mut self) {
        let mut queues = SlotQueues::EMPTY;
        let mut edges = [FilterEdges::none(self.simd); BLOCKS_AT_ONCE];
        for i in 0..self.rays.len().min(GROUP_SIZE) {
            let next = self.start(i);
            queues.push(i, next);
        }
        loop {
            self.visit_nodes(&mut queues);
            if queues.triangles.is_empty() && queues.spheres.is_empty() {
                break;
            }
            self.test_triangles(&mut queues, &mut edges);
            self.test_spheres(&mut queues);
        }
        if !ANY {
            for (slot, (ray, _)) in self.slots.iter_mut().zip(self.rays) {
                slot.compute_candidate(self.tree, ray, self.exact);
            }
        }
    }

    /// Prepares a slot for its ray. Returns the child to visit first.
    #[inline(always)]
    fn start(&mut self, i: usize) -> Child {
        let (ray, skip) = &self.rays[i];
        let slot = &mut self.slots[i];
        slot.clear();
        if let Some(in_tree) = RayInTree::new(ray, &self.tree.space)
            && slot.stack.start(self.roots)
        {
            slot.start(self.simd, &in_tree, *skip);
            return slot.stack.top();
        }
        self.trace_alone(i);
        Child::NONE
    }

    /// Traces a ray from its start: one that single precision cannot handle, or one that needs a
    /// larger stack.
    #[cold]
    #[inline(never)]
    fn trace_alone(&mut self, i: usize) {
        let (ray, skip) = &self.rays[i];
        let slot = &mut self.slots[i];
        slot.clear();
        if ANY {
            slot.is_hit = self.tree.occluded(ray, *skip, self.exact, self.counts);
        } else {
            slot.found.closest = self.tree.closest(ray, *skip, self.exact, self.counts);
        }
    }

    /// Visits nodes until no ray needs one.
    #[inline(always)]
    fn visit_nodes(&mut self, queues: &mut SlotQueues) {
        let mut box_tests = 0;
        while !queues.nodes.is_empty() {
            for i in 0..queues.nodes.take() {
                let number = queues.nodes.get(i);
                let slot = &mut self.slots[number];
                if slot.stack.is_full() {
                    self.trace_alone(number);
                    continue;
                }
                let child = slot.stack.pop();
                box_tests += u64::from(child.count());
                let node = &self.tree.nodes[child.index()];
                slot.stack.push(&slot.boxes.hits(self.simd, node, slot.end));
                let next = slot.stack.top();
                queues.push(number, next);
            }
        }
        self.counts.box_tests += box_tests;
    }

    /// Tests a block of triangles for each ray that needs one.
    #[inline(always)]
    fn test_triangles(
        &mut self,
        queues: &mut SlotQueues,
        edges: &mut [FilterEdges<S>; BLOCKS_AT_ONCE],
    ) {
        let mut undecided = [(0, Child::NONE); BLOCKS_AT_ONCE];
        let mut prim_tests = 0;
        let count = queues.triangles.take();
        for first in (0..count).step_by(BLOCKS_AT_ONCE) {
            let mut undecided_count = 0;
            for i in first..count.min(first + BLOCKS_AT_ONCE) {
                let number = queues.triangles.get(i);
                let slot = &mut self.slots[number];
                let child = slot.stack.pop();
                prim_tests += u64::from(child.count());
                let block = &self.tree.blocks[child.index()];
                let mut found = slot.filter.edges(self.simd, block, child.count());
                // Here, and not for the few lanes that remain: most rays start on a triangle, and
                // without it their first block is most often decided.
                found.possible &= !block.lanes_of(self.simd, slot.skip);
                let is_undecided = found.possible != 0;
                edges[undecided_count % BLOCKS_AT_ONCE] = found;
                undecided[undecided_count % BLOCKS_AT_ONCE] = (number, child);
                undecided_count += usize::from(is_undecided);
                let next = slot.stack.top();
                queues.push(
                    number,
                    select_unpredictable(is_undecided, Child::NONE, next),
                );
            }
            for (edges, &(number, child)) in edges.iter().zip(&undecided).take(undecided_count) {
                let is_hit = self.test_edges(number, child, edges);
                self.go_on(queues, number, is_hit);
            }
        }
        self.counts.prim_tests += prim_tests;
    }

    /// Tests the block `child`, whose triangles may be hit where `edges` say so. Returns whether
    /// one is hit.
    #[inline(always)]
    fn test_edges(&mut self, number: usize, child: Child, edges: &FilterEdges<S>) -> bool {
        let (ray, _) = &self.rays[number];
        let slot = &mut self.slots[number % GROUP_SIZE];
        let block = &self.tree.blocks[child.index()];
        let hits = slot.filter.hits(self.simd, block, edges, slot.limit);
        let mut lanes = hits.possible;
        let mut is_hit = false;
        while lanes != 0 && !(ANY && is_hit) {
            let lane = lanes.trailing_zeros();
            lanes &= lanes - 1;
            let at = TriangleAt {
                block: child.index() as u32,
                lane,
            };
            if hits.sure >> lane & 1 == 0 {
                is_hit |= slot.test(self.tree, at, ray, self.exact);
                continue;
            }
            let interval = hits.interval(lane as usize);
            if interval[0] > slot.limit {
                continue;
            }
            is_hit = true;
            if !ANY {
                slot.add_candidate(self.tree, at, interval, ray, self.exact);
            }
        }
        is_hit
    }

    /// Tests a block of spheres for each ray that needs one.
    #[inline(always)]
    fn test_spheres(&mut self, queues: &mut SlotQueues) {
        for i in 0..queues.spheres.take() {
            let number = queues.spheres.get(i);
            let (ray, _) = &self.rays[number];
            let slot = &mut self.slots[number];
            let child = slot.stack.pop();
            self.counts.prim_tests += u64::from(child.count());
            let block = &self.tree.spheres[child.index()];
            let mut lanes = block.candidates(self.simd, ray);
            let mut is_hit = false;
            while lanes != 0 && !(ANY && is_hit) {
                let lane = lanes.trailing_zeros() as usize & 7;
                lanes &= lanes - 1;
                let id = block.id(lane);
                is_hit |= slot.skip != id && slot.test_scalar(id, ray, self.exact);
            }
            self.go_on(queues, number, is_hit);
        }
    }

    /// Queues a ray for what it needs after a block in which it has a hit or not. With `ANY` it
    /// needs nothing after a hit.
    #[inline(always)]
    fn go_on(&mut self, queues: &mut SlotQueues, number: usize, is_hit: bool) {
        let slot = &mut self.slots[number % GROUP_SIZE];
        if is_hit {
            slot.is_hit = true;
            if ANY {
                return;
            }
            slot.cull(self.simd);
        }
        queues.push(number, slot.stack.top());
    }
}
