//! A tree built level by level from a queue, so that children stand far from their parents.

pub use base::*;
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId};
use std::collections::VecDeque;
use std::ops::Range;

pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    let mut order: Vec<PrimId> = (0..bounds.len() as u32).rev().map(PrimId).collect();
    let mut nodes: Vec<BvhNode> = Vec::new();
    let mut waiting: VecDeque<Range<usize>> = VecDeque::new();
    if !order.is_empty() {
        waiting.push_back(0..order.len());
    }
    while let Some(range) = waiting.pop_front() {
        let run = &mut order[range.clone()];
        let boxes = || run.iter().map(|id| bounds[id.0 as usize]).filter(|b| !b.is_empty());
        let around = boxes().fold(Aabb::EMPTY, Aabb::union);
        let spread = Aabb::of(boxes().map(|b| b.centroid())).extent();
        let kind = if run.len() <= max_leaf_size.max(1) {
            NodeKind::Leaf { first: range.start as u32, count: run.len() as u32 }
        } else {
            let axis = spread.max_position();
            let key = |id: &PrimId| bounds[id.0 as usize].centroid()[axis];
            let half = run.len() / 2;
            run.select_nth_unstable_by(half, |a, b| key(a).total_cmp(&key(b)));
            // All that wait come first; these two after them.
            let left = (nodes.len() + 1 + waiting.len()) as u32;
            waiting.push_back(range.start..range.start + half);
            waiting.push_back(range.start + half..range.end);
            NodeKind::Interior { left, right: left + 1 }
        };
        nodes.push(BvhNode { bounds: around, kind });
    }
    Bvh { nodes, order }
}
