//! A list of open nodes, the nearest entry taken first.

pub use base::*;
use kit::{Bvh, Hit, NodeKind, Ray, World};

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let root = bvh.nodes.first()?;
    let entry = world.hit_box(&root.bounds, ray)?.min;
    let mut open = vec![(entry, 0_u32)];
    let mut best = None;
    while let Some(i) = (0..open.len()).min_by(|&a, &b| open[a].0.total_cmp(&open[b].0)) {
        let (entry, node) = open.swap_remove(i);
        if entry > ray.max_t {
            break;
        }
        match bvh.nodes[node as usize].kind {
            NodeKind::Interior { left, right } => {
                for child in [left, right] {
                    if let Some(inside) = world.hit_box(&bvh.nodes[child as usize].bounds, ray) {
                        open.push((inside.min, child));
                    }
                }
            }
            NodeKind::Leaf { first, count } => {
                for &id in bvh.leaf(first, count) {
                    best = world.hit_prim(id, ray).or(best);
                }
            }
        }
    }
    best
}
