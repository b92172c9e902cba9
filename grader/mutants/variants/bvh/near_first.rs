//! Recursion into the nearer child first; the farther one only if it may still be nearer than the
//! hit.

pub use base::*;
use kit::{Bvh, Hit, NodeKind, Ray, World};

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let root = bvh.nodes.first()?;
    world.hit_box(&root.bounds, ray)?;
    let mut best = None;
    walk(bvh, 0, ray, world, &mut best);
    best
}

fn walk<W: World>(bvh: &Bvh, node: u32, ray: &mut Ray, world: &mut W, best: &mut Option<Hit>) {
    match bvh.nodes[node as usize].kind {
        NodeKind::Leaf { first, count } => {
            for &id in bvh.leaf(first, count) {
                if let Some(hit) = world.hit_prim(id, ray) {
                    *best = Some(hit);
                }
            }
        }
        NodeKind::Interior { left, right } => {
            let l = world.hit_box(&bvh.nodes[left as usize].bounds, ray);
            let r = world.hit_box(&bvh.nodes[right as usize].bounds, ray);
            match (l, r) {
                (Some(l), Some(r)) => {
                    let (near, far, far_entry) = if l.min <= r.min { (left, right, r.min) } else { (right, left, l.min) };
                    walk(bvh, near, ray, world, best);
                    if far_entry <= ray.max_t {
                        walk(bvh, far, ray, world, best);
                    }
                }
                (Some(_), None) => walk(bvh, left, ray, world, best),
                (None, Some(_)) => walk(bvh, right, ray, world, best),
                (None, None) => {}
            }
        }
    }
}
