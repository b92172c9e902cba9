//! Splits by the surface area heuristic, the split with the least expected traversal cost: a random
//! ray hits a box with a probability proportional to its surface area, and then tests its contents.
//! The candidates are the borders of 16 bins on each axis.
//!
//! J. Goldsmith, J. Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", IEEE
//! Computer Graphics and Applications 7(5), 1987; in bins: I. Wald, "On Fast Construction of
//! SAH-based Bounding Volume Hierarchies", IEEE Symposium on Interactive Ray Tracing, 2007.

use super::primitive::{BuildPrimitive, centroid_bounds, partition};
use kit::Aabb;

const BINS: usize = 16;

/// Count and bounds of the primitives in one or more bins.
#[derive(Clone, Copy)]
struct Bin {
    bounds: Aabb,
    count: usize,
}

impl Bin {
    const EMPTY: Bin = Bin {
        bounds: Aabb::EMPTY,
        count: 0,
    };

    fn merged(self, other: &Bin) -> Bin {
        Bin {
            bounds: self.bounds.union(other.bounds),
            count: self.count + other.count,
        }
    }

    /// Returns the expected cost for a ray that hits the parent, up to a constant factor.
    fn cost(&self) -> f64 {
        self.bounds.surface_area() * self.count as f64
    }
}

pub(super) fn split(primitives: &mut [BuildPrimitive]) -> usize {
    let centroids = centroid_bounds(primitives);
    let bin_of = |axis: usize, primitive: &BuildPrimitive| {
        let (from, to) = (centroids.min[axis], centroids.max[axis]);
        let share = (primitive.centroid[axis] - from) / (to - from);
        ((share * BINS as f64) as usize).min(BINS - 1)
    };
    let mut best = (f64::INFINITY, 0, 0);
    for axis in 0..3 {
        let mut bins = [Bin::EMPTY; BINS];
        for primitive in primitives.iter() {
            let bin = &mut bins[bin_of(axis, primitive)];
            bin.bounds = bin.bounds.union(primitive.bounds);
            bin.count += 1;
        }
        // The union of the bins to the right of each border, from the last one back.
        let mut right = [Bin::EMPTY; BINS];
        for border in (1..BINS).rev() {
            let beyond = right.get(border + 1).copied().unwrap_or(Bin::EMPTY);
            right[border] = beyond.merged(&bins[border]);
        }
        let mut left = Bin::EMPTY;
        for border in 1..BINS {
            left = left.merged(&bins[border - 1]);
            let cost = left.cost() + right[border].cost();
            if left.count > 0 && right[border].count > 0 && cost < best.0 {
                best = (cost, axis, border);
            }
        }
    }
    let (_, axis, border) = best;
    partition(primitives, |primitive| bin_of(axis, primitive) < border)
}
