//! Task 1: building the tree, top down, by splitting space in the middle.

// BEGIN SOLUTION(part2.task1)
use kit::{BvhNode, NodeKind, PrimId, Vec3};
// END SOLUTION(part2.task1)

use kit::{Aabb, Bvh};

/// Builds a tree over the boxes of primitives `0..bounds.len()`, in world space.
///
/// A node with at most `max_leaf_size` primitives is a leaf (0 counts as 1). A larger one is split in two: along
/// the axis on which the primitives' centroids spread most, at the middle of that spread, centroids below the
/// middle to the left. The middle of the *centroids* leaves a side empty only if all centroids are equal, where
/// the middle of the *boxes* also does so for one large primitive among small ones.
///
/// The odd cases:
/// - No primitives: no nodes.
/// - One side of the split empty (equal centroids), or more than 64 splits on the way down (centroids that halve
///   their distance again and again): the median primitive along the axis splits instead, lower ids first among
///   equals. So the tree is never deeper than 64 + log2(n).
/// - An empty box (also one with a NaN corner): adds nothing to its node's box, so no ray need find it; it still
///   stands in `order`.
/// - Boxes of any size up to infinite ones: nothing overflows.
///
/// The tree depends on the boxes alone. The ids within a leaf ascend.
pub fn construct_bvh(bounds: &[Aabb], max_leaf_size: usize) -> Bvh {
    // BEGIN SOLUTION(part2.task1)
    assert!(
        bounds.len() < MAX_PRIMITIVES,
        "a tree over {} primitives needs node numbers beyond 32 bits",
        bounds.len()
    );
    if bounds.is_empty() {
        return Bvh::default();
    }
    let mut items: Vec<Item> = (0..).zip(bounds).map(Item::new).collect();
    let mut builder = Builder {
        bounds,
        max_leaf_size: max_leaf_size.max(1),
        nodes: vec![UNBUILT],
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
/// A binary tree over `n` primitives has at most `2n - 1` nodes, and a node's number has 32 bits.
const MAX_PRIMITIVES: usize = 1 << 31;

/// Splits at the middle on the way down, before the median takes over: more than any mesh of ordinary
/// proportions needs (each split halves a space), few enough for the recursion.
const MAX_MIDDLE_SPLITS: u32 = 64;

/// Holds a node's place until its subtree is built.
const UNBUILT: BvhNode = BvhNode {
    bounds: Aabb::EMPTY,
    kind: NodeKind::Leaf { first: 0, count: 0 },
};

/// A primitive on its way into the tree. Splitting looks at nothing else.
#[derive(Clone, Copy)]
struct Item {
    /// Middle of the primitive's box; NaN on an axis without one.
    centroid: Vec3,
    id: u32,
}

impl Item {
    fn new((id, bounds): (u32, &Aabb)) -> Item {
        let centroid = if bounds.is_empty() {
            Vec3::NAN
        } else {
            // A box that reaches to infinity counts as very far away, so that a split can still tell it apart.
            bounds.centroid().clamp(Vec3::MIN, Vec3::MAX)
        };
        Item { centroid, id }
    }
}

/// The boxes, and the tree so far.
struct Builder<'a> {
    bounds: &'a [Aabb],
    max_leaf_size: usize,
    nodes: Vec<BvhNode>,
}

impl Builder<'_> {
    /// Builds the subtree over `items`, which start at `first` in the tree's order, into place `node`. Puts `items`
    /// into the order of the leaves and returns the subtree's box.
    fn build(&mut self, node: usize, items: &mut [Item], first: u32, depth: u32) -> Aabb {
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

    fn leaf(&self, items: &mut [Item], first: u32) -> (Aabb, NodeKind) {
        items.sort_unstable_by_key(|item| item.id);
        let bounds = items
            .iter()
            .map(|item| self.bounds[item.id as usize])
            .filter(|b| !b.is_empty())
            .fold(Aabb::EMPTY, Aabb::union);
        let count = items.len() as u32;
        (bounds, NodeKind::Leaf { first, count })
    }

    /// The first `count` items go left. The two children stand side by side, as a ray asks for both at once.
    fn interior(
        &mut self,
        items: &mut [Item],
        count: usize,
        first: u32,
        depth: u32,
    ) -> (Aabb, NodeKind) {
        let children = self.nodes.len();
        self.nodes.extend([UNBUILT; 2]);
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

/// The axis on which the centroids spread most, and the middle of that spread. Passes over centroids with a NaN.
fn widest_axis(items: &[Item]) -> (usize, f64) {
    let centroids = items.iter().map(|item| item.centroid);
    let spread = Aabb::of(centroids.filter(|c| !c.is_nan()));
    // Half the extent: the whole one may overflow.
    let half = 0.5 * spread.max - 0.5 * spread.min;
    let axis = half.max_position();
    (axis, spread.centroid()[axis])
}

/// Moves the items that `goes_left` to the front, in place; returns how many they are.
fn partition(items: &mut [Item], goes_left: impl Fn(&Item) -> bool) -> usize {
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
