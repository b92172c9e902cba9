//! Recursion that returns hits: the nearer child first, the farther one if its box is nearer than
//! the hit.

pub use base::*;
use kit::*;

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let root = bvh.nodes.first()?;
    world.hit_box(&root.bounds, ray)?;
    visit(bvh, 0, ray, world)
}

fn visit<W: World>(bvh: &Bvh, node: u32, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    match bvh.nodes[node as usize].kind {
        NodeKind::Leaf { first, count } => {
            let mut best = None;
            for k in first..first + count {
                let id = bvh.order[k as usize];
                if let Some(hit) = world.hit_prim(id, ray) {
                    best = Some(hit);
                }
            }
            best
        }
        NodeKind::Interior { left, right } => {
            let l = world.hit_box(&bvh.nodes[left as usize].bounds, ray);
            let r = world.hit_box(&bvh.nodes[right as usize].bounds, ray);
            match (l, r) {
                (None, None) => None,
                (Some(_), None) => visit(bvh, left, ray, world),
                (None, Some(_)) => visit(bvh, right, ray, world),
                (Some(l), Some(r)) => {
                    let (near, far, entry) = if l.min <= r.min { (left, right, r.min) } else { (right, left, l.min) };
                    let mut best = visit(bvh, near, ray, world);
                    if entry <= ray.max_t {
                        if let Some(hit) = visit(bvh, far, ray, world) {
                            best = Some(hit);
                        }
                    }
                    best
                }
            }
        }
    }
}
