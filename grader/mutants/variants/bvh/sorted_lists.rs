//! Lists sorted along the largest extent and cut in the middle.

pub use base::*;
use kit::*;

pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    let mut bvh = Bvh::default();
    if bounds.is_empty() {
        return bvh;
    }
    let ids: Vec<u32> = (0..bounds.len() as u32).collect();
    build(&mut bvh, bounds, ids, max_leaf_size.max(1));
    bvh
}

fn build(bvh: &mut Bvh, bounds: &[Aabb], mut ids: Vec<u32>, max_leaf: usize) -> u32 {
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
    let (left, right);
    ids.sort_by(|&p, &q| bounds[p as usize].centroid()[axis].total_cmp(&bounds[q as usize].centroid()[axis]));
    right = ids.split_off(ids.len() / 2);
    left = ids;
    let l = build(bvh, bounds, left, max_leaf);
    let r = build(bvh, bounds, right, max_leaf);
    bvh.nodes[me as usize].kind = NodeKind::Interior { left: l, right: r };
    me
}
