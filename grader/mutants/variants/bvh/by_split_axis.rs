//! The order of the children follows from the sign of the direction on the axis on which the
//! centroids of their boxes are farthest apart.

pub use base::*;
use kit::{Bvh, Hit, NodeKind, Ray, World};

/// The two children; the one that a ray along `d` reaches first comes first.
fn ordered(bvh: &Bvh, left: u32, right: u32, d: kit::Vec3) -> [u32; 2] {
    let apart = bvh.nodes[right as usize].bounds.centroid() - bvh.nodes[left as usize].bounds.centroid();
    let axis = apart.abs().max_position();
    if apart[axis] * d[axis] >= 0.0 { [left, right] } else { [right, left] }
}

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let mut best = None;
    let mut open = Vec::from_iter((!bvh.nodes.is_empty()).then_some(0));
    while let Some(node) = open.pop() {
        let node = &bvh.nodes[node as usize];
        if world.hit_box(&node.bounds, ray).is_none() {
            continue;
        }
        match node.kind {
            NodeKind::Leaf { first, count } => {
                for &id in bvh.leaf(first, count) {
                    best = world.hit_prim(id, ray).or(best);
                }
            }
            NodeKind::Interior { left, right } => {
                let [near, far] = ordered(bvh, left, right, ray.d);
                open.extend([far, near]);
            }
        }
    }
    best
}

pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    let mut open = Vec::from_iter((!bvh.nodes.is_empty()).then_some(0));
    while let Some(node) = open.pop() {
        let node = &bvh.nodes[node as usize];
        if world.hit_box(&node.bounds, ray).is_none() {
            continue;
        }
        match node.kind {
            NodeKind::Leaf { first, count } => {
                if bvh.leaf(first, count).iter().any(|&id| world.blocked(id, ray)) {
                    return true;
                }
            }
            NodeKind::Interior { left, right } => {
                let [near, far] = ordered(bvh, left, right, ray.d);
                open.extend([far, near]);
            }
        }
    }
    false
}
