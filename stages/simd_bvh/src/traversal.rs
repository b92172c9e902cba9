// BEGIN SOLUTION(part6.task1)
//! One traversal of the tree, for the closest hit or for any hit.

use crate::box_test::{BoxTest, ScalarBoxTest};
use crate::intersect::{ExactTest, TestCounts};
use crate::node::{Child, ChildKind, Node};
use crate::simd_box_test::SimdBoxTest;
use crate::sphere_block::SphereBlock;
use crate::stack::{Stack, StackEntry};
use crate::triangle_block::{AxisPermutedRay, TriangleBlock};
use crate::wide::WideBvh;
use fearless_simd::Simd;
use kit::{PrimId, Ray, TriangleHit};

/// The traversal of the tree by one ray. With `ANY` it ends at the first hit.
pub(crate) struct Traversal<'a, 'e, S: Simd, const ANY: bool> {
    simd: S,
    tree: &'a WideBvh,
    skip: Option<PrimId>,
    exact: &'a mut ExactTest<'e>,
    /// A local copy: counters behind a reference would be loaded and stored at every step.
    counts: TestCounts,
    /// A reference, not a copy: reading a whole ray soon after its fields were written stalls, and
    /// a copy whose address is taken would not stay in registers.
    ray: &'a Ray,
    /// The end of the range: `t` of the closest hit so far.
    max_t: f64,
    /// Whether `max_t` has changed since the box test was updated.
    max_t_changed: bool,
    pub(crate) found: Option<(PrimId, TriangleHit)>,
}

impl<'a, 'e, S: Simd, const ANY: bool> Traversal<'a, 'e, S, ANY> {
    #[inline(always)]
    pub(crate) fn new(
        simd: S,
        tree: &'a WideBvh,
        ray: &'a Ray,
        skip: Option<PrimId>,
        exact: &'a mut ExactTest<'e>,
    ) -> Self {
        Traversal {
            simd,
            tree,
            skip,
            exact,
            counts: TestCounts::default(),
            ray,
            max_t: ray.max_t,
            max_t_changed: false,
            found: None,
        }
    }

    #[inline(always)]
    pub(crate) fn run(&mut self, counts: &mut TestCounts) {
        if self.tree.nodes.is_empty() {
            self.test_all_blocks();
        } else {
            let space = &self.tree.space;
            match SimdBoxTest::new(self.simd, self.ray, space) {
                Some(box_test) => self.visit_nodes(box_test),
                None => self.visit_nodes(ScalarBoxTest::new(self.ray, space)),
            }
        }
        counts.box_tests += self.counts.box_tests;
        counts.prim_tests += self.counts.prim_tests;
    }

    #[inline(always)]
    fn is_done(&self) -> bool {
        ANY && self.found.is_some()
    }

    /// Visits the nodes, nearer ones first.
    #[inline(always)]
    fn visit_nodes(&mut self, mut box_test: impl BoxTest) {
        let mut stack = Stack::new();
        // Computed at the first block: many rays reach none.
        let mut block_ray = None;
        let mut next = Some(Child::ROOT);
        while let Some(child) = next {
            next = match child.kind() {
                ChildKind::Node(number) => {
                    let node = &self.tree.nodes[number as usize];
                    self.counts.box_tests += u64::from(node.count);
                    nearest_first(node, &box_test, &mut stack)
                }
                ChildKind::Triangles(number) => {
                    self.test_triangles(&self.tree.blocks[number as usize], &mut block_ray);
                    None
                }
                ChildKind::Spheres(number) => {
                    self.test_spheres(&self.tree.spheres[number as usize]);
                    None
                }
            };
            if next.is_none() {
                if self.is_done() {
                    return;
                }
                if self.max_t_changed {
                    self.max_t_changed = false;
                    box_test.shorten(self.max_t);
                }
                next = stack.pop_within(&box_test);
            }
        }
    }

    /// Tests every block of a tree without nodes.
    #[inline(always)]
    fn test_all_blocks(&mut self) {
        let mut block_ray = None;
        for block in &self.tree.blocks {
            self.test_triangles(block, &mut block_ray);
            if self.is_done() {
                return;
            }
        }
        for spheres in &self.tree.spheres {
            self.test_spheres(spheres);
        }
    }

    #[inline(always)]
    fn test_triangles(&mut self, block: &TriangleBlock, block_ray: &mut Option<AxisPermutedRay>) {
        self.counts.prim_tests += u64::from(block.len());
        if block_ray.is_none() {
            *block_ray = Some(AxisPermutedRay::new(self.ray));
        }
        let Some(block_ray) = block_ray else { return };
        let hits = block_ray.test(self.simd, block, self.max_t);
        let mut lanes = hits.hit | hits.undecided;
        while lanes != 0 && !self.is_done() {
            let lane = lanes.trailing_zeros() as usize & 7;
            lanes &= lanes - 1;
            let id = block.id(lane);
            if self.skip == Some(id) {
                continue;
            }
            if hits.hit >> lane & 1 == 1 {
                self.accept(id, hits.at(lane));
            } else {
                self.test_scalar(id);
            }
        }
    }

    #[inline(always)]
    fn test_spheres(&mut self, spheres: &SphereBlock) {
        self.counts.prim_tests += u64::from(spheres.len());
        let mut lanes = spheres.candidates(self.simd, self.ray);
        while lanes != 0 && !self.is_done() {
            let lane = lanes.trailing_zeros() as usize & 7;
            lanes &= lanes - 1;
            let id = spheres.id(lane);
            if self.skip != Some(id) {
                self.test_scalar(id);
            }
        }
    }

    /// Tests a primitive with the scalar kernel.
    #[inline(always)]
    fn test_scalar(&mut self, id: PrimId) {
        let ray = Ray {
            max_t: self.max_t,
            ..*self.ray
        };
        if let Some(hit) = (self.exact)(id, &ray) {
            self.accept(id, hit);
        }
    }

    /// Accepts a hit in the ray's range, unless a hit at equal `t` has a lower id.
    #[inline(always)]
    fn accept(&mut self, id: PrimId, hit: TriangleHit) {
        if self
            .found
            .is_none_or(|(best_id, best)| (hit.t, id) < (best.t, best_id))
        {
            self.found = Some((id, hit));
            self.max_t = hit.t;
            self.max_t_changed = true;
        }
    }
}

/// Returns the child whose box the ray enters first. Pushes the other children that it hits, the
/// nearest last.
#[inline(always)]
fn nearest_first(node: &Node, box_test: &impl BoxTest, stack: &mut Stack) -> Option<Child> {
    let hits = box_test.test(node);
    let mut lanes = hits.lanes;
    let mut take = || {
        let lane = lanes.trailing_zeros() as usize & 7;
        lanes &= lanes.wrapping_sub(1);
        StackEntry::new(hits.entries[lane], node.children[lane])
    };
    match hits.lanes.count_ones() as usize {
        0 => None,
        1 => Some(take().child()),
        2 => {
            let (a, b) = (take(), take());
            stack.push(a.max(b));
            Some(a.min(b).child())
        }
        many => {
            let mut sorted = [StackEntry::NONE; 8];
            for i in 0..many {
                let new = take();
                let mut place = i;
                while place > 0 && sorted[place - 1] < new {
                    sorted[place] = sorted[place - 1];
                    place -= 1;
                }
                sorted[place] = new;
            }
            for &farther in &sorted[..many - 1] {
                stack.push(farther);
            }
            Some(sorted[many - 1].child())
        }
    }
}
// END SOLUTION(part6.task1)
