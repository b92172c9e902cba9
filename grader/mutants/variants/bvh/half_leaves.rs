//! The median along the longest side of the node's box; leaves at most half as large as allowed.

pub use base::*;
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId};

pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    let mut bvh = Bvh::default();
    let mut ids: Vec<u32> = (0..bounds.len() as u32).collect();
    if !ids.is_empty() {
        build(&mut bvh, bounds, &mut ids, max_leaf_size.max(2) / 2);
    }
    bvh
}

fn build(bvh: &mut Bvh, bounds: &[Aabb], ids: &mut [u32], leaf_size: usize) -> u32 {
    let sound = ids.iter().map(|&id| bounds[id as usize]).filter(|b| !b.is_empty());
    let all = sound.fold(Aabb::EMPTY, Aabb::union);
    let node = bvh.nodes.len() as u32;
    let kind = NodeKind::Leaf { first: bvh.order.len() as u32, count: ids.len() as u32 };
    bvh.nodes.push(BvhNode { bounds: all, kind });
    if ids.len() <= leaf_size {
        bvh.order.extend(ids.iter().copied().map(PrimId));
        return node;
    }
    let axis = all.extent().max_position();
    let middle = ids.len() / 2;
    let along = |id: &u32| bounds[*id as usize].centroid()[axis];
    ids.select_nth_unstable_by(middle, |a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
    let (low, high) = ids.split_at_mut(middle);
    let left = build(bvh, bounds, low, leaf_size);
    let right = build(bvh, bounds, high, leaf_size);
    bvh.nodes[node as usize].kind = NodeKind::Interior { left, right };
    node
}
