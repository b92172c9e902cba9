// BEGIN SOLUTION(part2.task1)
//! Building a tree, top down. How a node is split is all that these builders differ in: a leaf has as many primitives
//! as it may, and where a split leaves one side empty the median takes over.

mod median;
mod midpoint;
mod sah;

use crate::tree::Builder;
use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId, Vec3};

/// Puts those items first that go left, and says how many they are.
type Split = fn(&mut [Item]) -> usize;

/// A primitive on its way into the tree.
#[derive(Clone, Copy)]
pub(crate) struct Item {
    id: PrimId,
    bounds: Aabb,
    centroid: Vec3,
}

/// All of them, the simplest first.
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
    let items = (0..).map(PrimId).zip(bounds).map(|(id, bounds)| Item {
        id,
        bounds: *bounds,
        centroid: bounds.centroid(),
    });
    let mut items: Vec<Item> = items.collect();
    let mut nodes = Vec::with_capacity(2 * bounds.len());
    if !items.is_empty() {
        add(&mut nodes, &mut items, 0, max_leaf_size.max(1), split);
    }
    Bvh {
        nodes,
        order: items.iter().map(|item| item.id).collect(),
    }
}

/// Adds the subtree over `items`, which start at `first` in the tree's order; returns its root's number.
fn add(
    nodes: &mut Vec<BvhNode>,
    items: &mut [Item],
    first: u32,
    max_leaf_size: usize,
    split: Split,
) -> u32 {
    let number = nodes.len();
    nodes.push(BvhNode {
        bounds: around(items),
        kind: NodeKind::Leaf {
            first,
            count: items.len() as u32,
        },
    });
    if items.len() > max_leaf_size {
        let mut middle = split(items);
        if middle == 0 || middle == items.len() {
            middle = median::split(items);
        }
        let (low, high) = items.split_at_mut(middle);
        let left = add(nodes, low, first, max_leaf_size, split);
        let right = add(nodes, high, first + middle as u32, max_leaf_size, split);
        nodes[number].kind = NodeKind::Interior { left, right };
    }
    number as u32
}

/// The box around the items' boxes.
fn around(items: &[Item]) -> Aabb {
    let bounds = items.iter().map(|item| item.bounds);
    bounds.fold(Aabb::EMPTY, Aabb::union)
}

/// The box around the items' centroids.
fn around_centroids(items: &[Item]) -> Aabb {
    Aabb::of(items.iter().map(|item| item.centroid))
}

/// Puts those items first for which `goes_left` holds; returns how many they are.
fn partition(items: &mut [Item], goes_left: impl Fn(&Item) -> bool) -> usize {
    let mut left = 0;
    for i in 0..items.len() {
        if goes_left(&items[i]) {
            items.swap(i, left);
            left += 1;
        }
    }
    left
}
// END SOLUTION(part2.task1)
