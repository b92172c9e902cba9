//! Part 2, task 3: traversal of the tree, for the closest hit and for any hit.

// BEGIN SOLUTION(part2.task3)
use kit::{Aabb, NodeKind, PrimId};
use std::ops::ControlFlow;
// END SOLUTION(part2.task3)

use kit::{Bvh, Hit, Ray, World};

/// Returns the closest hit of `ray` with the primitives of `bvh`. The result is the same as that of
/// testing every primitive.
///
/// Chapter: stages/book/src/part2/task3.md
///
/// Tests a node's box with `world` before it visits the node. If both children are hit, visits the
/// nearer one first, so that the farther one is often out of range afterwards. Visiting the left
/// child first is accepted, too. On a hit sets `ray.max_t` to its `t`; a miss changes nothing. Both
/// ends of the ray's range count. Of several hits with equal `t` it may return any; the reference
/// returns the one with the lowest id.
///
/// See it: `cargo grader picture part2.task3`.
pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    // BEGIN SOLUTION(part2.task3)
    let mut closest: Option<Hit> = None;
    visit_leaves(bvh, ray, world, |prims, ray, world| {
        for &id in prims {
            // A hit is in the ray's range, so it is not farther than `closest`. For equal `t` the
            // ids decide.
            if let Some(hit) = world.hit_prim(id, ray)
                && closest.is_none_or(|c| (hit.t, hit.prim) < (c.t, c.prim))
            {
                closest = Some(hit);
            }
        }
        ControlFlow::Continue(())
    });
    closest
    // STUB: // Works, but slowly: tests every primitive, and no box.
    // STUB: kit::untouched!("part2.task3");
    // STUB: let mut closest = None;
    // STUB: for &id in &bvh.order {
    // STUB:     if let Some(hit) = world.hit_prim(id, ray) {
    // STUB:         closest = Some(hit);
    // STUB:     }
    // STUB: }
    // STUB: closest
    // END SOLUTION(part2.task3)
}

/// Whether any primitive of `bvh` blocks `ray` in its range. Stops at the first one that does.
///
/// Chapter: stages/book/src/part2/task3.md
///
/// See it: `cargo grader picture part2.task3`.
pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    // BEGIN SOLUTION(part2.task3)
    let mut blocked = false;
    visit_leaves(bvh, &mut { *ray }, world, |prims, ray, world| {
        blocked = prims.iter().any(|&id| world.blocked(id, ray));
        if blocked {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    blocked
    // STUB: // Works, but slowly: tests every primitive, and no box.
    // STUB: kit::untouched!("part2.task3");
    // STUB: bvh.order.iter().any(|&id| world.blocked(id, ray))
    // END SOLUTION(part2.task3)
}

// BEGIN SOLUTION(part2.task3)
/// Amount by which a ray's range is extended for box tests, relative to its ends and to the largest
/// coordinate.
///
/// A box's entry and a primitive's `t` have different rounding errors, so a primitive may be
/// computed slightly nearer than its own box.
///
/// In a test with 2.4 million rays at overlapping triangles in one plane, an extension by ε lost
/// hits, and an extension by 4 ε lost none. 64 ε leave a margin for other kernels, and hardly a box
/// is visited needlessly. The part relative to coordinates is for `t` near 0, where vertices have
/// the same rounding errors.
const SLACK: f64 = 64.0 * f64::EPSILON;

/// The largest coordinate of the ray's origin and of all primitives, divided by the largest
/// component of `d`: a distance in units of `t`.
#[inline]
fn reach(scene_bounds: &Aabb, ray: &Ray) -> f64 {
    let corners = scene_bounds.min.abs().max(scene_bounds.max.abs());
    corners.max(ray.o.abs()).max_element() / ray.d.abs().max_element()
}

/// Calls `leaf` with the primitives of every leaf whose box `ray` hits, nearer boxes first, until
/// it returns `Break`. `leaf` may shorten the ray; boxes beyond the new end are skipped.
#[inline]
fn visit_leaves<W: World>(
    bvh: &Bvh,
    ray: &mut Ray,
    world: &mut W,
    mut leaf: impl FnMut(&[PrimId], &mut Ray, &mut W) -> ControlFlow<()>,
) {
    let Some(root) = bvh.nodes.first() else {
        return;
    };
    // Box tests use a copy of the ray that `leaf` cannot change, so the compiler computes `1/d`
    // once for each ray.
    let reach = reach(&root.bounds, ray);
    let slack = |t: f64| SLACK * (t.abs() + reach);
    let mut probe = Ray {
        min_t: ray.min_t - slack(ray.min_t),
        max_t: ray.max_t + slack(ray.max_t),
        ..*ray
    };
    if world.hit_box(&root.bounds, &probe).is_none() {
        return;
    }
    let mut stack = Stack::new();
    let mut node = 0;
    loop {
        let next = match bvh.nodes[node as usize].kind {
            NodeKind::Interior { left, right } => {
                let in_left = world.hit_box(&bvh.nodes[left as usize].bounds, &probe);
                let in_right = world.hit_box(&bvh.nodes[right as usize].bounds, &probe);
                match (in_left, in_right) {
                    (Some(l), Some(r)) if l.min <= r.min => {
                        stack.push(right, r.min);
                        Some(left)
                    }
                    (Some(l), Some(_)) => {
                        stack.push(left, l.min);
                        Some(right)
                    }
                    (Some(_), None) => Some(left),
                    (None, Some(_)) => Some(right),
                    (None, None) => None,
                }
            }
            NodeKind::Leaf { first, count } => {
                if leaf(bvh.leaf(first, count), ray, world).is_break() {
                    return;
                }
                probe.max_t = ray.max_t + slack(ray.max_t);
                None
            }
        };
        node = match next.or_else(|| stack.pop_within(probe.max_t)) {
            Some(next) => next,
            None => return,
        };
    }
}

/// A node that is still to be visited, and the distance at which the ray enters its box.
#[derive(Clone, Copy)]
struct PendingNode {
    node: u32,
    entry: f64,
}

/// A stack of pending nodes. It uses the heap only for trees deeper than those that
/// [`construct_bvh`](crate::construct_bvh) builds from ordinary meshes.
struct Stack {
    inline: [PendingNode; Stack::INLINE],
    len: usize,
    spilled: Vec<PendingNode>,
}

impl Stack {
    /// Number of entries that need no heap.
    const INLINE: usize = 32;

    fn new() -> Stack {
        let unused = PendingNode {
            node: 0,
            entry: 0.0,
        };
        Stack {
            inline: [unused; Stack::INLINE],
            len: 0,
            spilled: Vec::new(),
        }
    }

    #[inline]
    fn push(&mut self, node: u32, entry: f64) {
        match self.inline.get_mut(self.len) {
            Some(slot) => {
                *slot = PendingNode { node, entry };
                self.len += 1;
            }
            None => self.spilled.push(PendingNode { node, entry }),
        }
    }

    #[inline]
    fn pop(&mut self) -> Option<PendingNode> {
        if self.len == Stack::INLINE
            && let Some(pending) = self.spilled.pop()
        {
            return Some(pending);
        }
        self.len = self.len.checked_sub(1)?;
        Some(self.inline[self.len])
    }

    /// Pops nodes until one has an entry of at most `max_t`.
    #[inline]
    fn pop_within(&mut self, max_t: f64) -> Option<u32> {
        while let Some(pending) = self.pop() {
            if pending.entry <= max_t {
                return Some(pending.node);
            }
        }
        None
    }
}
// END SOLUTION(part2.task3)
