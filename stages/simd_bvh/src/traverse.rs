//! Walking: the closest hit and any hit, the same that asking every primitive would give.

// BEGIN SOLUTION(part6.task1)
use crate::block::BlockRay;
use crate::node::{Below, Child, Node};
use crate::ray_boxes::{Boxes, Lanes, Plain};
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
        let search = Search {
            tree: self,
            left,
            exact,
            work,
        };
        dispatch!(self.level, simd => search.closest(simd, ray))
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
        let search = Search {
            tree: self,
            left,
            exact,
            work,
        };
        dispatch!(self.level, simd => search.any(simd, ray))
        // STUB: kit::hole!("part6.task1", self, ray, left, exact, work)
        // END SOLUTION(part6.task1)
    }
}

// BEGIN SOLUTION(part6.task1)
/// One walk: the tree, whom to ask, and what it took.
struct Search<'a, E> {
    tree: &'a WideBvh,
    left: Option<PrimId>,
    exact: &'a mut E,
    work: &'a mut Work,
}

impl<E: FnMut(PrimId, &Ray) -> Option<f64>> Search<'_, E> {
    #[inline(always)]
    fn closest<S: Simd>(self, simd: S, ray: &Ray) -> Option<(PrimId, f64)> {
        match Lanes::new(simd, ray) {
            Some(boxes) => self.closest_by(simd, ray, boxes),
            None => self.closest_by(simd, ray, Plain::new(ray)),
        }
    }

    #[inline(always)]
    fn any<S: Simd>(self, simd: S, ray: &Ray) -> bool {
        match Lanes::new(simd, ray) {
            Some(boxes) => self.any_by(simd, ray, boxes),
            None => self.any_by(simd, ray, Plain::new(ray)),
        }
    }

    #[inline(always)]
    fn closest_by<S: Simd>(
        self,
        simd: S,
        ray: &Ray,
        mut boxes: impl Boxes,
    ) -> Option<(PrimId, f64)> {
        let mut ray = *ray;
        let triangles = BlockRay::new(simd, &ray);
        let mut best: Option<(PrimId, f64)> = None;
        let mut later = Stack::new();
        let mut next = self.tree.root();
        while let Some(child) = next {
            next = match child.below() {
                Below::Node(number) => {
                    let node = &self.tree.nodes[number as usize];
                    self.work.box_tests += u64::from(node.count);
                    nearest_first(node, &boxes, &mut later)
                }
                Below::Block(number) => {
                    let block = &self.tree.blocks[number as usize];
                    self.work.prim_tests += u64::from(block.len());
                    let tested = triangles.test(simd, block, ray.max_t);
                    let mut lanes = tested.hit | tested.unsure;
                    while lanes != 0 {
                        let lane = lanes.trailing_zeros() as usize;
                        lanes &= lanes - 1;
                        let id = block.id(lane);
                        if self.left == Some(id) {
                            continue;
                        }
                        let t = if tested.hit >> lane & 1 == 1 {
                            Some(tested.t[lane])
                        } else {
                            (self.exact)(id, &ray)
                        };
                        keep(&mut best, &mut ray, id, t);
                    }
                    boxes.shorten(ray.max_t);
                    None
                }
                Below::Sphere(id) => {
                    if self.left != Some(id) {
                        self.work.prim_tests += 1;
                        let t = (self.exact)(id, &ray);
                        keep(&mut best, &mut ray, id, t);
                        boxes.shorten(ray.max_t);
                    }
                    None
                }
            };
            if next.is_none() {
                next = later.pop_within(&boxes);
            }
        }
        best
    }

    #[inline(always)]
    fn any_by<S: Simd>(self, simd: S, ray: &Ray, boxes: impl Boxes) -> bool {
        let triangles = BlockRay::new(simd, ray);
        let mut later = Stack::new();
        let mut next = self.tree.root();
        while let Some(child) = next {
            next = match child.below() {
                Below::Node(number) => {
                    let node = &self.tree.nodes[number as usize];
                    self.work.box_tests += u64::from(node.count);
                    nearest_first(node, &boxes, &mut later)
                }
                Below::Block(number) => {
                    let block = &self.tree.blocks[number as usize];
                    self.work.prim_tests += u64::from(block.len());
                    let tested = triangles.test(simd, block, ray.max_t);
                    let mut lanes = tested.hit | tested.unsure;
                    while lanes != 0 {
                        let lane = lanes.trailing_zeros() as usize;
                        lanes &= lanes - 1;
                        let id = block.id(lane);
                        if self.left == Some(id) {
                            continue;
                        }
                        if tested.hit >> lane & 1 == 1 || (self.exact)(id, ray).is_some() {
                            return true;
                        }
                    }
                    None
                }
                Below::Sphere(id) => {
                    if self.left != Some(id) {
                        self.work.prim_tests += 1;
                        if (self.exact)(id, ray).is_some() {
                            return true;
                        }
                    }
                    None
                }
            };
            if next.is_none() {
                next = later.pop_within(&boxes);
            }
        }
        false
    }
}

/// Takes in a hit at `t`, which is in the ray's range: it counts unless an equal one has a lower id.
#[inline(always)]
fn keep(best: &mut Option<(PrimId, f64)>, ray: &mut Ray, id: PrimId, t: Option<f64>) {
    if let Some(t) = t
        && best.is_none_or(|(best_id, best_t)| (t, id) < (best_t, best_id))
    {
        *best = Some((id, t));
        ray.max_t = t;
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

impl WideBvh {
    #[inline(always)]
    fn root(&self) -> Option<Child> {
        (!self.nodes.is_empty()).then_some(Child(0))
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
    const NEAR: usize = 64;

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
