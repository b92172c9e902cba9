//! Recursion into both children, the hits of both compared.

pub use base::*;
use kit::*;

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    if bvh.nodes.is_empty() {
        return None;
    }
    rec(bvh, 0, ray, world)
}

fn rec<W: World>(bvh: &Bvh, node: u32, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let n = bvh.nodes[node as usize];
    world.hit_box(&n.bounds, ray)?;
    match n.kind {
        NodeKind::Leaf { first, count } => {
            let mut best: Option<Hit> = None;
            for &id in bvh.leaf(first, count) {
                if let Some(hit) = world.hit_prim(id, ray) {
                    best = Some(hit);
                }
            }
            best
        }
        NodeKind::Interior { left, right } => {
            let a = rec(bvh, left, ray, world);
            let b = rec(bvh, right, ray, world);
            match (a, b) {
                (Some(x), Some(y)) => Some(if x.t < y.t { x } else { y }),
                (x, y) => x.or(y),
            }
        }
    }
}

pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    !bvh.nodes.is_empty() && any(bvh, 0, ray, world)
}

fn any<W: World>(bvh: &Bvh, node: u32, ray: &Ray, world: &mut W) -> bool {
    let n = bvh.nodes[node as usize];
    if world.hit_box(&n.bounds, ray).is_none() {
        return false;
    }
    match n.kind {
        NodeKind::Leaf { first, count } => {
            for &id in bvh.leaf(first, count) {
                if world.blocked(id, ray) {
                    return true;
                }
            }
            false
        }
        NodeKind::Interior { left, right } => any(bvh, left, ray, world) || any(bvh, right, ray, world),
    }
}
