//! Collapses a binary tree to a wide one: decides which of its nodes become children of the same
//! wide node.

use crate::build::binary::NodeRef;
use crate::layout::LANES;

/// What a subtree costs, and how many wide nodes it has, by the number of lanes that it gets, less
/// one.
///
/// Every ray that hits the box of a wide node tests its children, so the cost of a tree is the sum
/// of the surface areas of its wide nodes. Dynamic programming from the leaves upwards minimises
/// it: `C(i)` is the cost of the subtree of a node as at most `i` children of a wide node above.
/// Either it is one child, a wide node itself, or its two children share the `i` lanes in the best
/// way (Ylitie, Karras, Laine, "Efficient incoherent ray traversal on GPUs through compressed wide
/// BVHs", 2017).
#[derive(Clone, Copy)]
pub(crate) struct Costs {
    costs: [f32; LANES],
    nodes: [u32; LANES],
}

/// How many lanes the left child gets if a node has a number of lanes, less one, for its children;
/// 0 if one lane fewer is as good. With one lane the node is a wide node itself and has eight.
pub(crate) type Shares = [u8; LANES];

impl Costs {
    /// The costs of a leaf of one block.
    pub(crate) const BLOCK: Costs = Costs {
        costs: [0.0; LANES],
        nodes: [0; LANES],
    };

    /// The costs of a leaf of triangles and spheres, which are two blocks: it needs two lanes or a
    /// wide node of its own.
    pub(crate) fn of_mixed_leaf(half_area: f32) -> (Costs, Shares) {
        let mut costs = Costs::BLOCK;
        (costs.costs[0], costs.nodes[0]) = (half_area, 1);
        let mut shares = [0; LANES];
        (shares[0], shares[1]) = (1, 1);
        (costs, shares)
    }

    /// The costs of a node above two others.
    pub(crate) fn above([left, right]: &[Costs; 2], half_area: f32) -> (Costs, Shares) {
        let (mut costs, mut shares) = (Costs::BLOCK, [0; LANES]);
        for lanes in 2..=LANES {
            let (mut least, mut share) = (left.costs[0] + right.costs[lanes - 2], 1);
            for k in 2..lanes {
                let cost = left.costs[k - 1] + right.costs[lanes - k - 1];
                if cost < least {
                    (least, share) = (cost, k);
                }
            }
            costs.costs[lanes - 1] = least;
            costs.nodes[lanes - 1] = left.nodes[share - 1] + right.nodes[lanes - share - 1];
            shares[lanes - 1] = share as u8;
        }
        costs.costs[0] = costs.costs[LANES - 1] + half_area;
        costs.nodes[0] = costs.nodes[LANES - 1] + 1;
        shares[0] = shares[LANES - 1];
        for (i, share) in shares.iter_mut().enumerate().skip(1) {
            if costs.costs[i] >= costs.costs[i - 1] {
                costs.costs[i] = costs.costs[i - 1];
                costs.nodes[i] = costs.nodes[i - 1];
                *share = 0;
            }
        }
        (costs, shares)
    }

    /// The number of wide nodes of the subtree as one child.
    pub(crate) fn node_count(&self) -> u32 {
        self.nodes[0]
    }
}

/// A child of a wide node.
#[derive(Clone, Copy)]
pub(crate) enum WideChild<'t> {
    /// A node of the binary tree that becomes a wide node.
    Node(NodeRef<'t>),
    /// The triangles of a leaf.
    Triangles(NodeRef<'t>),
    /// The spheres of a leaf.
    Spheres(NodeRef<'t>),
}

/// The children of the wide node that `node` becomes, from left to right.
pub(crate) fn wide_children(node: NodeRef<'_>) -> Vec<WideChild<'_>> {
    let mut children = Vec::with_capacity(LANES);
    add_both(node, node.get().shares[0], LANES, &mut children);
    children
}

/// Adds what is below both children of `node`: the left one gets `share` of the `lanes`. The
/// children of a leaf are its blocks.
fn add_both<'t>(node: NodeRef<'t>, share: u8, lanes: usize, children: &mut Vec<WideChild<'t>>) {
    let share = usize::from(share);
    if let Some([left, right]) = node.children() {
        add(left, share, children);
        add(right, lanes - share, children);
    } else {
        children.push(WideChild::Triangles(node));
        children.push(WideChild::Spheres(node));
    }
}

/// Adds what is below `node` as at most `lanes` children; at equal cost as few as possible.
fn add<'t>(node: NodeRef<'t>, mut lanes: usize, children: &mut Vec<WideChild<'t>>) {
    let binary = node.get();
    while lanes > 1 && binary.shares[lanes - 1] == 0 {
        lanes -= 1;
    }
    if lanes > 1 {
        add_both(node, binary.shares[lanes - 1], lanes, children);
    } else if binary.size.nodes > 0 {
        children.push(WideChild::Node(node));
    } else if binary.size.triangle_blocks > 0 {
        children.push(WideChild::Triangles(node));
    } else {
        children.push(WideChild::Spheres(node));
    }
}
