//! A stack of indices; the places of a leaf counted one by one.

pub use base::*;
use kit::*;

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let mut best: Option<Hit> = None;
    if bvh.nodes.is_empty() {
        return None;
    }
    let mut stack = vec![0];
    while let Some(i) = stack.pop() {
        let node = bvh.nodes[i as usize];
        if world.hit_box(&node.bounds, ray).is_none() {
            continue;
        }
        match node.kind {
            NodeKind::Interior { left, right } => {
                stack.push(right);
                stack.push(left);
            }
            NodeKind::Leaf { first, count } => {
                for k in first..first + count {
                    let id = bvh.order[k as usize];
                    if let Some(hit) = world.hit_prim(id, ray) {
                        best = Some(hit);
                    }
                }
            }
        }
    }
    best
}

pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    if bvh.nodes.is_empty() {
        return false;
    }
    let mut stack = vec![0];
    while let Some(i) = stack.pop() {
        let node = bvh.nodes[i as usize];
        if world.hit_box(&node.bounds, ray).is_none() {
            continue;
        }
        match node.kind {
            NodeKind::Interior { left, right } => {
                stack.push(right);
                stack.push(left);
            }
            NodeKind::Leaf { first, count } => {
                for k in first..first + count {
                    if world.blocked(bvh.order[k as usize], ray) {
                        return true;
                    }
                }
            }
        }
    }
    false
}
