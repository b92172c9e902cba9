// BEGIN SOLUTION(part6.task1)
//! One search through the tree, for the closest hit or for any.

use crate::block::{Block, BlockRay};
use crate::lanes::Lanes;
use crate::node::{Below, Child, Node};
use crate::probe::{Plain, Probe};
use crate::sphere_block::SphereBlock;
use crate::stack::{Later, Stack};
use crate::traverse::Work;
use crate::wide::WideBvh;
use fearless_simd::Simd;
use kit::{PrimId, Ray, TriangleHit};

/// One search: the ray, whom to ask, and what was found. `ANY` ends it with the first hit, whichever that is.
pub(crate) struct Search<'a, S: Simd, E, const ANY: bool> {
    simd: S,
    tree: &'a WideBvh,
    left: Option<PrimId>,
    exact: &'a mut E,
    /// Counted here: what is counted elsewhere is read and written once a step.
    work: Work,
    /// As it was given. It is not copied: what has just been written in parts is slow to read in one, and nothing here may
    /// have its address taken, so that it stays in registers.
    ray: &'a Ray,
    /// The end of the ray's range: the closest hit so far.
    max_t: f64,
    /// Since the boxes were last told.
    is_shorter: bool,
    pub(crate) found: Option<(PrimId, TriangleHit)>,
}

impl<'a, S: Simd, E, const ANY: bool> Search<'a, S, E, ANY>
where
    E: FnMut(PrimId, &Ray) -> Option<TriangleHit>,
{
    #[inline(always)]
    pub(crate) fn new(
        simd: S,
        tree: &'a WideBvh,
        ray: &'a Ray,
        left: Option<PrimId>,
        exact: &'a mut E,
    ) -> Self {
        Search {
            simd,
            tree,
            left,
            exact,
            work: Work::default(),
            ray,
            max_t: ray.max_t,
            is_shorter: false,
            found: None,
        }
    }

    #[inline(always)]
    pub(crate) fn run(&mut self, work: &mut Work) {
        if self.tree.nodes.is_empty() {
            self.ask_all();
        } else {
            let space = &self.tree.space;
            match Lanes::new(self.simd, self.ray, space) {
                Some(lanes) => self.walk(lanes),
                None => self.walk(Plain::new(self.ray, space)),
            }
        }
        work.box_tests += self.work.box_tests;
        work.prim_tests += self.work.prim_tests;
    }

    #[inline(always)]
    fn is_over(&self) -> bool {
        ANY && self.found.is_some()
    }

    /// Through the nodes, nearer ones first.
    #[inline(always)]
    fn walk(&mut self, mut probe: impl Probe) {
        let mut later = Stack::new();
        // Made for the first block: many a ray meets none.
        let mut lanes = None;
        let mut next = Some(Child::ROOT);
        while let Some(child) = next {
            next = match child.below() {
                Below::Node(number) => {
                    let node = &self.tree.nodes[number as usize];
                    self.work.box_tests += u64::from(node.count);
                    nearest_first(node, &probe, &mut later)
                }
                Below::Block(number) => {
                    self.ask_block(&self.tree.blocks[number as usize], &mut lanes);
                    None
                }
                Below::Spheres(number) => {
                    self.ask_spheres(&self.tree.spheres[number as usize]);
                    None
                }
            };
            if next.is_none() {
                if self.is_over() {
                    return;
                }
                if self.is_shorter {
                    self.is_shorter = false;
                    probe.shorten(self.max_t);
                }
                next = later.pop_within(&probe);
            }
        }
    }

    /// Without nodes: a few blocks are asked sooner than any box.
    #[inline(always)]
    fn ask_all(&mut self) {
        let mut lanes = None;
        for block in &self.tree.blocks {
            self.ask_block(block, &mut lanes);
            if self.is_over() {
                return;
            }
        }
        for spheres in &self.tree.spheres {
            self.ask_spheres(spheres);
        }
    }

    #[inline(always)]
    fn ask_block(&mut self, block: &Block, lanes: &mut Option<BlockRay>) {
        self.work.prim_tests += u64::from(block.len());
        if lanes.is_none() {
            *lanes = Some(BlockRay::new(self.ray));
        }
        let Some(lanes) = lanes else { return };
        let tested = lanes.test(self.simd, block, self.max_t);
        let mut lanes = tested.hit | tested.unsure;
        while lanes != 0 && !self.is_over() {
            let lane = lanes.trailing_zeros() as usize & 7;
            lanes &= lanes - 1;
            let id = block.id(lane);
            if self.left == Some(id) {
                continue;
            }
            if tested.hit >> lane & 1 == 1 {
                self.keep(id, tested.at(lane));
            } else {
                self.ask(id);
            }
        }
    }

    #[inline(always)]
    fn ask_spheres(&mut self, spheres: &SphereBlock) {
        self.work.prim_tests += u64::from(spheres.len());
        let mut lanes = spheres.candidates(self.simd, self.ray);
        while lanes != 0 && !self.is_over() {
            let lane = lanes.trailing_zeros() as usize & 7;
            lanes &= lanes - 1;
            let id = spheres.id(lane);
            if self.left != Some(id) {
                self.ask(id);
            }
        }
    }

    /// Asks the plain kernel.
    #[inline(always)]
    fn ask(&mut self, id: PrimId) {
        let ray = Ray {
            max_t: self.max_t,
            ..*self.ray
        };
        if let Some(hit) = (self.exact)(id, &ray) {
            self.keep(id, hit);
        }
    }

    /// Takes in a hit in the ray's range: it counts unless an equal one has a lower id.
    #[inline(always)]
    fn keep(&mut self, id: PrimId, hit: TriangleHit) {
        if self
            .found
            .is_none_or(|(best_id, best)| (hit.t, id) < (best.t, best_id))
        {
            self.found = Some((id, hit));
            self.max_t = hit.t;
            self.is_shorter = true;
        }
    }
}

/// The child whose box the ray enters first; the others that it meets go onto the stack, the nearest on top.
#[inline(always)]
fn nearest_first(node: &Node, probe: &impl Probe, later: &mut Stack) -> Option<Child> {
    let met = probe.meet(node);
    let mut lanes = met.lanes;
    let mut take = || {
        let lane = lanes.trailing_zeros() as usize & 7;
        lanes &= lanes.wrapping_sub(1);
        Later::new(met.entries[lane], node.children[lane])
    };
    match met.lanes.count_ones() as usize {
        0 => None,
        1 => Some(take().child()),
        2 => {
            let (a, b) = (take(), take());
            later.push(a.max(b));
            Some(a.min(b).child())
        }
        many => {
            let mut sorted = [Later::NONE; 8];
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
                later.push(farther);
            }
            Some(sorted[many - 1].child())
        }
    }
}
// END SOLUTION(part6.task1)
