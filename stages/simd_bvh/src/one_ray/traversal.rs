//! One traversal of the tree by an ordinary ray, for the closest hit or for any hit.

use crate::intersect::{ExactTest, TestCounts};
use crate::kernels::found::Found;
use crate::kernels::ray_in_tree::RayInTree;
use crate::kernels::simd_box_test::Key;
use crate::kernels::simd_box_test::{SimdBoxTest, range_end};
use crate::kernels::triangle_filter::TriangleFilter;
use crate::kernels::woop::{self, Decision, Vertices};
use crate::layout::sphere_block::SphereBlock;
use crate::one_ray::stack::StackMemory;
use crate::rounding::at_least;
use crate::wide::WideBvh;
use fearless_simd::Simd;
use kit::{PrimId, Ray, TriangleHit};
use std::hint::select_unpredictable;

/// The traversal of the tree by one ray. With `ANY` it ends at the first hit.
pub(crate) struct Traversal<'a, 'e, S: Simd, const ANY: bool> {
    simd: S,
    tree: &'a WideBvh,
    skip: Option<PrimId>,
    exact: &'a mut ExactTest<'e>,
    /// A reference, not a copy: reading a whole ray soon after its fields were written stalls, and
    /// a copy whose address is taken would not stay in registers.
    ray: &'a Ray,
    in_tree: RayInTree,
    /// Computed at the first block: many rays reach none.
    filter: Option<TriangleFilter>,
    /// At least the end of the range, in the tree's space.
    limit: f32,
    /// The same for boxes.
    end: Key,
    /// The closest hit of the scalar kernel so far.
    found: Found,
}

impl<'a, 'e, S: Simd, const ANY: bool> Traversal<'a, 'e, S, ANY> {
    #[inline(always)]
    pub(crate) fn new(
        simd: S,
        tree: &'a WideBvh,
        ray: &'a Ray,
        in_tree: RayInTree,
        skip: Option<PrimId>,
        exact: &'a mut ExactTest<'e>,
    ) -> Self {
        let limit = at_least(in_tree.max_t);
        Traversal {
            simd,
            tree,
            skip,
            exact,
            ray,
            in_tree,
            filter: None,
            limit,
            end: range_end(limit),
            found: Found::default(),
        }
    }

    /// The closest hit. Adds to `counts`.
    #[inline(always)]
    pub(crate) fn closest(mut self, counts: &mut TestCounts) -> Option<(PrimId, TriangleHit)> {
        self.visit(counts);
        self.found.closest
    }

    /// Whether there is a hit. Adds to `counts`.
    #[inline(always)]
    pub(crate) fn any(mut self, counts: &mut TestCounts) -> bool {
        self.visit(counts)
    }

    /// Visits the nodes and blocks, nearer ones first. With `ANY` returns whether there is a hit.
    #[inline(always)]
    fn visit(&mut self, counts: &mut TestCounts) -> bool {
        // Local copies: counters behind a reference would be loaded and stored at every step.
        let (mut box_tests, mut prim_tests) = (0, 0);
        let boxes = SimdBoxTest::new(self.simd, &self.in_tree);
        let nodes = &self.tree.nodes[..];
        let mut stack = StackMemory::new();
        let mut len = 0;
        match self.tree.roots[..] {
            // Apart from the loop, because there is no other entry beside it.
            [root] if root.is_node() => {
                box_tests += u64::from(root.count());
                let hits = boxes.hits(self.simd, &nodes[root.index()], self.end);
                stack.write(len, hits.keys, hits.children);
                len = hits.count;
                if len == 0 {
                    // Many rays end here, without what the loop computes before its first step.
                    counts.box_tests += box_tests;
                    return false;
                }
            }
            _ => {
                for &root in &self.tree.roots {
                    len = stack.push(len, root);
                }
            }
        }
        // In memory: operations read the numbers from there, while loads before the loop would take
        // more registers than there are.
        let boxes = boxes.widened(self.simd);
        let boxes = std::hint::black_box(&boxes);
        let mut is_hit = false;
        while let Some((below, key, child)) = stack.pop(len) {
            len = below;
            if key > self.end {
                continue;
            }
            if child.is_node() {
                box_tests += u64::from(child.count());
                len = stack.reserve(len);
                // The next entry, too, if it is a node: most often it is needed anyway, and two
                // nodes take hardly longer than one.
                let (key, second) = stack.peek(len);
                let both = (len > 0) & second.is_node() & (key <= self.end);
                // Not branches: whether there is one is hard to predict.
                let second = select_unpredictable(both, second, child);
                let second_count = select_unpredictable(both, second.count(), 0);
                box_tests += u64::from(second_count);
                let hits = boxes.hits(self.simd, &nodes[child.index()], self.end);
                let second_hits = boxes.hits(self.simd, &nodes[second.index()], self.end);
                len -= usize::from(both);
                stack.write(len, second_hits.keys, second_hits.children);
                len += select_unpredictable(both, second_hits.count, 0);
                stack.write(len, hits.keys, hits.children);
                len += hits.count;
                continue;
            }
            prim_tests += u64::from(child.count());
            let found = if child.is_triangles() {
                // Most often the ray misses all of them, and the next entry is needed.
                let (_, next) = stack.peek(len);
                self.tree.prefetch(next);
                self.test_triangles(child.index(), child.count())
            } else {
                self.test_spheres(&self.tree.spheres[child.index()])
            };
            if ANY && found {
                is_hit = true;
                break;
            }
        }
        counts.box_tests += box_tests;
        counts.prim_tests += prim_tests;
        is_hit
    }

    /// Tests block number `index`, of `count` triangles. Returns whether there is a hit for
    /// certain.
    #[inline(always)]
    fn test_triangles(&mut self, index: usize, count: u32) -> bool {
        let block = &self.tree.blocks[index];
        if !ANY {
            // A hit needs them, and waiting for memory costs more than the rest of the test.
            self.tree.prefetch_block_vertices(index);
        }
        if self.filter.is_none() {
            self.filter = Some(TriangleFilter::new(&self.in_tree));
        }
        let Some(filter) = &self.filter else {
            return false;
        };
        let axes = filter.axes;
        let hits = filter.test(self.simd, block, count, self.limit);
        let mut lanes = hits.possible;
        if lanes == 0 {
            return false;
        }
        if let Some(skip) = self.skip {
            lanes &= !block.lanes_of(self.simd, skip);
        }
        let mut is_hit = false;
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            let id = block.id(lane);
            if hits.sure >> lane & 1 == 0 {
                is_hit |= self.test_scalar(id);
            } else {
                let [nearest, farthest] = hits.interval(lane);
                if nearest > self.limit {
                    continue;
                }
                is_hit = true;
                if !ANY {
                    self.shorten(self.limit.min(farthest));
                    let vertices = self.tree.vertices(index, lane);
                    self.test_sure(id, vertices, axes);
                }
            }
            if ANY && is_hit {
                break;
            }
        }
        is_hit
    }

    #[inline(always)]
    fn test_spheres(&mut self, spheres: &SphereBlock) -> bool {
        let mut lanes = spheres.candidates(self.simd, self.ray);
        let mut is_hit = false;
        while lanes != 0 && !(ANY && is_hit) {
            let lane = lanes.trailing_zeros() as usize & 7;
            lanes &= lanes - 1;
            let id = spheres.id(lane);
            if self.skip != Some(id) {
                is_hit |= self.test_scalar(id);
            }
        }
        is_hit
    }

    /// Computes a hit that the ray has for certain; `axes` are the filter's. The range is already
    /// shortened to it.
    #[inline(always)]
    fn test_sure(&mut self, id: PrimId, vertices: Vertices, axes: [usize; 3]) {
        match woop::test(vertices, self.ray, axes) {
            Decision::Hit(hit) => self.found.accept(id, hit),
            Decision::Miss => {}
            Decision::Undecided => {
                self.test_scalar(id);
            }
        }
    }

    /// Tests a primitive with the scalar kernel. Returns whether it is hit in the range.
    #[inline(always)]
    fn test_scalar(&mut self, id: PrimId) -> bool {
        match self.found.test(id, self.ray, self.exact) {
            Some(t) => {
                let t = at_least(self.in_tree.scale.local_t(t));
                self.shorten(self.limit.min(t));
                true
            }
            None => false,
        }
    }

    /// Ends the range at `limit`, in the tree's space.
    #[inline(always)]
    fn shorten(&mut self, limit: f32) {
        self.limit = limit;
        self.end = range_end(limit);
    }
}
