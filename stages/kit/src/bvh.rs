//! The bounding volume hierarchy as data. It is not part of a task: the grader builds trees by
//! hand, and the viewer draws them.

use crate::{Aabb, PrimId};

/// A bounding volume hierarchy. `nodes[0]` is the root; the tree of an empty scene has no nodes.
///
/// ```
/// use kit::{Aabb, Bvh, NodeKind, PrimId, Vec3};
/// let unit = Aabb::of([Vec3::ZERO, Vec3::ONE]);
/// let tree = Bvh::one_leaf(&[unit, unit]);
/// assert_eq!(tree.nodes[0].bounds, unit);
/// let NodeKind::Leaf { first, count } = tree.nodes[0].kind else {
///     panic!("the root is a leaf");
/// };
/// assert_eq!(tree.leaf(first, count), [PrimId(0), PrimId(1)]);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bvh {
    /// The nodes. Only the position of the root is fixed.
    pub nodes: Vec<BvhNode>,
    /// A permutation of all primitives. A leaf refers to a range of this list.
    pub order: Vec<PrimId>,
}

/// A node: the bounding box of a subtree, and its children or primitives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BvhNode {
    /// Contains the boxes of all primitives in the subtree.
    pub bounds: Aabb,
    /// Interior node or leaf.
    pub kind: NodeKind,
}

/// The two kinds of nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// An interior node with two children.
    Interior {
        /// Index in [`Bvh::nodes`].
        left: u32,
        /// Index in [`Bvh::nodes`].
        right: u32,
    },
    /// A leaf with the primitives `order[first .. first + count]`.
    Leaf {
        /// Index in [`Bvh::order`].
        first: u32,
        /// Number of primitives.
        count: u32,
    },
}

impl Bvh {
    /// The tree with a single leaf that contains all primitives: every ray is tested against each
    /// of them.
    pub fn one_leaf(bounds: &[Aabb]) -> Bvh {
        let all = bounds.iter().fold(Aabb::EMPTY, |all, b| all.union(*b));
        let count = u32::try_from(bounds.len()).expect("there are fewer than 2^32 primitives");
        let root = BvhNode {
            bounds: all,
            kind: NodeKind::Leaf { first: 0, count },
        };
        Bvh {
            nodes: if count == 0 { Vec::new() } else { vec![root] },
            order: (0..count).map(PrimId).collect(),
        }
    }

    /// The primitives of a leaf with the given `first` and `count`.
    #[inline]
    pub fn leaf(&self, first: u32, count: u32) -> &[PrimId] {
        &self.order[first as usize..first as usize + count as usize]
    }
}
