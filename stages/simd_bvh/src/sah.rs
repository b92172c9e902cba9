// BEGIN SOLUTION(part6.task1)
//! The surface area heuristic: where to split a set of primitives.

use kit::{Aabb, Vec3};

/// Primitives in a leaf at most: as many as are tested at once.
pub(crate) const LANES: usize = 8;

/// Planes that are tried along an axis are one fewer. Twice as many save 0.5 % of the work.
const BINS: usize = 16;

/// A primitive on its way into the tree.
#[derive(Clone, Copy)]
pub(crate) struct Item {
    pub(crate) bounds: Aabb,
    pub(crate) centroid: Vec3,
    pub(crate) id: u32,
}

impl Item {
    pub(crate) fn new(id: u32, bounds: Aabb) -> Item {
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
pub(crate) struct Plane {
    bins: Bins,
    bin: usize,
    /// Beside the step, in units of a test of a leaf.
    cost: f64,
}

impl Plane {
    /// Whether an item goes left.
    #[inline]
    pub(crate) fn is_below(&self, item: &Item) -> bool {
        self.bins.of(item) < self.bin
    }
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
///
/// A ray that meets a convex box meets a smaller one inside it with a probability that is the ratio of their surface
/// areas. So a split into `L` and `R` is expected to cost a step and `(area(L)·tests(L) + area(R)·tests(R)) / area`, where
/// `tests` is how often lanes have to be filled: primitives over [`LANES`], rounded up (MacDonald and Booth, "Heuristics
/// for ray tracing using space subdivision", 1990). Tried are the planes between [`BINS`] bins of centroids on each axis
/// (Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007).
pub(crate) fn cheapest_plane(items: &[Item], bounds: Aabb, centroids: Aabb) -> Option<Plane> {
    let axes: [Option<Bins>; 3] =
        std::array::from_fn(|axis| Bins::between(axis, centroids.min[axis], centroids.max[axis]));
    let mut contents = [[Side::NONE; BINS]; 3];
    for item in items {
        for bins in axes.iter().flatten() {
            let content = &mut contents[bins.axis][bins.of(item)];
            content.bounds = content.bounds.union(item.bounds);
            content.count += 1;
        }
    }
    let area = bounds.surface_area();
    let mut best: Option<Plane> = None;
    for bins in axes.into_iter().flatten() {
        let contents = &contents[bins.axis];
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
            let cost = (below.cost() + above[bin].cost()) / area;
            if cost.is_finite() && best.as_ref().is_none_or(|best| cost < best.cost) {
                best = Some(Plane { bins, bin, cost });
            }
        }
    }
    best
}
// END SOLUTION(part6.task1)
