//! A stack of nodes; a box is tested when it is popped.

pub use base::*;
use kit::{Bvh, Hit, NodeKind, Ray, World};

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let mut best: Option<Hit> = None;
    let mut todo: Vec<u32> = if bvh.nodes.is_empty() { vec![] } else { vec![0] };
    while let Some(i) = todo.pop() {
        let node = &bvh.nodes[i as usize];
        if world.hit_box(&node.bounds, ray).is_none() {
            continue;
        }
        match node.kind {
            NodeKind::Interior { left, right } => todo.extend([right, left]),
            NodeKind::Leaf { first, count } => {
                for id in bvh.leaf(first, count) {
                    best = world.hit_prim(*id, ray).or(best);
                }
            }
        }
    }
    best
}

pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    let mut todo: Vec<u32> = if bvh.nodes.is_empty() { vec![] } else { vec![0] };
    while let Some(i) = todo.pop() {
        let node = &bvh.nodes[i as usize];
        if world.hit_box(&node.bounds, ray).is_some() {
            match node.kind {
                NodeKind::Interior { left, right } => todo.extend([left, right]),
                NodeKind::Leaf { first, count } => {
                    for &id in bvh.leaf(first, count) {
                        if world.blocked(id, ray) {
                            return true;
                        }
                    }
                }
            }
        }
    }
    false
}
