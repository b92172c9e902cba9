// BEGIN SOLUTION(part6.task1)
//! Building: the binary tree that rays find cheapest, by the surface area heuristic.

use kit::{Aabb, Bvh, BvhNode, NodeKind, PrimId, Vec3};

/// Primitives in a leaf at most: as many as are tested at once.
pub(crate) const LANES: usize = 8;

/// Planes that are tried along an axis are one fewer. Twice as many save 0.5 % of the work.
const BINS: usize = 16;

/// What a step to a node costs, in units of a test of a leaf, however many primitives that holds.
const STEP_COST: f64 = 1.0;

/// Splits by cost on the way down before halves take over, so that the recursion ends.
const MAX_DEPTH: u32 = 64;

/// A tree over the primitives that have a box at all, with at most [`LANES`] of them in a leaf; ids within a leaf ascend.
///
/// A ray that meets a convex box meets a smaller one inside it with a probability that is the ratio of their surface
/// areas. So a split into `L` and `R` is expected to cost `step + (area(L)·tests(L) + area(R)·tests(R)) / area`, where
/// `tests` is how often lanes have to be filled: primitives over [`LANES`], rounded up (MacDonald and Booth, "Heuristics
/// for ray tracing using space subdivision", 1990). Tried are the planes between [`BINS`] bins of centroids on each axis
/// (Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007).
pub(crate) fn build(bounds: &[Aabb]) -> Bvh {
    let mut items: Vec<Item> = (0..)
        .zip(bounds)
        .filter(|(_, bounds)| !bounds.is_empty())
        .map(|(id, &bounds)| Item::new(id, bounds))
        .collect();
    if items.is_empty() {
        return Bvh::default();
    }
    let mut nodes = vec![UNBUILT];
    split(&mut nodes, 0, &mut items, 0, 0);
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

/// A primitive on its way into the tree.
#[derive(Clone, Copy)]
struct Item {
    bounds: Aabb,
    centroid: Vec3,
    id: u32,
}

impl Item {
    fn new(id: u32, bounds: Aabb) -> Item {
        // A box that reaches to infinity counts as very far away: no NaN.
        let (far, most) = (Vec3::splat(-1e300), Vec3::splat(1e300));
        let within = Aabb {
            min: bounds.min.clamp(far, most),
            max: bounds.max.clamp(far, most),
        };
        Item {
            bounds,
            centroid: within.centroid(),
            id,
        }
    }
}

/// Builds the subtree over `items`, which start at `first` in the tree's order, into place `node`.
fn split(nodes: &mut Vec<BvhNode>, node: usize, items: &mut [Item], first: u32, depth: u32) {
    let bounds = items
        .iter()
        .fold(Aabb::EMPTY, |all, item| all.union(item.bounds));
    let plane = if depth < MAX_DEPTH {
        cheapest_plane(items, bounds)
    } else {
        None
    };
    let is_small = items.len() <= LANES;
    // A leaf is one test of all its lanes.
    let is_leaf = is_small && plane.as_ref().is_none_or(|plane| plane.cost >= 1.0);
    if is_leaf {
        items.sort_unstable_by_key(|item| item.id);
        let count = items.len() as u32;
        nodes[node] = BvhNode {
            bounds,
            kind: NodeKind::Leaf { first, count },
        };
        return;
    }
    let middle = match plane {
        Some(plane) => partition(items, |item| plane.bins.of(item) < plane.bin),
        None => {
            items.sort_unstable_by_key(|item| item.id);
            items.len() / 2
        }
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

/// Where centroids fall along an axis.
#[derive(Clone, Copy)]
struct Bins {
    axis: usize,
    start: f64,
    /// Bins per length.
    scale: f64,
}

impl Bins {
    /// The bins between `min` and `max`; `None` if that is nothing to split.
    fn between(axis: usize, min: f64, max: f64) -> Option<Bins> {
        let scale = BINS as f64 / (max - min);
        (max > min && scale.is_finite() && scale > 0.0).then_some(Bins {
            axis,
            start: min,
            scale,
        })
    }

    #[inline]
    fn of(&self, item: &Item) -> usize {
        (((item.centroid[self.axis] - self.start) * self.scale) as usize).min(BINS - 1)
    }
}

/// A way to split: items in bins below `bin` go left.
struct Plane {
    bins: Bins,
    bin: usize,
    /// In units of a test of a leaf.
    cost: f64,
}

/// What is in a bin, or on one side of a plane.
#[derive(Clone, Copy)]
struct Side {
    bounds: Aabb,
    count: usize,
}

impl Side {
    const NONE: Side = Side {
        bounds: Aabb::EMPTY,
        count: 0,
    };

    fn with(self, other: Side) -> Side {
        Side {
            bounds: self.bounds.union(other.bounds),
            count: self.count + other.count,
        }
    }

    /// Area times tests.
    fn cost(&self) -> f64 {
        self.bounds.surface_area() * self.count.div_ceil(LANES) as f64
    }
}

/// The cheapest plane with something on both sides, if there is any and costs are numbers.
fn cheapest_plane(items: &[Item], bounds: Aabb) -> Option<Plane> {
    let centroids = Aabb::of(items.iter().map(|item| item.centroid));
    let area = bounds.surface_area();
    let mut best: Option<Plane> = None;
    for axis in 0..3 {
        let Some(bins) = Bins::between(axis, centroids.min[axis], centroids.max[axis]) else {
            continue;
        };
        let mut contents = [Side::NONE; BINS];
        for item in items {
            let content = &mut contents[bins.of(item)];
            content.bounds = content.bounds.union(item.bounds);
            content.count += 1;
        }
        // From the right: what lies at and above each plane.
        let mut above = [Side::NONE; BINS];
        let mut so_far = Side::NONE;
        for bin in (1..BINS).rev() {
            so_far = so_far.with(contents[bin]);
            above[bin] = so_far;
        }
        let mut below = Side::NONE;
        for bin in 1..BINS {
            below = below.with(contents[bin - 1]);
            if below.count == 0 || above[bin].count == 0 {
                continue;
            }
            let cost = STEP_COST + (below.cost() + above[bin].cost()) / area;
            if cost.is_finite() && best.as_ref().is_none_or(|best| cost < best.cost) {
                best = Some(Plane { bins, bin, cost });
            }
        }
    }
    best
}
// END SOLUTION(part6.task1)
