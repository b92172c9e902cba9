// BEGIN SOLUTION(part6.task1)
//! Builds the binary tree of least expected cost, from the root downwards, with the surface area
//! heuristic.

use crate::sah::{BuildPrimitive, LANES, cheapest_plane};
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId};

/// The depth below which nodes are split by the heuristic; from there on in halves, so that the
/// recursion ends.
const MAX_DEPTH: u32 = 64;

/// Builds a tree over `prims`, with at most [`LANES`] in a leaf. Ids in a leaf ascend.
pub(crate) fn build(mut prims: Vec<BuildPrimitive>) -> Bvh {
    if prims.is_empty() {
        return Bvh::default();
    }
    let nodes = subtree(&mut prims, 0, 0);
    Bvh {
        nodes,
        order: prims.iter().map(|prim| PrimId(prim.id)).collect(),
    }
}

/// Stands for a node until its subtree is built.
const UNBUILT: BvhNode = BvhNode {
    bounds: Aabb::EMPTY,
    kind: NodeKind::Leaf { first: 0, count: 0 },
};

/// From this many primitives on, the two subtrees of a split are built in parallel.
const MIN_PARALLEL: usize = 1 << 12;

/// Builds the subtree over `prims`, which start at `first` in the tree's order; its root is the
/// first node. The result does not depend on the number of threads.
fn subtree(prims: &mut [BuildPrimitive], first: u32, depth: u32) -> Vec<BvhNode> {
    if prims.len() < MIN_PARALLEL {
        let mut nodes = vec![UNBUILT];
        split(&mut nodes, 0, prims, first, depth);
        return nodes;
    }
    let (bounds, middle) = partition_by_cost(prims, depth);
    let middle = middle.expect("more primitives than fit into a leaf");
    let (below, above) = prims.split_at_mut(middle);
    let (left, right) = rayon::join(
        || subtree(below, first, depth + 1),
        || subtree(above, first + middle as u32, depth + 1),
    );
    let (to_left, to_right) = (1, 1 + left.len() as u32);
    let root = BvhNode {
        bounds,
        kind: NodeKind::Interior {
            left: to_left,
            right: to_right,
        },
    };
    let mut nodes = Vec::with_capacity(1 + left.len() + right.len());
    nodes.push(root);
    nodes.extend(left.into_iter().map(|node| shifted(node, to_left)));
    nodes.extend(right.into_iter().map(|node| shifted(node, to_right)));
    nodes
}

/// Adds `by` to the indices of the children of a node.
fn shifted(mut node: BvhNode, by: u32) -> BvhNode {
    if let NodeKind::Interior { left, right } = &mut node.kind {
        *left += by;
        *right += by;
    }
    node
}

/// Builds the subtree over `prims`, which start at `first` in the tree's order, with `node` as its
/// root.
fn split(
    nodes: &mut Vec<BvhNode>,
    node: usize,
    prims: &mut [BuildPrimitive],
    first: u32,
    depth: u32,
) {
    let (bounds, middle) = partition_by_cost(prims, depth);
    let Some(middle) = middle else {
        prims.sort_unstable_by_key(|prim| prim.id);
        let count = prims.len() as u32;
        nodes[node] = BvhNode {
            bounds,
            kind: NodeKind::Leaf { first, count },
        };
        return;
    };
    let (left, right) = (nodes.len(), nodes.len() + 1);
    nodes.extend([UNBUILT; 2]);
    nodes[node] = BvhNode {
        bounds,
        kind: NodeKind::Interior {
            left: left as u32,
            right: right as u32,
        },
    };
    let (below, above) = prims.split_at_mut(middle);
    split(nodes, left, below, first, depth + 1);
    split(nodes, right, above, first + middle as u32, depth + 1);
}

/// Partitions `prims`. Returns their box and how many of them go left; `None` for a leaf.
fn partition_by_cost(prims: &mut [BuildPrimitive], depth: u32) -> (Aabb, Option<usize>) {
    let (mut bounds, mut centroids) = (Aabb::EMPTY, Aabb::EMPTY);
    for prim in &*prims {
        bounds = bounds.union(prim.bounds);
        centroids = centroids.union(Aabb {
            min: prim.centroid,
            max: prim.centroid,
        });
    }
    // A leaf of one block is one test, and no split costs less.
    if prims.len() <= LANES {
        return (bounds, None);
    }
    let plane = if depth < MAX_DEPTH {
        cheapest_plane(prims, bounds, centroids)
    } else {
        None
    };
    let middle = match plane {
        Some(plane) => partition(prims, |prim| plane.is_below(prim)),
        None => {
            prims.sort_unstable_by_key(|prim| prim.id);
            prims.len() / 2
        }
    };
    (bounds, Some(middle))
}

/// Moves the primitives with `is_first` to the front and returns their number.
fn partition(prims: &mut [BuildPrimitive], is_first: impl Fn(&BuildPrimitive) -> bool) -> usize {
    let mut count = 0;
    for i in 0..prims.len() {
        if is_first(&prims[i]) {
            prims.swap(i, count);
            count += 1;
        }
    }
    count
}
// END SOLUTION(part6.task1)
