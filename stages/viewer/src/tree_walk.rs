//! Walking through the binary tree, node by node, and statistics of a node.

use kit::{Aabb, Bvh, NodeKind, PrimId};

/// A child of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The left child.
    Left,
    /// The right child.
    Right,
}

/// The selected node, and the way to it from the root.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TreeWalk {
    /// The nodes below the root on the way, the selected one last.
    below_root: Vec<u32>,
}

impl TreeWalk {
    /// The selected node.
    pub fn node(&self) -> u32 {
        self.below_root.last().copied().unwrap_or(0)
    }

    /// The number of steps from the root.
    pub fn depth(&self) -> usize {
        self.below_root.len()
    }

    /// Selects a child; does nothing at a leaf.
    pub fn descend(&mut self, tree: &Bvh, side: Side) {
        if let Some([left, right]) = children(tree, self.node()) {
            self.below_root.push(match side {
                Side::Left => left,
                Side::Right => right,
            });
        }
    }

    /// Selects the parent; does nothing at the root.
    pub fn ascend(&mut self) {
        self.below_root.pop();
    }

    /// Selects the node at `depth`: an ancestor, or a descendant through the larger children.
    pub fn go_to_depth(&mut self, tree: &Bvh, depth: usize) {
        self.below_root.truncate(depth);
        while self.below_root.len() < depth {
            let Some([left, right]) = children(tree, self.node()) else {
                return;
            };
            let size = |node| subtree(tree, node).count();
            let is_right = size(right) > size(left);
            self.below_root.push(if is_right { right } else { left });
        }
    }

    /// Selects `node` wherever it is in the tree. Does nothing if there is no such node.
    pub fn go_to(&mut self, tree: &Bvh, node: u32) {
        let mut parent_of = vec![None; tree.nodes.len()];
        for (i, _) in tree.nodes.iter().enumerate() {
            for child in children(tree, i as u32).into_iter().flatten() {
                parent_of[child as usize] = Some(i as u32);
            }
        }
        let mut way = Vec::new();
        let mut at = node;
        while let Some(&Some(parent)) = parent_of.get(at as usize) {
            way.push(at);
            at = parent;
        }
        if at == 0 {
            way.reverse();
            self.below_root = way;
        }
    }
}

/// The children of a node; `None` for a leaf and for a node that does not exist.
pub fn children(tree: &Bvh, node: u32) -> Option<[u32; 2]> {
    match tree.nodes.get(node as usize)?.kind {
        NodeKind::Interior { left, right } => Some([left, right]),
        NodeKind::Leaf { .. } => None,
    }
}

/// The nodes below and including `node`, and their depths below it, depth first.
pub fn subtree(tree: &Bvh, node: u32) -> impl Iterator<Item = (u32, usize)> {
    let root = (!tree.nodes.is_empty()).then_some((node, 0));
    let mut pending: Vec<(u32, usize)> = root.into_iter().collect();
    // A wrong tree may contain a node twice: every node is visited at most as often as there are
    // nodes.
    let mut budget = tree.nodes.len();
    std::iter::from_fn(move || {
        let (node, depth) = pending.pop()?;
        budget = budget.checked_sub(1)?;
        if let Some([left, right]) = children(tree, node) {
            pending.extend([(right, depth + 1), (left, depth + 1)]);
        }
        Some((node, depth))
    })
}

/// The primitives below a node.
pub fn primitives(tree: &Bvh, node: u32) -> impl Iterator<Item = PrimId> {
    subtree(tree, node)
        .flat_map(|(node, _)| match tree.nodes[node as usize].kind {
            NodeKind::Leaf { first, count } => tree.leaf(first, count),
            NodeKind::Interior { .. } => &[],
        })
        .copied()
}

/// The primitives below the right child of a node; none for a leaf.
pub fn right_primitives(tree: &Bvh, node: u32) -> Vec<PrimId> {
    match children(tree, node) {
        Some([_, right]) => primitives(tree, right).collect(),
        None => Vec::new(),
    }
}

/// The tree below a node as a tree of its own, over the same primitives.
pub fn below(tree: &Bvh, node: u32) -> Bvh {
    let mut below = tree.clone();
    if let (Some(selected), false) = (tree.nodes.get(node as usize), below.nodes.is_empty()) {
        below.nodes[0] = *selected;
    }
    below
}

/// Statistics of a node and what is below it.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeStatistics {
    /// The node.
    pub node: u32,
    /// Primitives below it.
    pub primitives: usize,
    /// Nodes below it, with itself.
    pub nodes: usize,
    /// Leaves below it.
    pub leaves: usize,
    /// The most primitives of a leaf.
    pub largest_leaf: usize,
    /// Steps to its deepest descendant.
    pub depth: usize,
    /// The expected number of tests of a random ray that hits the node's box: by the surface area
    /// heuristic, with a cost of 1 for a box and for a primitive.
    pub sah: f64,
    /// The surface area that both children's boxes share, relative to that of the node's box.
    pub overlap: f64,
    /// Its box.
    pub bounds: Aabb,
}

impl NodeStatistics {
    /// The statistics of `node`; `None` if the tree has no such node.
    pub fn of(tree: &Bvh, node: u32) -> Option<NodeStatistics> {
        let bounds = tree.nodes.get(node as usize)?.bounds;
        let area = bounds.surface_area();
        let share = |b: &Aabb| {
            if area > 0.0 {
                b.surface_area() / area
            } else {
                1.0
            }
        };
        let mut statistics = NodeStatistics {
            node,
            primitives: 0,
            nodes: 0,
            leaves: 0,
            largest_leaf: 0,
            depth: 0,
            sah: 0.0,
            overlap: 0.0,
            bounds,
        };
        for (below, depth) in subtree(tree, node) {
            let part = &tree.nodes[below as usize];
            statistics.nodes += 1;
            statistics.depth = statistics.depth.max(depth);
            statistics.sah += share(&part.bounds)
                * match part.kind {
                    // Both children's boxes are tested.
                    NodeKind::Interior { .. } => 2.0,
                    NodeKind::Leaf { count, .. } => f64::from(count),
                };
            if let NodeKind::Leaf { count, .. } = part.kind {
                statistics.leaves += 1;
                statistics.primitives += count as usize;
                statistics.largest_leaf = statistics.largest_leaf.max(count as usize);
            }
        }
        if let Some(children) = children(tree, node) {
            let [left, right] = children.map(|child| tree.nodes[child as usize].bounds);
            statistics.overlap = share(&Aabb {
                min: left.min.max(right.min),
                max: left.max.min(right.max),
            });
        }
        Some(statistics)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{BvhNode, Vec3};

    fn slab(min: f64, max: f64) -> Aabb {
        Aabb {
            min: Vec3::new(min, 0.0, 0.0),
            max: Vec3::new(max, 1.0, 1.0),
        }
    }

    /// A root from 0 to 3 with a leaf of two primitives and a node with two leaves.
    fn tree() -> Bvh {
        let leaf = |bounds, first, count| BvhNode {
            bounds,
            kind: NodeKind::Leaf { first, count },
        };
        let interior = |bounds, left, right| BvhNode {
            bounds,
            kind: NodeKind::Interior { left, right },
        };
        Bvh {
            nodes: vec![
                interior(slab(0.0, 3.0), 1, 2),
                leaf(slab(0.0, 1.0), 0, 2),
                interior(slab(0.5, 3.0), 3, 4),
                leaf(slab(0.5, 2.0), 2, 1),
                leaf(slab(2.0, 3.0), 3, 3),
            ],
            order: (0..6).map(PrimId).collect(),
        }
    }

    #[test]
    fn walking_down_and_up_stops_at_the_ends() {
        let tree = tree();
        let mut walk = TreeWalk::default();
        walk.ascend();
        assert_eq!(walk.node(), 0);
        walk.descend(&tree, Side::Right);
        walk.descend(&tree, Side::Left);
        assert_eq!((walk.node(), walk.depth()), (3, 2));
        walk.descend(&tree, Side::Left);
        assert_eq!(walk.node(), 3, "a leaf has no children");
        walk.ascend();
        assert_eq!(walk.node(), 2);
        walk.go_to_depth(&tree, 9);
        assert_eq!(walk.depth(), 2);
        walk.go_to(&tree, 4);
        assert_eq!((walk.node(), walk.depth()), (4, 2));
        walk.go_to_depth(&tree, 0);
        assert_eq!(walk.node(), 0);
    }

    #[test]
    fn statistics_count_what_is_below() {
        let tree = tree();
        let root = NodeStatistics::of(&tree, 0).expect("a root");
        assert_eq!(
            (root.primitives, root.nodes, root.leaves, root.depth),
            (6, 5, 3, 2)
        );
        assert_eq!(root.largest_leaf, 3);
        // Areas: a slab of length l has 2 (1 + 2 l). The root's is 14.
        let area = |l: f64| 2.0 * (1.0 + 2.0 * l) / 14.0;
        let sah = 2.0 + 2.0 * area(1.0) + 2.0 * area(2.5) + area(1.5) + 3.0 * area(1.0);
        assert!((root.sah - sah).abs() < 1e-12);
        assert!((root.overlap - area(0.5)).abs() < 1e-12);
        assert_eq!(NodeStatistics::of(&tree, 9), None);
        assert_eq!(primitives(&tree, 2).count(), 4);
        assert_eq!(right_primitives(&tree, 0).len(), 4);
    }

    #[test]
    fn trees_with_loops_end() {
        let mut tree = tree();
        tree.nodes[3].kind = NodeKind::Interior { left: 0, right: 0 };
        assert!(NodeStatistics::of(&tree, 0).is_some_and(|s| s.nodes <= 5));
    }
}
