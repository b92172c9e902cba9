//! The surface area heuristic: where to split a set of primitives.

use crate::layout::LANES;
use crate::layout::packed_box::PackedBox;
use fearless_simd::{Level, Simd, f32x4, f32x8, i32x4, prelude::*};
use kit::Aabb;
use lanes::dispatch;
use rayon::prelude::*;

/// Bins along an axis, with a candidate plane between neighbours. Twice as many save 0.5 % of the
/// tests.
const BINS: usize = 16;

/// From this many primitives on, their parts are put into bins in parallel.
const MIN_PARALLEL: usize = 1 << 15;

/// A primitive during the build: its box, and in the free lanes its number and its excess.
#[derive(Clone, Copy)]
pub(crate) struct BuildPrimitive(PackedBox);

/// The lane with the bits of the number.
const ID: usize = 3;

/// The lane with the excess.
const EXCESS: usize = 7;

impl BuildPrimitive {
    /// Primitive number `id`, with a box around `bounds`. `excess` is above 0 if dividing it is
    /// worthwhile.
    #[inline(always)]
    pub(crate) fn new(id: u32, bounds: Aabb, excess: f32) -> BuildPrimitive {
        let mut packed = PackedBox::around(bounds);
        packed.0[ID] = f32::from_bits(id);
        packed.0[EXCESS] = excess;
        BuildPrimitive(packed)
    }

    /// Stands for a primitive without a box.
    pub(crate) const NONE: BuildPrimitive = BuildPrimitive(PackedBox::EMPTY);

    pub(crate) fn is_none(&self) -> bool {
        self.0.max(0) < self.0.min(0)
    }

    #[inline(always)]
    pub(crate) fn id(&self) -> u32 {
        self.0.0[ID].to_bits()
    }

    #[inline(always)]
    pub(crate) fn excess(&self) -> f32 {
        self.0.0[EXCESS]
    }

    pub(crate) fn bounds(&self) -> PackedBox {
        self.0
    }

    /// Enlarges the box to contain that of `other`.
    pub(crate) fn enclose(&mut self, other: &BuildPrimitive) {
        let id = self.0.0[ID];
        self.0 = self.0.union(other.0);
        self.0.0[ID] = id;
    }

    /// Twice the centre of the box on an axis.
    #[inline(always)]
    fn centroid(&self, axis: usize) -> f32 {
        self.0.max(axis) - self.0.0[axis]
    }
}

/// The box of primitives and of their centroids, times two.
#[derive(Clone, Copy)]
pub(crate) struct Enclosure {
    pub(crate) bounds: PackedBox,
    /// The least and the largest centroid; the fourth number has no meaning.
    centroids: [[f32; 4]; 2],
}

impl Enclosure {
    /// The boxes of `prims`; both are empty if there are none.
    pub(crate) fn of(prims: &[BuildPrimitive], level: Level) -> Enclosure {
        if prims.len() < MIN_PARALLEL {
            return dispatch!(level, simd => enclosure(simd, prims));
        }
        let parts = prims.par_chunks(MIN_PARALLEL / 2);
        parts
            .map(|part| dispatch!(level, simd => enclosure(simd, part)))
            .reduce_with(Enclosure::with)
            .expect("at least one part")
    }

    fn with(self, other: Enclosure) -> Enclosure {
        let pick = |side: usize, choice: fn(f32, f32) -> f32| {
            let (a, b) = (self.centroids[side], other.centroids[side]);
            std::array::from_fn(|axis| choice(a[axis], b[axis]))
        };
        Enclosure {
            bounds: self.bounds.union(other.bounds),
            centroids: [pick(0, f32::min), pick(1, f32::max)],
        }
    }
}

#[inline(always)]
fn enclosure<S: Simd>(simd: S, prims: &[BuildPrimitive]) -> Enclosure {
    let mut bounds = PackedBox::EMPTY.load(simd);
    let mut least = f32x4::splat(simd, f32::INFINITY);
    let mut most = f32x4::splat(simd, f32::NEG_INFINITY);
    for prim in prims {
        let prim = prim.0.load(simd);
        let (low, high) = prim.split();
        let centroid = high - low;
        bounds = bounds.max(prim);
        least = least.min(centroid);
        most = most.max(centroid);
    }
    Enclosure {
        bounds: PackedBox(bounds.to_array()),
        centroids: [least.to_array(), most.to_array()],
    }
}

/// How centroids are assigned to bins: bin `(centroid - start)·scale`, rounded down, on each axis.
#[derive(Clone, Copy)]
struct Grid {
    start: [f32; 4],
    /// Bins per unit of length; 0 on an axis on which the centroids are equal.
    scale: [f32; 4],
}

impl Grid {
    fn over([least, most]: [[f32; 4]; 2]) -> Grid {
        let mut grid = Grid {
            start: [0.0; 4],
            scale: [0.0; 4],
        };
        for axis in 0..3 {
            let scale = BINS as f32 / (most[axis] - least[axis]);
            if scale.is_finite() && scale > 0.0 {
                grid.start[axis] = least[axis];
                grid.scale[axis] = scale;
            }
        }
        grid
    }
}

/// A splitting plane: primitives in bins below `bin` on `axis` go left.
pub(crate) struct SplitPlane {
    axis: usize,
    start: f32,
    scale: f32,
    bin: f32,
}

impl SplitPlane {
    /// Whether a primitive goes left. The operations are those that found its bin, and a number is
    /// below a bin's exactly if it is when rounded down.
    #[inline(always)]
    pub(crate) fn is_below(&self, prim: &BuildPrimitive) -> bool {
        (prim.centroid(self.axis) - self.start) * self.scale < self.bin
    }
}

/// The boxes and the numbers of the primitives in each bin of each axis.
struct Bins {
    boxes: [[PackedBox; BINS]; 3],
    counts: [[u32; BINS]; 3],
}

impl Bins {
    fn with(mut self, other: Bins) -> Bins {
        for axis in 0..3 {
            for bin in 0..BINS {
                let content = &mut self.boxes[axis][bin];
                *content = content.union(other.boxes[axis][bin]);
                self.counts[axis][bin] += other.counts[axis][bin];
            }
        }
        self
    }
}

#[inline(always)]
fn fill<S: Simd>(simd: S, prims: &[BuildPrimitive], grid: &Grid) -> Bins {
    let mut bins = Bins {
        boxes: [[PackedBox::EMPTY; BINS]; 3],
        counts: [[0; BINS]; 3],
    };
    let start = f32x4::load_array_ref(simd, &grid.start);
    let scale = f32x4::load_array_ref(simd, &grid.scale);
    let last = f32x4::splat(simd, (BINS - 1) as f32);
    for prim in prims {
        let prim = prim.0.load(simd);
        let (low, high) = prim.split();
        let place = ((high - low - start) * scale).min(last);
        let place = i32x4::truncate_from(place).to_array();
        for (axis, bin) in place[..3].iter().enumerate() {
            let bin = *bin as usize & (BINS - 1);
            let content = &mut bins.boxes[axis][bin];
            content.0 = content.load(simd).max(prim).to_array();
            bins.counts[axis][bin] += 1;
        }
    }
    bins
}

/// Half the surface times the number of leaf tests.
#[inline(always)]
fn cost<S: Simd>(bounds: f32x8<S>, count: u32) -> f32 {
    let (low, high) = bounds.split();
    let edges = (high + low).to_array();
    let area = edges[0] * edges[1] + edges[1] * edges[2] + edges[2] * edges[0];
    area * count.div_ceil(LANES as u32) as f32
}

/// The axis and the bin of the plane of least cost; `None` if all have the same bin.
#[inline(always)]
fn cheapest<S: Simd>(simd: S, bins: &Bins) -> Option<(usize, usize)> {
    let (mut least, mut best) = (f32::INFINITY, None);
    for axis in 0..3 {
        let (boxes, counts) = (&bins.boxes[axis], &bins.counts[axis]);
        // From the right: the cost of what is above each plane; infinite if that is nothing.
        let mut above = [f32::INFINITY; BINS];
        let (mut bounds, mut count) = (PackedBox::EMPTY.load(simd), 0);
        for bin in (1..BINS).rev() {
            bounds = bounds.max(boxes[bin].load(simd));
            count += counts[bin];
            if count > 0 {
                above[bin] = cost(bounds, count);
            }
        }
        let (mut bounds, mut count) = (PackedBox::EMPTY.load(simd), 0);
        for bin in 1..BINS {
            bounds = bounds.max(boxes[bin - 1].load(simd));
            count += counts[bin - 1];
            if count == 0 {
                continue;
            }
            let cost = cost(bounds, count) + above[bin];
            if cost < least {
                (least, best) = (cost, Some((axis, bin)));
            }
        }
    }
    best
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
///
/// The result does not depend on the number of threads: neither the largest number nor a sum of
/// integers depends on the order.
pub(crate) fn cheapest_plane(
    prims: &[BuildPrimitive],
    enclosure: &Enclosure,
    level: Level,
) -> Option<SplitPlane> {
    // Infinite boxes have no centroids.
    if !enclosure.bounds.is_finite() {
        return None;
    }
    let grid = Grid::over(enclosure.centroids);
    let (axis, bin) = if prims.len() < MIN_PARALLEL {
        dispatch!(level, simd => {
            let bins = fill(simd, prims, &grid);
            cheapest(simd, &bins)
        })
    } else {
        let parts = prims.par_chunks(MIN_PARALLEL / 2);
        let bins = parts
            .map(|part| dispatch!(level, simd => fill(simd, part, &grid)))
            .reduce_with(Bins::with)?;
        dispatch!(level, simd => cheapest(simd, &bins))
    }?;
    Some(SplitPlane {
        axis,
        start: grid.start[axis],
        scale: grid.scale[axis],
        bin: bin as f32,
    })
}
