//! Primitives in the order of a space-filling curve, split where the highest bit of their places on
//! it changes (Lauterbach et al., "Fast BVH Construction on GPUs", Eurographics 2009).

pub use base::*;
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId, Vec3};

/// Bits of a place along each axis.
const BITS: u32 = 20;

pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    if bounds.is_empty() {
        return Bvh::default();
    }
    let centroids: Vec<Vec3> = bounds.iter().map(Aabb::centroid).collect();
    let spread = Aabb::of(centroids.iter().copied().filter(|c| c.is_finite()));
    let size = spread.extent().max_element();
    let mut places: Vec<(u64, u32)> = (0..).zip(&centroids).map(|(id, c)| (place(*c, spread.min, size), id)).collect();
    places.sort_unstable();
    let mut bvh = Bvh { nodes: Vec::new(), order: places.iter().map(|&(_, id)| PrimId(id)).collect() };
    build(&mut bvh, bounds, &places, 0, max_leaf_size.max(1));
    bvh
}

/// The bits of the three coordinates by turns.
fn place(p: Vec3, min: Vec3, size: f64) -> u64 {
    let cells = f64::from(1_u32 << BITS);
    let cell = ((p - min) / size * cells).to_array().map(|x| x.clamp(0.0, cells - 1.0) as u64);
    (0..BITS).rev().flat_map(|bit| cell.map(|x| x >> bit & 1)).fold(0, |place, bit| place << 1 | bit)
}

fn build(bvh: &mut Bvh, bounds: &[Aabb], run: &[(u64, u32)], first: u32, leaf_size: usize) -> u32 {
    let sound = run.iter().map(|&(_, id)| bounds[id as usize]).filter(|b| !b.is_empty());
    let all = sound.fold(Aabb::EMPTY, Aabb::union);
    let node = bvh.nodes.len() as u32;
    bvh.nodes.push(BvhNode { bounds: all, kind: NodeKind::Leaf { first, count: run.len() as u32 } });
    if run.len() > leaf_size {
        let differing = run[0].0 ^ run[run.len() - 1].0;
        let at = match differing.checked_ilog2() {
            Some(bit) => run.partition_point(|&(place, _)| place >> bit & 1 == 0),
            None => run.len() / 2,
        };
        let left = build(bvh, bounds, &run[..at], first, leaf_size);
        let right = build(bvh, bounds, &run[at..], first + at as u32, leaf_size);
        bvh.nodes[node as usize].kind = NodeKind::Interior { left, right };
    }
    node
}
