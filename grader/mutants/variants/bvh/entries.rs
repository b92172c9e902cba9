//! A stack of nodes with the t at which the ray enters their boxes, the nearer child on top.

pub use base::*;
use kit::{Bvh, Hit, NodeKind, Ray, World};

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let root = bvh.nodes.first()?;
    let mut best: Option<Hit> = None;
    let mut stack: Vec<(u32, f64)> = Vec::new();
    if let Some(inside) = world.hit_box(&root.bounds, ray) {
        stack.push((0, inside.min));
    }
    while let Some((index, entry)) = stack.pop() {
        if entry > ray.max_t {
            continue;
        }
        match bvh.nodes[index as usize].kind {
            NodeKind::Leaf { first, count } => {
                let from = first as usize;
                let to = from + count as usize;
                for &id in &bvh.order[from..to] {
                    if let Some(hit) = world.hit_prim(id, ray) {
                        best = Some(hit);
                    }
                }
            }
            NodeKind::Interior { left, right } => {
                let mut found = Vec::new();
                for child in [left, right] {
                    if let Some(inside) = world.hit_box(&bvh.nodes[child as usize].bounds, ray) {
                        found.push((child, inside.min));
                    }
                }
                found.sort_by(|a, b| b.1.total_cmp(&a.1));
                stack.extend(found);
            }
        }
    }
    best
}

pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    let mut stack = vec![];
    if !bvh.nodes.is_empty() {
        stack.push(0);
    }
    while let Some(index) = stack.pop() {
        let node = &bvh.nodes[index as usize];
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
