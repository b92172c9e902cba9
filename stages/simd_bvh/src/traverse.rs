//! Walking: the closest hit and any hit, the same that asking every primitive would give.

// BEGIN SOLUTION(part6.task1)
use crate::block::{Block, BlockRay};
use crate::node::{Below, Child, Node};
use crate::ray_boxes::{Boxes, Lanes, Plain};
use crate::sphere_block::SphereBlock;
use fearless_simd::{Simd, dispatch};
// END SOLUTION(part6.task1)
use crate::wide::WideBvh;
use kit::{PrimId, Ray};

/// What a walk took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Boxes tested: the children of every node on the way.
    pub box_tests: u64,
    /// Triangles and spheres tested.
    pub prim_tests: u64,
}

impl WideBvh {
    /// The closest hit in the ray's range: of which primitive, and its `t`. Of hits at equal `t` the one with the lowest id.
    ///
    /// `left` is passed over. `exact` is the plain kernel: the `t` of a ray's hit with a primitive in the ray's range. It is
    /// asked about spheres, and about triangles where the lanes are not sure. The answer is that of asking it about
    /// every primitive, bit for bit.
    #[inline]
    pub fn closest(
        &self,
        ray: &Ray,
        left: Option<PrimId>,
        exact: &mut impl FnMut(PrimId, &Ray) -> Option<f64>,
        work: &mut Work,
    ) -> Option<(PrimId, f64)> {
        // BEGIN SOLUTION(part6.task1)
        dispatch!(self.level, simd => {
            Search::<_, _, false>::new(simd, self, ray, left, exact, work).run()
        })
        // STUB: kit::hole!("part6.task1", self, ray, left, exact, work)
        // END SOLUTION(part6.task1)
    }

    /// Whether anything but `left` is in the ray's range. Stops at the first that is found. `exact` as for
    /// [`WideBvh::closest`].
    #[inline]
    pub fn occluded(
        &self,
        ray: &Ray,
        left: Option<PrimId>,
        exact: &mut impl FnMut(PrimId, &Ray) -> Option<f64>,
        work: &mut Work,
    ) -> bool {
        // BEGIN SOLUTION(part6.task1)
        dispatch!(self.level, simd => {
            Search::<_, _, true>::new(simd, self, ray, left, exact, work).run()
        })
        .is_some()
        // STUB: kit::hole!("part6.task1", self, ray, left, exact, work)
        // END SOLUTION(part6.task1)
    }
}

// BEGIN SOLUTION(part6.task1)
/// One search: the ray, whom to ask, and what was found. `ANY` ends it with the first hit, whichever that is.
struct Search<'a, S: Simd, E, const ANY: bool> {
    simd: S,
    tree: &'a WideBvh,
    left: Option<PrimId>,
    exact: &'a mut E,
    work: &'a mut Work,
    /// Shortened to the closest hit so far.
    ray: Ray,
    lanes: BlockRay<S>,
    found: Option<(PrimId, f64)>,
}

impl<'a, S: Simd, E, const ANY: bool> Search<'a, S, E, ANY>
where
    E: FnMut(PrimId, &Ray) -> Option<f64>,
{
    #[inline(always)]
    fn new(
        simd: S,
        tree: &'a WideBvh,
        ray: &Ray,
        left: Option<PrimId>,
        exact: &'a mut E,
        work: &'a mut Work,
    ) -> Self {
        Search {
            simd,
            tree,
            left,
            exact,
            work,
            ray: *ray,
            lanes: BlockRay::new(simd, ray),
            found: None,
        }
    }

    #[inline(always)]
    fn run(mut self) -> Option<(PrimId, f64)> {
        if self.tree.nodes.is_empty() {
            self.ask_all();
        } else if let Some(boxes) = Lanes::new(self.simd, &self.ray) {
            self.walk(boxes);
        } else {
            self.walk(Plain::new(&self.ray));
        }
        self.found
    }

    #[inline(always)]
    fn is_over(&self) -> bool {
        ANY && self.found.is_some()
    }

    /// Through the nodes, nearer ones first.
    #[inline(always)]
    fn walk(&mut self, mut boxes: impl Boxes) {
        let mut later = Stack::new();
        let mut next = Some(Child::ROOT);
        while let Some(child) = next {
            next = match child.below() {
                Below::Node(number) => {
                    let node = &self.tree.nodes[number as usize];
                    self.work.box_tests += u64::from(node.count);
                    nearest_first(node, &boxes, &mut later)
                }
                Below::Block(number) => {
                    self.ask_block(&self.tree.blocks[number as usize]);
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
                boxes.shorten(self.ray.max_t);
                next = later.pop_within(&boxes);
            }
        }
    }

    /// Without nodes: a few blocks are asked sooner than any box.
    #[inline(always)]
    fn ask_all(&mut self) {
        for block in &self.tree.blocks {
            self.ask_block(block);
            if self.is_over() {
                return;
            }
        }
        for spheres in &self.tree.spheres {
            self.ask_spheres(spheres);
        }
    }

    #[inline(always)]
    fn ask_block(&mut self, block: &Block) {
        self.work.prim_tests += u64::from(block.len());
        let tested = self.lanes.test(self.simd, block, self.ray.max_t);
        let mut lanes = tested.hit | tested.unsure;
        while lanes != 0 && !self.is_over() {
            let lane = lanes.trailing_zeros() as usize & 7;
            lanes &= lanes - 1;
            let id = block.id(lane);
            if self.left == Some(id) {
                continue;
            }
            if tested.hit >> lane & 1 == 1 {
                self.keep(id, tested.t[lane]);
            } else {
                self.ask(id);
            }
        }
    }

    #[inline(always)]
    fn ask_spheres(&mut self, spheres: &SphereBlock) {
        self.work.prim_tests += u64::from(spheres.len());
        let mut lanes = spheres.candidates(self.simd, &self.ray);
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
        if let Some(t) = (self.exact)(id, &self.ray) {
            self.keep(id, t);
        }
    }

    /// Takes in a hit at `t`, which is in the ray's range: it counts unless an equal one has a lower id.
    #[inline(always)]
    fn keep(&mut self, id: PrimId, t: f64) {
        if self
            .found
            .is_none_or(|(best_id, best_t)| (t, id) < (best_t, best_id))
        {
            self.found = Some((id, t));
            self.ray.max_t = t;
        }
    }
}

/// The child whose box the ray enters first; the others that it meets go onto the stack, the nearest on top.
#[inline(always)]
fn nearest_first(node: &Node, boxes: &impl Boxes, later: &mut Stack) -> Option<Child> {
    let met = boxes.meet(node);
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
            let mut sorted = [Later(0); 8];
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

/// A child to visit later: where the ray enters it in the upper half, so that numbers are in that order, and which it is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Later(u64);

impl Later {
    #[inline(always)]
    fn new(entry: u32, child: Child) -> Later {
        Later(u64::from(entry) << 32 | u64::from(child.0))
    }

    #[inline(always)]
    fn child(self) -> Child {
        Child(self.0 as u32)
    }

    #[inline(always)]
    fn entry(self) -> u32 {
        (self.0 >> 32) as u32
    }
}

/// Children to visit later, last in first out. Few trees are so deep that more than the array is needed.
struct Stack {
    first: [Later; Stack::NEAR],
    len: usize,
    beyond: Vec<Later>,
}

impl Stack {
    /// Places that need no heap.
    const NEAR: usize = 32;

    #[inline(always)]
    fn new() -> Stack {
        Stack {
            first: [Later(0); Stack::NEAR],
            len: 0,
            beyond: Vec::new(),
        }
    }

    #[inline(always)]
    fn push(&mut self, later: Later) {
        match self.first.get_mut(self.len) {
            Some(place) => {
                *place = later;
                self.len += 1;
            }
            None => self.beyond.push(later),
        }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<Later> {
        if self.len == Stack::NEAR
            && let Some(later) = self.beyond.pop()
        {
            return Some(later);
        }
        self.len = self.len.checked_sub(1)?;
        Some(self.first[self.len])
    }

    /// Takes children off until one is still within the range.
    #[inline(always)]
    fn pop_within(&mut self, boxes: &impl Boxes) -> Option<Child> {
        while let Some(later) = self.pop() {
            if boxes.is_within(later.entry()) {
                return Some(later.child());
            }
        }
        None
    }
}
// END SOLUTION(part6.task1)
