// BEGIN SOLUTION(part6.task1)
//! One traversal of the tree, for the closest hit or for any hit.

use crate::box_test::{BoxHits, Key, LANE_BITS, ScalarBoxTest};
use crate::intersect::{ExactTest, TestCounts};
use crate::node::{Child, ChildKind, Node};
use crate::prefetch::prefetch;
use crate::ray_in_tree::RayInTree;
use crate::ray_tests::{OrdinaryRay, RayTests};
use crate::sphere_block::SphereBlock;
use crate::stack::{Stack, StackEntry};
use crate::wide::WideBvh;
use crate::woop::{self, Decision};
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
    /// The closest hit of the scalar kernel so far.
    found: Option<(PrimId, TriangleHit)>,
    /// Whether there is a hit that need not be computed.
    is_hit: bool,
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
            found: None,
            is_hit: false,
        }
    }

    /// The closest hit. Adds to `counts`.
    #[inline(always)]
    pub(crate) fn closest(mut self, counts: &mut TestCounts) -> Option<(PrimId, TriangleHit)> {
        self.run(counts);
        self.found
    }

    /// Whether there is a hit. Adds to `counts`.
    #[inline(always)]
    pub(crate) fn any(mut self, counts: &mut TestCounts) -> bool {
        self.run(counts);
        self.is_done()
    }

    #[inline(always)]
    fn run(&mut self, counts: &mut TestCounts) {
        let space = &self.tree.space;
        match RayInTree::new(self.ray, space) {
            Some(ray) => self.visit(OrdinaryRay::new(self.simd, ray)),
            None => self.visit(ScalarBoxTest::new(self.ray, space)),
        }
        counts.box_tests += self.counts.box_tests;
        counts.prim_tests += self.counts.prim_tests;
    }

    #[inline(always)]
    fn is_done(&self) -> bool {
        ANY && (self.found.is_some() || self.is_hit)
    }

    /// Visits the nodes and blocks, nearer ones first.
    #[inline(always)]
    fn visit(&mut self, mut tests: impl RayTests<S>) {
        let mut stack = Stack::new();
        let mut roots = self.tree.roots.iter();
        let mut next = roots.next().copied();
        while let Some(child) = next {
            next = match child.kind() {
                ChildKind::Node { index } => {
                    let node = &self.tree.nodes[index];
                    self.counts.box_tests += u64::from(node.count);
                    nearest_first(node, &tests.boxes(node), &mut stack)
                }
                ChildKind::Triangles { index, count } => {
                    self.counts.prim_tests += u64::from(count);
                    self.test_triangles(index, count, &mut tests);
                    None
                }
                ChildKind::Spheres { index, count } => {
                    self.counts.prim_tests += u64::from(count);
                    self.test_spheres(&self.tree.spheres[index], &mut tests);
                    None
                }
            };
            if next.is_none() {
                if self.is_done() {
                    return;
                }
                tests.update();
                next = loop {
                    match stack.pop() {
                        Some(entry) if tests.is_within(entry.key()) => break Some(entry.child()),
                        Some(_) => {}
                        None => break roots.next().copied(),
                    }
                };
            }
        }
    }

    #[inline(always)]
    fn test_triangles(&mut self, index: usize, count: u32, tests: &mut impl RayTests<S>) {
        let block = &self.tree.blocks[index];
        if !ANY {
            // A hit needs them, and waiting for memory costs more than the rest of the test.
            prefetch(&self.tree.exact_blocks[index]);
        }
        let hits = tests.triangles(self.simd, block, count);
        let mut lanes = hits.possible;
        while lanes != 0 && !self.is_done() {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            let id = block.id(lane);
            if self.skip == Some(id) {
                continue;
            }
            if hits.sure >> lane & 1 == 0 {
                self.test_scalar(id, tests);
                continue;
            }
            let [nearest, farthest] = hits.interval(lane);
            if !tests.reaches(nearest) {
                continue;
            }
            tests.shorten_local(farthest);
            if ANY {
                self.is_hit = true;
                return;
            }
            self.test_sure(index, lane, tests);
        }
    }

    #[inline(always)]
    fn test_spheres(&mut self, spheres: &SphereBlock, tests: &mut impl RayTests<S>) {
        let mut lanes = spheres.candidates(self.simd, self.ray);
        while lanes != 0 && !self.is_done() {
            let lane = lanes.trailing_zeros() as usize & 7;
            lanes &= lanes - 1;
            let id = spheres.id(lane);
            if self.skip != Some(id) {
                self.test_scalar(id, tests);
            }
        }
    }

    /// Computes a hit that the ray has for certain. The range is already shortened to it.
    #[inline(always)]
    fn test_sure(&mut self, block: usize, lane: usize, tests: &mut impl RayTests<S>) {
        let vertices = &self.tree.exact_blocks[block][lane & 7];
        let id = self.tree.blocks[block].id(lane);
        let decision = match tests.axes() {
            Some(axes) => woop::test(vertices, self.ray, axes),
            None => Decision::Undecided,
        };
        match decision {
            Decision::Hit(hit) => {
                self.accept(id, hit);
            }
            Decision::Miss => {}
            Decision::Undecided => self.test_scalar(id, tests),
        }
    }

    /// Tests a primitive with the scalar kernel.
    #[inline(always)]
    fn test_scalar(&mut self, id: PrimId, tests: &mut impl RayTests<S>) {
        let max_t = self.found.map_or(self.ray.max_t, |(_, hit)| hit.t);
        let ray = Ray { max_t, ..*self.ray };
        if let Some(hit) = (self.exact)(id, &ray) {
            self.accept(id, hit);
            tests.shorten(hit.t);
        }
    }

    /// Accepts a hit if it is closer than the others. Of hits at equal `t` the one with the lowest
    /// id stays.
    #[inline(always)]
    fn accept(&mut self, id: PrimId, hit: TriangleHit) {
        if self
            .found
            .is_none_or(|(best_id, best)| (hit.t, id) < (best.t, best_id))
        {
            self.found = Some((id, hit));
        }
    }
}

/// Returns the child whose box the ray enters first. Pushes the other children that it hits, the
/// nearest last.
#[inline(always)]
fn nearest_first(node: &Node, hits: &BoxHits, stack: &mut Stack) -> Option<Child> {
    let at = |key: Key| StackEntry::new(key, node.children[(key & LANE_BITS) as usize]);
    let count = hits.lanes.count_ones() as usize;
    match count {
        0 => None,
        1 => Some(node.children[hits.lanes.trailing_zeros() as usize & 7]),
        2..=4 => {
            // Without branches, which would be mispredicted. Missing keys are 0.
            let [a, b, c, d, ..] = hits.keys;
            let less = |a: Key, b: Key| a.wrapping_sub(1).min(b.wrapping_sub(1)).wrapping_add(1);
            let nearest = less(less(a, b), less(c, d));
            let (a, b) = (a.max(b), a.min(b));
            let (c, d) = (c.max(d), c.min(d));
            let (a, c) = (a.max(c), a.min(c));
            let b = b.max(d);
            let (b, c) = (b.max(c), b.min(c));
            stack.push_up_to_3([at(a), at(b), at(c)], count - 1);
            Some(at(nearest).child())
        }
        _ => {
            let mut sorted = hits.keys;
            for i in 1..count {
                let key = sorted[i];
                let mut place = i;
                while place > 0 && sorted[place - 1] < key {
                    sorted[place] = sorted[place - 1];
                    place -= 1;
                }
                sorted[place] = key;
            }
            for &key in &sorted[..count - 1] {
                stack.push(at(key));
            }
            Some(at(sorted[count - 1]).child())
        }
    }
}
// END SOLUTION(part6.task1)
