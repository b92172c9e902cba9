//! Trees for traversals, written by hand or built along a Morton curve.

use crate::tools::packed_truth;
use kit::Aabb;
// BEGIN SOLUTION(part2.task1)
use kit::Vec3;
// END SOLUTION(part2.task1)
use wire::work::{Node, NodeKind, Tree, Xyz};

/// The shape of a tree: which primitives are in which leaf.
pub(crate) enum TreePlan {
    /// A leaf with these primitives.
    Leaf(Vec<u32>),
    /// Two children, left and right.
    Split(Box<TreePlan>, Box<TreePlan>),
}

impl TreePlan {
    pub(crate) fn split(left: TreePlan, right: TreePlan) -> TreePlan {
        TreePlan::Split(Box::new(left), Box::new(right))
    }

    /// The same tree with `map` of each leaf's primitives, from left to right.
    pub(crate) fn map_leaves(self, map: &mut impl FnMut(Vec<u32>) -> Vec<u32>) -> TreePlan {
        match self {
            TreePlan::Leaf(ids) => TreePlan::Leaf(map(ids)),
            TreePlan::Split(left, right) => {
                let left = left.map_leaves(map);
                TreePlan::split(left, right.map_leaves(map))
            }
        }
    }

    /// A balanced tree: splits `ids` into halves until at most `max_leaf_size` are left.
    pub(crate) fn halves(ids: &[u32], max_leaf_size: usize) -> TreePlan {
        if ids.len() <= max_leaf_size {
            return TreePlan::Leaf(ids.to_vec());
        }
        let (low, high) = ids.split_at(ids.len() / 2);
        TreePlan::split(
            TreePlan::halves(low, max_leaf_size),
            TreePlan::halves(high, max_leaf_size),
        )
    }

    /// Builds the tree; primitive `i` has the box `bounds[i]`.
    pub(crate) fn tree(&self, bounds: &[Aabb]) -> Tree {
        let mut tree = Tree::default();
        tree.nodes.push(placeholder());
        build(&mut tree, 0, self, bounds);
        tree
    }
}

/// A balanced tree over boxes that are sorted along a Morton curve, so that neighbours in the list
/// are close in space (Morton 1966; Lauterbach and others, "Fast BVH construction on GPUs", 2009).
/// How to find such an order is what `part2.task1` is about, so a handout has it as numbers.
pub(crate) fn along_morton_curve(bounds: &[Aabb], max_leaf_size: usize) -> Tree {
    let corners: Vec<[Xyz; 2]> = bounds
        .iter()
        .map(|b| [b.min.into(), b.max.into()])
        .collect();
    // BEGIN SOLUTION(part2.task1)
    let all = bounds.iter().fold(Aabb::EMPTY, |all, &b| all.union(b));
    let mut ids: Vec<u32> = (0..bounds.len() as u32).collect();
    ids.sort_by_cached_key(|&id| morton_code(&all, bounds[id as usize].centroid()));
    let ids = packed_truth::record("part2.task1", "order along the curve", &corners, ids);
    // STUB: let ids: Vec<u32> = packed_truth::find("part2.task1", "order along the curve", &corners);
    // END SOLUTION(part2.task1)
    TreePlan::halves(&ids, max_leaf_size).tree(bounds)
}

// BEGIN SOLUTION(part2.task1)
/// The Morton code of a point: the interleaved bits of its cell's three coordinates.
fn morton_code(all: &Aabb, p: Vec3) -> u32 {
    const BITS: u32 = 10;
    let share = (p - all.min) / all.extent().max(Vec3::splat(f64::MIN_POSITIVE));
    let cell = share.to_array().map(|s| (s * f64::from(1 << BITS)) as u32);
    let bits = (0..BITS).rev().flat_map(|bit| cell.map(|c| c >> bit & 1));
    bits.fold(0, |code, bit| code << 1 | bit)
}
// END SOLUTION(part2.task1)

/// A placeholder for a node whose subtree is not built yet.
fn placeholder() -> Node {
    Node {
        bounds: [[0.0; 3]; 2],
        kind: NodeKind::Leaf { first: 0, count: 0 },
    }
}

/// Writes `plan` to node `at` of the tree and returns its box.
fn build(tree: &mut Tree, at: usize, plan: &TreePlan, prims: &[Aabb]) -> Aabb {
    let (bounds, kind) = match plan {
        TreePlan::Leaf(ids) => {
            let first = tree.order.len() as u32;
            tree.order.extend(ids);
            let boxes = ids.iter().map(|&id| prims[id as usize]);
            let kind = NodeKind::Leaf {
                first,
                count: ids.len() as u32,
            };
            (boxes.fold(Aabb::EMPTY, Aabb::union), kind)
        }
        TreePlan::Split(left, right) => {
            let children = tree.nodes.len();
            tree.nodes.extend([placeholder(), placeholder()]);
            // Whose primitives come first in the list alternates: no leaf's place follows from its
            // place in the tree.
            let mut subtrees = [(children, left), (children + 1, right)];
            if children / 2 % 2 == 1 {
                subtrees.reverse();
            }
            let [one, other] = subtrees.map(|(at, plan)| build(tree, at, plan, prims));
            let bounds = one.union(other);
            let kind = NodeKind::Interior {
                left: children as u32,
                right: children as u32 + 1,
            };
            (bounds, kind)
        }
    };
    tree.nodes[at] = Node {
        bounds: [bounds.min.into(), bounds.max.into()],
        kind,
    };
    bounds
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The primitives below a node, in order. Checks that its box is the smallest around theirs.
    fn below(tree: &Tree, bounds: &[Aabb], node: usize, max_leaf_size: u32) -> Vec<u32> {
        let ids: Vec<u32> = match tree.nodes[node].kind {
            NodeKind::Leaf { first, count } => {
                assert!((1..=max_leaf_size).contains(&count));
                tree.order[first as usize..][..count as usize].to_vec()
            }
            NodeKind::Interior { left, right } => [left, right]
                .map(|child| below(tree, bounds, child as usize, max_leaf_size))
                .concat(),
        };
        let boxes = ids.iter().map(|&id| bounds[id as usize]);
        let around = boxes.fold(Aabb::EMPTY, Aabb::union);
        assert_eq!(
            tree.nodes[node].bounds.map(Vec3::from),
            [around.min, around.max]
        );
        ids
    }

    #[test]
    fn along_morton_curve_neighbours_share_leaves() {
        // The cells of a grid of 8 a side, from last to first.
        let bounds: Vec<Aabb> = (0..512_i32)
            .rev()
            .map(|i| {
                let min = Vec3::new(f64::from(i % 8), f64::from(i / 8 % 8), f64::from(i / 64));
                Aabb {
                    min,
                    max: min + 1.0,
                }
            })
            .collect();
        let tree = along_morton_curve(&bounds, 8);
        let mut ids = below(&tree, &bounds, 0, 8);
        ids.sort_unstable();
        assert_eq!(ids, (0..512).collect::<Vec<u32>>());
        let leaves = tree
            .nodes
            .iter()
            .filter(|node| matches!(node.kind, NodeKind::Leaf { .. }));
        for leaf in leaves {
            let [min, max] = leaf.bounds.map(Vec3::from);
            assert_eq!(
                max - min,
                Vec3::splat(2.0),
                "a leaf is a cube of eight cells"
            );
        }
    }
    /// Whether a leaf is on the left or on the right says nothing about its place in `order`.
    #[test]
    fn left_leaves_lie_before_right_ones_and_behind_them() {
        let ids: Vec<u32> = (0..8).collect();
        let tree = TreePlan::halves(&ids, 1).tree(&[Aabb::EMPTY; 8]);
        let first_of = |at: u32| match tree.nodes[at as usize].kind {
            NodeKind::Leaf { first, .. } => Some(first),
            NodeKind::Interior { .. } => None,
        };
        let mut before = Vec::new();
        for node in &tree.nodes {
            if let NodeKind::Interior { left, right } = node.kind {
                before.extend(first_of(left).zip(first_of(right)).map(|(l, r)| l < r));
            }
        }
        assert_eq!(before.len(), 4);
        assert!(before.contains(&true) && before.contains(&false));
        let mut order = tree.order;
        order.sort_unstable();
        assert_eq!(order, ids);
    }
}
