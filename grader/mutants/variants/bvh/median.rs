//! Split at the median along the largest extent.

pub use base::*;
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId};

pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    let mut bvh = Bvh { nodes: Vec::new(), order: Vec::new() };
    if !bounds.is_empty() {
        let prims: Vec<u32> = (0..bounds.len() as u32).collect();
        build(&mut bvh, bounds, prims, max_leaf_size.max(1));
    }
    bvh
}

fn build(bvh: &mut Bvh, bounds: &[Aabb], mut prims: Vec<u32>, max_leaf_size: usize) -> u32 {
    let mut bb = Aabb::EMPTY;
    let mut centroids = Aabb::EMPTY;
    for &p in &prims {
        let b = bounds[p as usize];
        if !b.is_empty() {
            bb = bb.union(b);
            centroids = centroids.grown_by(b.centroid());
        }
    }
    let node = bvh.nodes.len() as u32;
    let first = bvh.order.len() as u32;
    let count = prims.len() as u32;
    bvh.nodes.push(BvhNode { bounds: bb, kind: NodeKind::Leaf { first, count } });
    if prims.len() <= max_leaf_size {
        bvh.order.extend(prims.iter().map(|&p| PrimId(p)));
        return node;
    }
    let axis = centroids.extent().max_position();
    prims.sort_by(|&a, &b| {
        let (a, b) = (bounds[a as usize].centroid(), bounds[b as usize].centroid());
        a[axis].total_cmp(&b[axis])
    });
    let right = prims.split_off(prims.len() / 2);
    let left = prims;
    let l = build(bvh, bounds, left, max_leaf_size);
    let r = build(bvh, bounds, right, max_leaf_size);
    bvh.nodes[node as usize].kind = NodeKind::Interior { left: l, right: r };
    node
}
