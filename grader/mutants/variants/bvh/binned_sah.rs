//! The surface area heuristic over twelve bins on each axis (Wald, "On fast Construction of
//! SAH-based Bounding Volume Hierarchies", 2007).

pub use base::*;
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId};

const BINS: usize = 12;

pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    let mut bvh = Bvh::default();
    if !bounds.is_empty() {
        build(&mut bvh, bounds, (0..bounds.len() as u32).collect(), max_leaf_size.max(1));
    }
    bvh
}

fn build(bvh: &mut Bvh, bounds: &[Aabb], ids: Vec<u32>, leaf_size: usize) -> u32 {
    let all = around(bounds, &ids);
    let node = bvh.nodes.len() as u32;
    let kind = NodeKind::Leaf { first: bvh.order.len() as u32, count: ids.len() as u32 };
    bvh.nodes.push(BvhNode { bounds: all, kind });
    if ids.len() <= leaf_size {
        bvh.order.extend(ids.into_iter().map(PrimId));
        return node;
    }
    let (low, high) = split(bounds, &ids).unwrap_or_else(|| {
        let (low, high) = ids.split_at(ids.len() / 2);
        (low.to_vec(), high.to_vec())
    });
    let left = build(bvh, bounds, low, leaf_size);
    let right = build(bvh, bounds, high, leaf_size);
    bvh.nodes[node as usize].kind = NodeKind::Interior { left, right };
    node
}

fn around(bounds: &[Aabb], ids: &[u32]) -> Aabb {
    let sound = ids.iter().map(|&id| bounds[id as usize]).filter(|b| !b.is_empty());
    sound.fold(Aabb::EMPTY, Aabb::union)
}

/// The cheapest of all borders between bins; `None` where all fall into one.
fn split(bounds: &[Aabb], ids: &[u32]) -> Option<(Vec<u32>, Vec<u32>)> {
    let spread = Aabb::of(ids.iter().map(|&id| bounds[id as usize].centroid()).filter(|c| c.is_finite()));
    let bin = |id: u32, axis: usize| {
        let share = (bounds[id as usize].centroid()[axis] - spread.min[axis]) / spread.extent()[axis];
        ((share * BINS as f64) as usize).min(BINS - 1)
    };
    let mut best = None;
    let mut lowest = f64::INFINITY;
    for axis in 0..3 {
        let mut bins = [(0_usize, Aabb::EMPTY); BINS];
        for &id in ids {
            let (count, held) = &mut bins[bin(id, axis)];
            *count += 1;
            *held = held.union(bounds[id as usize]);
        }
        for border in 1..BINS {
            let side = |bins: &[(usize, Aabb)]| bins.iter().fold((0, Aabb::EMPTY), |(n, all), (count, held)| (n + count, all.union(*held)));
            let ((below, low), (above, high)) = (side(&bins[..border]), side(&bins[border..]));
            let cost = low.surface_area() * below as f64 + high.surface_area() * above as f64;
            if below > 0 && above > 0 && cost < lowest {
                lowest = cost;
                best = Some((axis, border));
            }
        }
    }
    let (axis, border) = best?;
    Some(ids.iter().partition(|&&id| bin(id, axis) < border))
}
