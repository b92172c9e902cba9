//! The tree: given, so that it can be built by hand, walked by the grader and drawn by a viewer.

use crate::{Aabb, PrimId};

/// A bounding volume hierarchy. `nodes[0]` is the root; a tree over nothing has no nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bvh {
    /// The nodes, in any order but for the root.
    pub nodes: Vec<BvhNode>,
    /// Every primitive once. A leaf names a run of this list.
    pub order: Vec<PrimId>,
}

/// A box around everything below it, and what is below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BvhNode {
    /// Holds the boxes of all primitives below.
    pub bounds: Aabb,
    /// Two children, or a run of primitives.
    pub kind: NodeKind,
}

/// What lies below a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// Two child nodes.
    Interior {
        /// Index in [`Bvh::nodes`].
        left: u32,
        /// Index in [`Bvh::nodes`].
        right: u32,
    },
    /// The primitives `order[first .. first + count]`.
    Leaf {
        /// Index in [`Bvh::order`].
        first: u32,
        /// How many.
        count: u32,
    },
}

impl Bvh {
    /// The tree with a single leaf that holds everything: every ray is tested against every primitive.
    pub fn one_leaf(bounds: &[Aabb]) -> Bvh {
        let all = bounds.iter().fold(Aabb::EMPTY, |all, b| all.union(*b));
        let count = u32::try_from(bounds.len()).expect("fewer than 2^32 primitives");
        let root = BvhNode {
            bounds: all,
            kind: NodeKind::Leaf { first: 0, count },
        };
        Bvh {
            nodes: if count == 0 { Vec::new() } else { vec![root] },
            order: (0..count).map(PrimId).collect(),
        }
    }

    /// The primitives of a leaf, given its `first` and `count`.
    #[inline]
    pub fn leaf(&self, first: u32, count: u32) -> &[PrimId] {
        &self.order[first as usize..first as usize + count as usize]
    }
}
