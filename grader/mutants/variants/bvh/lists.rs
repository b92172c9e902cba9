//! Two lists for each split, at the middle of the centroids' box; below 64 levels, halves of the
//! list.

pub use base::*;
use kit::*;

pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    let mut bvh = Bvh::default();
    if bounds.is_empty() {
        return bvh;
    }
    let ids: Vec<u32> = (0..bounds.len() as u32).collect();
    build(&mut bvh, bounds, ids, max_leaf_size.max(1), 0);
    bvh
}

fn build(bvh: &mut Bvh, bounds: &[Aabb], mut ids: Vec<u32>, max_leaf: usize, depth: usize) -> u32 {
    let mut bb = Aabb::EMPTY;
    let mut cb = Aabb::EMPTY;
    for &i in &ids {
        let b = bounds[i as usize];
        if !b.is_empty() {
            bb = bb.union(b);
            cb = cb.grown_by(b.centroid());
        }
    }
    let me = bvh.nodes.len() as u32;
    let first = bvh.order.len() as u32;
    bvh.nodes.push(BvhNode { bounds: bb, kind: NodeKind::Leaf { first, count: ids.len() as u32 } });
    if ids.len() <= max_leaf {
        bvh.order.extend(ids.iter().map(|&i| PrimId(i)));
        return me;
    }
    let axis: usize = cb.extent().max_position();
    let middle = cb.centroid()[axis];
    let (mut left, mut right) = (Vec::new(), Vec::new());
    for &i in &ids {
        let b = bounds[i as usize];
        if b.centroid()[axis] < middle {
            left.push(i);
        } else {
            right.push(i);
        }
    }
    if left.is_empty() || right.is_empty() || depth > 64 {
        right = ids.split_off(ids.len() / 2);
        left = ids;
    }
    let l = build(bvh, bounds, left, max_leaf, depth + 1);
    let r = build(bvh, bounds, right, max_leaf, depth + 1);
    bvh.nodes[me as usize].kind = NodeKind::Interior { left: l, right: r };
    me
}
