//! Part 2, task 1: top-down construction of the tree by spatial midpoint splits.

// BEGIN SOLUTION(part2.task1)
use kit::{BvhNode, NodeKind, PrimId, Vec3};
// END SOLUTION(part2.task1)

use kit::{Aabb, Bvh};

/// Builds a tree over the boxes of primitives `0..bounds.len()`, in world space.
///
/// Chapter: stages/book/src/part2/task1.md
///
/// A node with at most `max_leaf_size` primitives becomes a leaf (0 counts as 1). Splitting such a
/// node further is accepted, too, because the tree stays right.
///
/// A larger node is split at the midpoint of the bounds of its primitives' centroids, along their
/// longest axis. Primitives with centroids below the midpoint go to the left child. One side is
/// empty only if all centroids are equal, up to rounding. A split at the midpoint of the *boxes*
/// would also leave one side empty for a large primitive among small ones.
///
/// Special cases:
/// - Without primitives there are no nodes, not even an empty leaf.
/// - If one side would be empty (equal centroids), the node is split at the median primitive along
///   the axis; equal centroids are sorted by id. After 64 splits on the path from the root, every
///   node is split so (centroids whose distances halve again and again). So the depth is at most 64
///   + log2(n).
/// - An empty box (also one with a NaN coordinate) does not extend the box of its node, so a ray
///   need not find its primitive. The primitive is still part of `order`.
/// - Boxes can be arbitrarily large, and even infinite: nothing overflows.
///
/// The tree depends only on the boxes. A leaf may hold its primitives in any order.
///
/// See it: `cargo grader picture part2.task1`.
pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    // BEGIN SOLUTION(part2.task1)
    assert!(
        bounds.len() < MAX_PRIMITIVES,
        "a tree over {} primitives needs node indices of more than 32 bits",
        bounds.len()
    );
    if bounds.is_empty() {
        return Bvh::default();
    }
    let mut items: Vec<BvhPrimitive> = (0..).zip(bounds).map(BvhPrimitive::new).collect();
    let mut builder = Builder {
        bounds,
        max_leaf_size: max_leaf_size.max(1),
        nodes: vec![PLACEHOLDER],
    };
    builder.build(0, &mut items, 0, 0);
    Bvh {
        nodes: builder.nodes,
        order: items.iter().map(|item| PrimId(item.id)).collect(),
    }
    // STUB: // Works, but slowly: one leaf that holds everything.
    // STUB: kit::untouched!("part2.task1");
    // STUB: let _ = max_leaf_size;
    // STUB: Bvh::one_leaf(bounds)
    // END SOLUTION(part2.task1)
}

// BEGIN SOLUTION(part2.task1)
/// A binary tree over `n` primitives has at most `2n - 1` nodes, and a node index has 32 bits.
const MAX_PRIMITIVES: usize = 1 << 31;

/// Number of midpoint splits on a path from the root, after which nodes are split at the median. It
/// is more than any ordinary mesh needs (each split halves a space), and small enough for the
/// recursion.
const MAX_MIDDLE_SPLITS: u32 = 64;

/// A node whose subtree is not built yet.
const PLACEHOLDER: BvhNode = BvhNode {
    bounds: Aabb::EMPTY,
    kind: NodeKind::Leaf { first: 0, count: 0 },
};

/// A primitive during construction: the data that splits use.
#[derive(Clone, Copy)]
struct BvhPrimitive {
    /// Centre of the primitive's box; NaN if the box is empty.
    centroid: Vec3,
    id: u32,
}

impl BvhPrimitive {
    fn new((id, bounds): (u32, &Aabb)) -> BvhPrimitive {
        let centroid = if bounds.is_empty() {
            Vec3::NAN
        } else {
            // An infinite box counts as very far away, so that a split can still separate it.
            bounds.centroid().clamp(Vec3::MIN, Vec3::MAX)
        };
        BvhPrimitive { centroid, id }
    }
}

/// The input boxes and the nodes built so far.
struct Builder<'a> {
    bounds: &'a [Aabb],
    max_leaf_size: usize,
    nodes: Vec<BvhNode>,
}

impl Builder<'_> {
    /// Builds the subtree over `items` at index `node`. `items` start at position `first` of the
    /// tree's order. Sorts `items` into the order of the leaves and returns the box of the subtree.
    fn build(&mut self, node: usize, items: &mut [BvhPrimitive], first: u32, depth: u32) -> Aabb {
        let (bounds, kind) = if items.len() <= self.max_leaf_size {
            self.leaf(items, first)
        } else {
            let (axis, middle) = widest_axis(items);
            let mut count = partition(items, |item| item.centroid[axis] < middle);
            if count == 0 || count == items.len() || depth >= MAX_MIDDLE_SPLITS {
                count = items.len() / 2;
                items.select_nth_unstable_by(count, |a, b| {
                    let along = a.centroid[axis].total_cmp(&b.centroid[axis]);
                    along.then(a.id.cmp(&b.id))
                });
            }
            self.interior(items, count, first, depth)
        };
        self.nodes[node] = BvhNode { bounds, kind };
        bounds
    }

    fn leaf(&self, items: &mut [BvhPrimitive], first: u32) -> (Aabb, NodeKind) {
        items.sort_unstable_by_key(|item| item.id);
        let bounds = items
            .iter()
            .map(|item| self.bounds[item.id as usize])
            .filter(|b| !b.is_empty())
            .fold(Aabb::EMPTY, Aabb::union);
        let count = items.len() as u32;
        (bounds, NodeKind::Leaf { first, count })
    }

    /// Builds an interior node with the first `count` items on the left. The two children are
    /// adjacent in memory, because a traversal tests both boxes together.
    fn interior(
        &mut self,
        items: &mut [BvhPrimitive],
        count: usize,
        first: u32,
        depth: u32,
    ) -> (Aabb, NodeKind) {
        let children = self.nodes.len();
        self.nodes.extend([PLACEHOLDER; 2]);
        let (low, high) = items.split_at_mut(count);
        let low_bounds = self.build(children, low, first, depth + 1);
        let high_bounds = self.build(children + 1, high, first + count as u32, depth + 1);
        let left = children as u32;
        let right = left + 1;
        (
            low_bounds.union(high_bounds),
            NodeKind::Interior { left, right },
        )
    }
}

/// The longest axis of the bounds of all centroids, and the midpoint on it. Ignores NaN centroids.
fn widest_axis(items: &[BvhPrimitive]) -> (usize, f64) {
    let centroids = items.iter().map(|item| item.centroid);
    let spread = Aabb::of(centroids.filter(|c| !c.is_nan()));
    // Half the extent, because the full extent may overflow.
    let half = 0.5 * spread.max - 0.5 * spread.min;
    let axis = half.max_position();
    (axis, spread.centroid()[axis])
}

/// Moves the items for which `goes_left` is true to the front, in place. Returns their number.
fn partition(items: &mut [BvhPrimitive], goes_left: impl Fn(&BvhPrimitive) -> bool) -> usize {
    let mut count = 0;
    for i in 0..items.len() {
        if goes_left(&items[i]) {
            items.swap(i, count);
            count += 1;
        }
    }
    count
}
// END SOLUTION(part2.task1)
