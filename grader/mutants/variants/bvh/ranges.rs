//! One list of primitives, partitioned in place; a node is a range of it.

pub use base::*;
use kit::*;

pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    let mut nodes = Vec::new();
    let mut list: Vec<usize> = (0..bounds.len()).collect();
    if bounds.len() > 0 {
        let end = list.len();
        build(&mut nodes, bounds, &mut list, 0, end, max_leaf_size.max(1));
    }
    Bvh { nodes, order: list.into_iter().map(|i| PrimId(i as u32)).collect() }
}

fn build(nodes: &mut Vec<BvhNode>, bounds: &[Aabb], list: &mut Vec<usize>, start: usize, end: usize, max_leaf: usize) -> usize {
    let mut bb = Aabb::EMPTY;
    let mut cb = Aabb::EMPTY;
    for k in start..end {
        let b = bounds[list[k]];
        if !b.is_empty() {
            bb = bb.union(b);
            cb = cb.grown_by(b.centroid());
        }
    }
    let me = nodes.len();
    nodes.push(BvhNode { bounds: bb, kind: NodeKind::Leaf { first: start as u32, count: (end - start) as u32 } });
    if end - start <= max_leaf {
        return me;
    }
    let axis = cb.extent().max_position();
    let middle = cb.centroid()[axis];
    let mut at = start;
    for k in start..end {
        if bounds[list[k]].centroid()[axis] < middle {
            list.swap(k, at);
            at += 1;
        }
    }
    if at == start || at == end {
        at = (start + end) / 2;
    }
    let left = build(nodes, bounds, list, start, at, max_leaf) as u32;
    let right = build(nodes, bounds, list, at, end, max_leaf) as u32;
    nodes[me].kind = NodeKind::Interior { left, right };
    me
}
