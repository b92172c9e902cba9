//! A heap of open nodes, the nearest entry taken first: for the closest hit and for any hit.

pub use base::*;
use kit::{Bvh, Hit, NodeKind, PrimId, Ray, World};
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::ops::ControlFlow;

struct OpenNode {
    entry: f64,
    node: u32,
}

impl Ord for OpenNode {
    fn cmp(&self, other: &Self) -> Ordering {
        // The heap takes the largest first.
        other.entry.total_cmp(&self.entry)
    }
}

impl PartialOrd for OpenNode {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for OpenNode {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for OpenNode {}

fn nearest_first<W: World>(
    bvh: &Bvh,
    ray: &mut Ray,
    world: &mut W,
    mut leaf: impl FnMut(&[PrimId], &mut Ray, &mut W) -> ControlFlow<()>,
) {
    let mut open = BinaryHeap::new();
    if let Some(root) = bvh.nodes.first()
        && let Some(inside) = world.hit_box(&root.bounds, ray)
    {
        open.push(OpenNode { entry: inside.min, node: 0 });
    }
    while let Some(OpenNode { entry, node }) = open.pop() {
        if entry > ray.max_t {
            return;
        }
        match bvh.nodes[node as usize].kind {
            NodeKind::Leaf { first, count } => {
                if leaf(bvh.leaf(first, count), ray, world).is_break() {
                    return;
                }
            }
            NodeKind::Interior { left, right } => {
                for child in [left, right] {
                    if let Some(inside) = world.hit_box(&bvh.nodes[child as usize].bounds, ray) {
                        open.push(OpenNode { entry: inside.min, node: child });
                    }
                }
            }
        }
    }
}

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let mut nearest = None;
    nearest_first(bvh, ray, world, |prims, ray, world| {
        for &id in prims {
            nearest = world.hit_prim(id, ray).or(nearest);
        }
        ControlFlow::Continue(())
    });
    nearest
}

pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    let mut is_blocked = false;
    let mut ray = *ray;
    nearest_first(bvh, &mut ray, world, |prims, ray, world| {
        is_blocked = prims.iter().any(|&id| world.blocked(id, ray));
        match is_blocked {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    is_blocked
}
