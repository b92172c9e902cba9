//! No stack: the nodes in depth-first order, each with the next node to visit if its box is missed
//! (Smits, "Efficiency Issues for Ray Tracing", 1998).

pub use base::*;
use kit::{Bvh, Hit, NodeKind, Ray, World};

/// The nodes in depth-first order, each with the number of places to skip to pass its whole
/// subtree.
fn thread(bvh: &Bvh) -> Vec<(usize, usize)> {
    fn add(bvh: &Bvh, node: usize, list: &mut Vec<(usize, usize)>) {
        let place = list.len();
        list.push((node, 1));
        if let NodeKind::Interior { left, right } = bvh.nodes[node].kind {
            add(bvh, left as usize, list);
            add(bvh, right as usize, list);
            list[place].1 = list.len() - place;
        }
    }
    let mut list = Vec::new();
    if !bvh.nodes.is_empty() {
        add(bvh, 0, &mut list);
    }
    list
}

pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let list = thread(bvh);
    let mut closest = None;
    let mut place = 0;
    while let Some(&(node, skip)) = list.get(place) {
        let node = &bvh.nodes[node];
        if world.hit_box(&node.bounds, ray).is_none() {
            place += skip;
            continue;
        }
        if let NodeKind::Leaf { first, count } = node.kind {
            for &id in bvh.leaf(first, count) {
                closest = world.hit_prim(id, ray).or(closest);
            }
        }
        place += 1;
    }
    closest
}

pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    let list = thread(bvh);
    let mut place = 0;
    while let Some(&(node, skip)) = list.get(place) {
        let node = &bvh.nodes[node];
        if world.hit_box(&node.bounds, ray).is_none() {
            place += skip;
            continue;
        }
        if let NodeKind::Leaf { first, count } = node.kind
            && bvh.leaf(first, count).iter().any(|id| world.blocked(*id, ray))
        {
            return true;
        }
        place += 1;
    }
    false
}
