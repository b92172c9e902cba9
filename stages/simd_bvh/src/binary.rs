// BEGIN SOLUTION(part6.task1)
//! Building: the binary tree that rays find cheapest, from the root downwards, by the surface area
//! heuristic.

use crate::sah::{Item, LANES, cheapest_plane};
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId};

/// Splits by cost on the way down before halves take over, so that the recursion ends.
const MAX_DEPTH: u32 = 64;

/// A tree over the primitives that have a box at all, with at most [`LANES`] of them in a leaf; ids within a leaf ascend.
pub(crate) fn build(bounds: &[Aabb]) -> Bvh {
    let mut items: Vec<Item> = (0..)
        .zip(bounds)
        .filter(|(_, bounds)| !bounds.is_empty())
        .map(|(id, &bounds)| Item::new(id, bounds))
        .collect();
    if items.is_empty() {
        return Bvh::default();
    }
    let nodes = subtree(&mut items, 0, 0);
    Bvh {
        nodes,
        order: items.iter().map(|item| PrimId(item.id)).collect(),
    }
}

/// Holds a node's place until its subtree is built.
const UNBUILT: BvhNode = BvhNode {
    bounds: Aabb::EMPTY,
    kind: NodeKind::Leaf { first: 0, count: 0 },
};

/// From so many items up, the two sides of a split are built at the same time.
const PARALLEL: usize = 1 << 12;

/// The subtree over `items`, which start at `first` in the tree's order; its root comes first. It is the same for any
/// number of threads.
fn subtree(items: &mut [Item], first: u32, depth: u32) -> Vec<BvhNode> {
    if items.len() < PARALLEL {
        let mut nodes = vec![UNBUILT];
        split(&mut nodes, 0, items, first, depth);
        return nodes;
    }
    let (bounds, middle) = halves(items, depth);
    let middle = middle.expect("more items than fit into a leaf");
    let (below, above) = items.split_at_mut(middle);
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
    nodes.extend(left.into_iter().map(|node| moved(node, to_left)));
    nodes.extend(right.into_iter().map(|node| moved(node, to_right)));
    nodes
}

/// A node whose children are `by` places further on.
fn moved(mut node: BvhNode, by: u32) -> BvhNode {
    if let NodeKind::Interior { left, right } = &mut node.kind {
        *left += by;
        *right += by;
    }
    node
}

/// Builds the subtree over `items`, which start at `first` in the tree's order, into place `node`.
fn split(nodes: &mut Vec<BvhNode>, node: usize, items: &mut [Item], first: u32, depth: u32) {
    let (bounds, middle) = halves(items, depth);
    let Some(middle) = middle else {
        items.sort_unstable_by_key(|item| item.id);
        let count = items.len() as u32;
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
    let (below, above) = items.split_at_mut(middle);
    split(nodes, left, below, first, depth + 1);
    split(nodes, right, above, first + middle as u32, depth + 1);
}

/// The box of `items`, and how many of them go left, now that they are in order; `None` for a leaf.
fn halves(items: &mut [Item], depth: u32) -> (Aabb, Option<usize>) {
    let (mut bounds, mut centroids) = (Aabb::EMPTY, Aabb::EMPTY);
    for item in &*items {
        bounds = bounds.union(item.bounds);
        centroids = centroids.union(Aabb {
            min: item.centroid,
            max: item.centroid,
        });
    }
    // A leaf is one test of all its lanes, and no split of it costs less.
    if items.len() <= LANES {
        return (bounds, None);
    }
    let plane = if depth < MAX_DEPTH {
        cheapest_plane(items, bounds, centroids)
    } else {
        None
    };
    let middle = match plane {
        Some(plane) => partition(items, |item| plane.is_below(item)),
        None => {
            items.sort_unstable_by_key(|item| item.id);
            items.len() / 2
        }
    };
    (bounds, Some(middle))
}

/// Moves the items with `is_first` to the front and says how many they are.
fn partition(items: &mut [Item], is_first: impl Fn(&Item) -> bool) -> usize {
    let mut count = 0;
    for i in 0..items.len() {
        if is_first(&items[i]) {
            items.swap(i, count);
            count += 1;
        }
    }
    count
}
// END SOLUTION(part6.task1)
