//! Builds the binary tree of least expected cost, from the root downwards, with the surface area
//! heuristic, and on the way back to the root decides how it collapses to a wide tree.

use crate::build::collapse::{Costs, Shares};
use crate::build::sah::{BuildPrimitive, Enclosure, SplitPlane, cheapest_plane};
use crate::layout::LANES;
use crate::layout::packed_box::PackedBox;
use fearless_simd::Level;
use std::ops::{Add, Range};

/// The depth below which nodes are split by the heuristic; from there on in halves, so that the
/// recursion ends.
const MAX_DEPTH: u32 = 64;

/// From this many primitives on, the two subtrees of a split are built in parallel.
const MIN_PARALLEL: usize = 1 << 12;

/// A node of the binary tree.
pub(crate) struct BinaryNode {
    pub(crate) bounds: PackedBox,
    pub(crate) shares: Shares,
    pub(crate) size: WideSize,
    /// In a piece, the index of the right child; the left one is the next node. 0 for a leaf.
    right: u32,
    /// The first primitive of a leaf. Its triangles come before its spheres, and each is in it
    /// once.
    first: u32,
    /// The numbers of triangles and of spheres of a leaf.
    counts: [u8; 2],
}

/// What a subtree adds to the wide tree.
#[derive(Clone, Copy, Default)]
pub(crate) struct WideSize {
    pub(crate) nodes: u32,
    pub(crate) triangle_blocks: u32,
    pub(crate) sphere_blocks: u32,
}

impl Add for WideSize {
    type Output = WideSize;

    fn add(self, other: WideSize) -> WideSize {
        WideSize {
            nodes: self.nodes + other.nodes,
            triangle_blocks: self.triangle_blocks + other.triangle_blocks,
            sphere_blocks: self.sphere_blocks + other.sphere_blocks,
        }
    }
}

/// A tree, in pieces that were built in parallel.
pub(crate) enum BinaryTree {
    /// The nodes, the root first, each before those below it.
    Piece(Vec<BinaryNode>),
    /// A node above two trees.
    Joint(Box<(BinaryNode, [BinaryTree; 2])>),
}

impl BinaryTree {
    pub(crate) fn root(&self) -> NodeRef<'_> {
        match self {
            BinaryTree::Piece(nodes) => NodeRef::InPiece(nodes, 0),
            BinaryTree::Joint(joint) => NodeRef::Joint(joint),
        }
    }
}

/// A node of a [`BinaryTree`].
#[derive(Clone, Copy)]
pub(crate) enum NodeRef<'t> {
    /// The node with an index in a piece.
    InPiece(&'t [BinaryNode], u32),
    /// A node above two trees.
    Joint(&'t (BinaryNode, [BinaryTree; 2])),
}

impl<'t> NodeRef<'t> {
    pub(crate) fn get(self) -> &'t BinaryNode {
        match self {
            NodeRef::InPiece(nodes, number) => &nodes[number as usize],
            NodeRef::Joint((node, _)) => node,
        }
    }

    /// The left and the right child; `None` for a leaf.
    pub(crate) fn children(self) -> Option<[NodeRef<'t>; 2]> {
        match self {
            NodeRef::InPiece(nodes, number) => match nodes[number as usize].right {
                0 => None,
                right => Some([number + 1, right].map(|child| NodeRef::InPiece(nodes, child))),
            },
            NodeRef::Joint((_, [left, right])) => Some([left.root(), right.root()]),
        }
    }
}

impl BinaryNode {
    /// The places of the triangles of a leaf in the tree's order.
    pub(crate) fn triangles(&self) -> Range<u32> {
        self.first..self.first + u32::from(self.counts[0])
    }

    /// The places of the spheres of a leaf in the tree's order.
    pub(crate) fn spheres(&self) -> Range<u32> {
        let first = self.first + u32::from(self.counts[0]);
        first..first + u32::from(self.counts[1])
    }

    fn interior(
        bounds: PackedBox,
        right: u32,
        costs: &[Costs; 2],
        sizes: [WideSize; 2],
    ) -> (BinaryNode, Costs) {
        let (costs, shares) = Costs::above(costs, bounds.half_area());
        let node = BinaryNode {
            bounds,
            shares,
            size: WideSize {
                nodes: costs.node_count(),
                ..sizes[0] + sizes[1]
            },
            right,
            first: 0,
            counts: [0; 2],
        };
        (node, costs)
    }
}

/// Builds a tree over `prims`, one or more, with at most [`LANES`] in a leaf, and puts them into
/// the tree's order. Spheres have numbers from `first_sphere` on. Ids in a leaf ascend. The result
/// does not depend on the number of threads.
pub(crate) fn build(prims: &mut [BuildPrimitive], first_sphere: u32, level: Level) -> BinaryTree {
    let builder = Builder {
        first_sphere,
        level,
    };
    builder.subtree(prims, 0, 0).0
}

#[derive(Clone, Copy)]
struct Builder {
    first_sphere: u32,
    level: Level,
}

impl Builder {
    /// Builds the subtree over `prims`, which start at `first` in the tree's order.
    fn subtree(self, prims: &mut [BuildPrimitive], first: u32, depth: u32) -> (BinaryTree, Costs) {
        if prims.len() < MIN_PARALLEL {
            let mut nodes = Vec::with_capacity(prims.len() / 2 + 1);
            let costs = self.add(&mut nodes, prims, first, depth);
            return (BinaryTree::Piece(nodes), costs);
        }
        let (bounds, middle) = self.split(prims, depth);
        let (below, above) = prims.split_at_mut(middle);
        let ((left, left_costs), (right, right_costs)) = rayon::join(
            || self.subtree(below, first, depth + 1),
            || self.subtree(above, first + middle as u32, depth + 1),
        );
        let sizes = [&left, &right].map(|tree| tree.root().get().size);
        let (root, costs) = BinaryNode::interior(bounds, 0, &[left_costs, right_costs], sizes);
        let joint = BinaryTree::Joint(Box::new((root, [left, right])));
        (joint, costs)
    }

    /// Adds the nodes of the subtree over `prims`, which start at `first` in the tree's order.
    fn add(
        self,
        nodes: &mut Vec<BinaryNode>,
        prims: &mut [BuildPrimitive],
        first: u32,
        depth: u32,
    ) -> Costs {
        // A leaf of one block is one test, and no split costs less.
        if prims.len() <= LANES {
            let (leaf, costs) = self.leaf(prims, first);
            nodes.push(leaf);
            return costs;
        }
        let (bounds, middle) = self.split(prims, depth);
        let (below, above) = prims.split_at_mut(middle);
        let number = nodes.len();
        nodes.push(BinaryNode {
            bounds,
            shares: [0; LANES],
            size: WideSize::default(),
            right: 0,
            first: 0,
            counts: [0; 2],
        });
        let left_costs = self.add(nodes, below, first, depth + 1);
        let right = nodes.len();
        let right_costs = self.add(nodes, above, first + middle as u32, depth + 1);
        let sizes = [nodes[number + 1].size, nodes[right].size];
        let costs = [left_costs, right_costs];
        let (node, costs) = BinaryNode::interior(bounds, right as u32, &costs, sizes);
        nodes[number] = node;
        costs
    }

    /// The leaf of `prims`, one to eight. Parts of one triangle become one primitive.
    fn leaf(self, prims: &mut [BuildPrimitive], first: u32) -> (BinaryNode, Costs) {
        prims.sort_unstable_by_key(BuildPrimitive::id);
        let mut last = 0;
        let mut bounds = prims[0].bounds();
        for i in 1..prims.len() {
            let prim = prims[i];
            bounds = bounds.union(prim.bounds());
            if prim.id() == prims[last].id() {
                prims[last].enclose(&prim);
            } else {
                last += 1;
                prims[last] = prim;
            }
        }
        let prims = &prims[..=last];
        let triangles = prims.partition_point(|prim| prim.id() < self.first_sphere);
        let counts = [triangles, prims.len() - triangles];
        let (costs, shares) = if counts.contains(&0) {
            (Costs::BLOCK, [0; LANES])
        } else {
            Costs::of_mixed_leaf(bounds.half_area())
        };
        let leaf = BinaryNode {
            bounds,
            shares,
            size: WideSize {
                nodes: costs.node_count(),
                triangle_blocks: u32::from(counts[0] > 0),
                sphere_blocks: u32::from(counts[1] > 0),
            },
            right: 0,
            first,
            counts: counts.map(|count| count as u8),
        };
        (leaf, costs)
    }

    /// Partitions `prims`, two or more. Returns their box and how many of them go left.
    fn split(self, prims: &mut [BuildPrimitive], depth: u32) -> (PackedBox, usize) {
        let enclosure = Enclosure::of(prims, self.level);
        let plane = if depth < MAX_DEPTH {
            cheapest_plane(prims, &enclosure, self.level)
        } else {
            None
        };
        let middle = match plane {
            Some(plane) => partition(prims, &plane),
            None => {
                prims.sort_unstable_by_key(BuildPrimitive::id);
                prims.len() / 2
            }
        };
        (enclosure.bounds, middle)
    }
}

/// Moves the primitives below `plane` to the front and returns their number. It swaps always: a
/// branch would be mispredicted half of the time. It tests a primitive before the swap: after it,
/// each test would wait for the store of the one before.
fn partition(prims: &mut [BuildPrimitive], plane: &SplitPlane) -> usize {
    let mut count = 0;
    for i in 0..prims.len() {
        let is_below = plane.is_below(&prims[i]);
        prims.swap(i, count);
        count += usize::from(is_below);
    }
    count
}
