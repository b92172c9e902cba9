// BEGIN SOLUTION(part6.task1)
//! The surface area heuristic: where to split a set of primitives.

use kit::{Aabb, Vec3};

/// The largest number of primitives in a leaf, which are tested at once.
pub(crate) const LANES: usize = 8;

/// Bins along an axis, with a candidate plane between neighbours. Twice as many save 0.5 % of the
/// tests.
const BINS: usize = 16;

/// A primitive during the build.
#[derive(Clone, Copy)]
pub(crate) struct BuildPrimitive {
    pub(crate) bounds: Aabb,
    pub(crate) centroid: Vec3,
    pub(crate) id: u32,
}

impl BuildPrimitive {
    pub(crate) fn new(id: u32, bounds: Aabb) -> BuildPrimitive {
        // Infinite boxes are clamped, so that no centroid is NaN.
        let (far, most) = (Vec3::splat(-1e300), Vec3::splat(1e300));
        let clamped = Aabb {
            min: bounds.min.clamp(far, most),
            max: bounds.max.clamp(far, most),
        };
        BuildPrimitive {
            bounds,
            centroid: clamped.centroid(),
            id,
        }
    }
}

/// The bins along an axis, by centroid.
#[derive(Clone, Copy)]
struct Bins {
    axis: usize,
    start: f64,
    /// Bins per unit of length.
    scale: f64,
}

impl Bins {
    /// The bins between `min` and `max`; `None` if the interval is empty.
    fn between(axis: usize, min: f64, max: f64) -> Option<Bins> {
        let scale = BINS as f64 / (max - min);
        (max > min && scale.is_finite() && scale > 0.0).then_some(Bins {
            axis,
            start: min,
            scale,
        })
    }

    #[inline]
    fn of(&self, prim: &BuildPrimitive) -> usize {
        (((prim.centroid[self.axis] - self.start) * self.scale) as usize).min(BINS - 1)
    }
}

/// A splitting plane: primitives in bins below `bin` go left.
pub(crate) struct SplitPlane {
    bins: Bins,
    bin: usize,
    /// Expected cost of the children, in units of a leaf test.
    cost: f64,
}

impl SplitPlane {
    /// Whether a primitive goes left.
    #[inline]
    pub(crate) fn is_below(&self, prim: &BuildPrimitive) -> bool {
        self.bins.of(prim) < self.bin
    }
}

/// The contents of a bin, or of all bins on one side of a plane.
#[derive(Clone, Copy)]
struct BinContents {
    bounds: Aabb,
    count: usize,
}

impl BinContents {
    const NONE: BinContents = BinContents {
        bounds: Aabb::EMPTY,
        count: 0,
    };

    fn with(self, other: BinContents) -> BinContents {
        BinContents {
            bounds: self.bounds.union(other.bounds),
            count: self.count + other.count,
        }
    }

    /// Surface area times the number of leaf tests.
    fn cost(&self) -> f64 {
        self.bounds.surface_area() * self.count.div_ceil(LANES) as f64
    }
}

/// The plane of least cost with primitives on both sides; `None` if there is none with a finite
/// cost.
///
/// A ray that hits a convex box hits a smaller one inside it with a probability that is the ratio
/// of their surface areas. So a split into `L` and `R` has the expected cost of one step and
/// `(area(L)·tests(L) + area(R)·tests(R)) / area`, where `tests` is the number of leaf tests:
/// primitives over [`LANES`], rounded up (MacDonald and Booth, "Heuristics for ray tracing using
/// space subdivision", 1990). The candidates are the planes between [`BINS`] bins of centroids on
/// each axis (Wald, "On fast construction of SAH-based bounding volume hierarchies", 2007).
pub(crate) fn cheapest_plane(
    prims: &[BuildPrimitive],
    bounds: Aabb,
    centroids: Aabb,
) -> Option<SplitPlane> {
    let axes: [Option<Bins>; 3] =
        std::array::from_fn(|axis| Bins::between(axis, centroids.min[axis], centroids.max[axis]));
    let mut contents = [[BinContents::NONE; BINS]; 3];
    for prim in prims {
        for bins in axes.iter().flatten() {
            let content = &mut contents[bins.axis][bins.of(prim)];
            content.bounds = content.bounds.union(prim.bounds);
            content.count += 1;
        }
    }
    let area = bounds.surface_area();
    let mut best: Option<SplitPlane> = None;
    for bins in axes.into_iter().flatten() {
        let contents = &contents[bins.axis];
        // From the right: the contents above each plane.
        let mut above = [BinContents::NONE; BINS];
        let mut so_far = BinContents::NONE;
        for bin in (1..BINS).rev() {
            so_far = so_far.with(contents[bin]);
            above[bin] = so_far;
        }
        let mut below = BinContents::NONE;
        for bin in 1..BINS {
            below = below.with(contents[bin - 1]);
            if below.count == 0 || above[bin].count == 0 {
                continue;
            }
            let cost = (below.cost() + above[bin].cost()) / area;
            if cost.is_finite() && best.as_ref().is_none_or(|best| cost < best.cost) {
                best = Some(SplitPlane { bins, bin, cost });
            }
        }
    }
    best
}
// END SOLUTION(part6.task1)
