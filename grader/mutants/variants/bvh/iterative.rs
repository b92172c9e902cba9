//! The same splits from a work list instead of recursion.

pub use base::*;
use kit::{Aabb, Bvh, BvhNode, NodeKind};

pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    let mut bvh = Bvh::one_leaf(bounds);
    let mut work = vec![0];
    while let Some(node) = work.pop() {
        let BvhNode { kind: NodeKind::Leaf { first, count }, .. } = bvh.nodes.get(node).copied().unwrap_or(END) else {
            continue;
        };
        let run = &mut bvh.order[first as usize..(first + count) as usize];
        let mut own = Aabb::EMPTY;
        let mut centroids = Aabb::EMPTY;
        for id in run.iter() {
            let b = bounds[id.0 as usize];
            if !b.is_empty() {
                own = own.union(b);
                centroids = centroids.grown_by(b.centroid());
            }
        }
        if node < bvh.nodes.len() {
            bvh.nodes[node].bounds = own;
        }
        if count as usize <= max_leaf_size.max(1) {
            continue;
        }
        let axis = centroids.extent().max_position();
        run.sort_by(|a, b| bounds[a.0 as usize].centroid()[axis].total_cmp(&bounds[b.0 as usize].centroid()[axis]));
        let half = count / 2;
        let left = bvh.nodes.len() as u32;
        let leaf = |first, count| BvhNode { bounds: Aabb::EMPTY, kind: NodeKind::Leaf { first, count } };
        bvh.nodes.push(leaf(first, half));
        bvh.nodes.push(leaf(first + half, count - half));
        bvh.nodes[node].kind = NodeKind::Interior { left, right: left + 1 };
        work.extend([left as usize, left as usize + 1]);
    }
    bvh
}

const END: BvhNode = BvhNode { bounds: Aabb::EMPTY, kind: NodeKind::Interior { left: 0, right: 0 } };
