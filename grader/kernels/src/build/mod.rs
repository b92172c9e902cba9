//! Top-down tree construction. The builders differ only in how a node is split. A leaf holds at
//! most the given number of primitives; if a split leaves one side empty, the median split is used.

mod median;
mod midpoint;
mod primitive;
mod sah;

use crate::tree::Builder;
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId};
use primitive::BuildPrimitive;

/// Partitions the primitives into left and right, and returns the number of left ones.
type Split = fn(&mut [BuildPrimitive]) -> usize;

/// Returns all builders, the simplest first.
pub(crate) fn builders() -> Vec<Builder> {
    vec![
        Builder {
            name: "midpoint",
            paper: "Glassner 1984",
            build: |bounds, max_leaf_size| build(bounds, max_leaf_size, midpoint::split),
        },
        Builder {
            name: "median",
            paper: "Kay, Kajiya 1986",
            build: |bounds, max_leaf_size| build(bounds, max_leaf_size, median::split),
        },
        Builder {
            name: "SAH, 16 bins",
            paper: "Wald 2007",
            build: |bounds, max_leaf_size| build(bounds, max_leaf_size, sah::split),
        },
    ]
}

fn build(bounds: &[Aabb], max_leaf_size: usize, split: Split) -> Bvh {
    let primitives = (0..)
        .map(PrimId)
        .zip(bounds)
        .map(|(id, bounds)| BuildPrimitive {
            id,
            bounds: *bounds,
            centroid: bounds.centroid(),
        });
    let mut primitives: Vec<BuildPrimitive> = primitives.collect();
    let mut nodes = Vec::with_capacity(2 * bounds.len());
    if !primitives.is_empty() {
        add_subtree(&mut nodes, &mut primitives, 0, max_leaf_size.max(1), split);
    }
    Bvh {
        nodes,
        order: primitives.iter().map(|primitive| primitive.id).collect(),
    }
}

/// Adds the subtree over `primitives`, which start at `first` in the tree's order; returns the
/// index of its root.
fn add_subtree(
    nodes: &mut Vec<BvhNode>,
    primitives: &mut [BuildPrimitive],
    first: u32,
    max_leaf_size: usize,
    split: Split,
) -> u32 {
    let number = nodes.len();
    nodes.push(BvhNode {
        bounds: bounds_of(primitives),
        kind: NodeKind::Leaf {
            first,
            count: primitives.len() as u32,
        },
    });
    if primitives.len() > max_leaf_size {
        let mut middle = split(primitives);
        if middle == 0 || middle == primitives.len() {
            middle = median::split(primitives);
        }
        let (low, high) = primitives.split_at_mut(middle);
        let left = add_subtree(nodes, low, first, max_leaf_size, split);
        let right = add_subtree(nodes, high, first + middle as u32, max_leaf_size, split);
        nodes[number].kind = NodeKind::Interior { left, right };
    }
    number as u32
}

/// Returns the bounds of the primitives.
fn bounds_of(primitives: &[BuildPrimitive]) -> Aabb {
    let bounds = primitives.iter().map(|primitive| primitive.bounds);
    bounds.fold(Aabb::EMPTY, Aabb::union)
}
