//! The assignment's recursion: left, then right, boxes pruned by max_t.

pub use base::*;
use kit::{Bvh, Hit, NodeKind, Ray, World};

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    if bvh.nodes.is_empty() {
        return None;
    }
    closest(bvh, 0, ray, world)
}

fn closest<W: World>(bvh: &Bvh, node: u32, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let node = &bvh.nodes[node as usize];
    world.hit_box(&node.bounds, ray)?;
    match node.kind {
        NodeKind::Leaf { first, count } => {
            let mut best = None;
            for &id in bvh.leaf(first, count) {
                if let Some(hit) = world.hit_prim(id, ray) {
                    best = Some(hit);
                }
            }
            best
        }
        NodeKind::Interior { left, right } => {
            let first = closest(bvh, left, ray, world);
            let second = closest(bvh, right, ray, world);
            second.or(first)
        }
    }
}

pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    !bvh.nodes.is_empty() && any(bvh, 0, ray, world)
}

fn any<W: World>(bvh: &Bvh, node: u32, ray: &Ray, world: &mut W) -> bool {
    let node = &bvh.nodes[node as usize];
    if world.hit_box(&node.bounds, ray).is_none() {
        return false;
    }
    match node.kind {
        NodeKind::Leaf { first, count } => bvh.leaf(first, count).iter().any(|&id| world.blocked(id, ray)),
        NodeKind::Interior { left, right } => any(bvh, left, ray, world) || any(bvh, right, ray, world),
    }
}
