//! Task 3: walking the tree with a ray, for the closest hit and for any hit.

// BEGIN SOLUTION(part2.task3)
use kit::{Aabb, NodeKind, PrimId};
use std::ops::ControlFlow;
// END SOLUTION(part2.task3)

use kit::{Bvh, Hit, Ray, World};

/// The closest hit of `ray` with the primitives of `bvh`, the same that asking every primitive would give.
///
/// Asks `world` for a node's box before it goes below, and goes on below the nearer of two boxes first, so that the
/// farther one is often out of range by its turn. On a hit `ray.max_t` is the hit's `t`; a miss changes nothing.
/// Both ends of the ray's range count. Of hits at equal `t` the one with the lowest id is given.
pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    // BEGIN SOLUTION(part2.task3)
    let mut closest: Option<Hit> = None;
    visit_leaves(bvh, ray, world, |prims, ray, world| {
        for &id in prims {
            // What hits lies in the ray's range, so no farther than `closest`; at equal `t` the ids decide.
            if let Some(hit) = world.hit_prim(id, ray)
                && closest.is_none_or(|c| (hit.t, hit.prim) < (c.t, c.prim))
            {
                closest = Some(hit);
            }
        }
        ControlFlow::Continue(())
    });
    closest
    // STUB: // Works, but slowly: asks every primitive, and no box.
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

/// Whether any primitive of `bvh` blocks `ray` in its range. Stops at the first that does.
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
    // STUB: // Works, but slowly: asks every primitive, and no box.
    // STUB: kit::untouched!("part2.task3");
    // STUB: bvh.order.iter().any(|&id| world.blocked(id, ray))
    // END SOLUTION(part2.task3)
}

// BEGIN SOLUTION(part2.task3)
/// By how much a ray's range is widened for boxes, relative to its ends and to the largest coordinate that it meets.
///
/// A box's entry and a primitive's `t` are rounded in different ways, so a primitive may come out a little nearer
/// than its own box. Of 2.4 million rays at triangles that overlap in one plane some went wrong with ε to spare, none
/// with 4 ε; 64 ε leave room for other kernels and are still too little to visit a box for nothing. Near `t = 0` a
/// share of `t` is nothing, but vertices are rounded as everywhere.
const SLACK: f64 = 64.0 * f64::EPSILON;

/// The largest coordinate of the ray's origin and of all primitives, in units of `t`.
#[inline]
fn reach(everything: &Aabb, ray: &Ray) -> f64 {
    let corners = everything.min.abs().max(everything.max.abs());
    corners.max(ray.o.abs()).max_element() / ray.d.abs().max_element()
}

/// Calls `leaf` with the primitives of every leaf whose box `ray` meets, nearer boxes first, until `leaf` breaks off.
/// `leaf` may shorten the ray; boxes beyond its new end are skipped.
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
    // Boxes get a ray of their own that nothing else can change: so the compiler divides by `d` once a ray.
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
    let mut later = Stack::new();
    let mut node = 0;
    loop {
        let next = match bvh.nodes[node as usize].kind {
            NodeKind::Interior { left, right } => {
                let in_left = world.hit_box(&bvh.nodes[left as usize].bounds, &probe);
                let in_right = world.hit_box(&bvh.nodes[right as usize].bounds, &probe);
                match (in_left, in_right) {
                    (Some(l), Some(r)) if l.min <= r.min => {
                        later.push(right, r.min);
                        Some(left)
                    }
                    (Some(l), Some(_)) => {
                        later.push(left, l.min);
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
        node = match next.or_else(|| later.pop_within(probe.max_t)) {
            Some(next) => next,
            None => return,
        };
    }
}

/// A node to visit later, and where the ray enters its box.
#[derive(Clone, Copy)]
struct Later {
    node: u32,
    entry: f64,
}

/// Nodes to visit later, last in first out. Only a tree deeper than any that [`construct_bvh`](crate::construct_bvh)
/// builds from an ordinary mesh reaches beyond the array, and so to the heap.
struct Stack {
    first: [Later; Stack::NEAR],
    len: usize,
    beyond: Vec<Later>,
}

impl Stack {
    /// Places that need no heap.
    const NEAR: usize = 32;

    fn new() -> Stack {
        let unread = Later {
            node: 0,
            entry: 0.0,
        };
        Stack {
            first: [unread; Stack::NEAR],
            len: 0,
            beyond: Vec::new(),
        }
    }

    #[inline]
    fn push(&mut self, node: u32, entry: f64) {
        match self.first.get_mut(self.len) {
            Some(place) => {
                *place = Later { node, entry };
                self.len += 1;
            }
            None => self.beyond.push(Later { node, entry }),
        }
    }

    #[inline]
    fn pop(&mut self) -> Option<Later> {
        if self.len == Stack::NEAR
            && let Some(later) = self.beyond.pop()
        {
            return Some(later);
        }
        self.len = self.len.checked_sub(1)?;
        Some(self.first[self.len])
    }

    /// Takes nodes off until one is entered at `max_t` or before.
    #[inline]
    fn pop_within(&mut self, max_t: f64) -> Option<u32> {
        while let Some(later) = self.pop() {
            if later.entry <= max_t {
                return Some(later.node);
            }
        }
        None
    }
}
// END SOLUTION(part2.task3)
