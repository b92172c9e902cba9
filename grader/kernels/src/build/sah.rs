// BEGIN SOLUTION(part2.task1)
//! The split that should cost least to walk: a random ray meets a box as often as its surface is large, and then tests
//! what is in it. Tried at the borders of 16 bins on each axis.
//!
//! J. Goldsmith, J. Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", IEEE Computer Graphics and
//! Applications 7(5), 1987; in bins: I. Wald, "On Fast Construction of SAH-based Bounding Volume Hierarchies", IEEE
//! Symposium on Interactive Ray Tracing, 2007.

use super::{Item, around_centroids, partition};
use kit::Aabb;

const BINS: usize = 16;

/// What falls into one bin, or several.
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

    fn with(self, other: &Bin) -> Bin {
        Bin {
            bounds: self.bounds.union(other.bounds),
            count: self.count + other.count,
        }
    }

    /// What a ray that meets the parent is expected to pay here, up to a factor.
    fn cost(&self) -> f64 {
        self.bounds.surface_area() * self.count as f64
    }
}

pub(super) fn split(items: &mut [Item]) -> usize {
    let centroids = around_centroids(items);
    let bin_of = |axis: usize, item: &Item| {
        let (from, to) = (centroids.min[axis], centroids.max[axis]);
        let share = (item.centroid[axis] - from) / (to - from);
        ((share * BINS as f64) as usize).min(BINS - 1)
    };
    let mut best = (f64::INFINITY, 0, 0);
    for axis in 0..3 {
        let mut bins = [Bin::EMPTY; BINS];
        for item in items.iter() {
            let bin = &mut bins[bin_of(axis, item)];
            bin.bounds = bin.bounds.union(item.bounds);
            bin.count += 1;
        }
        // What lies to the right of each border, from the last one back.
        let mut right = [Bin::EMPTY; BINS];
        for border in (1..BINS).rev() {
            let beyond = right.get(border + 1).copied().unwrap_or(Bin::EMPTY);
            right[border] = beyond.with(&bins[border]);
        }
        let mut left = Bin::EMPTY;
        for border in 1..BINS {
            left = left.with(&bins[border - 1]);
            let cost = left.cost() + right[border].cost();
            if left.count > 0 && right[border].count > 0 && cost < best.0 {
                best = (cost, axis, border);
            }
        }
    }
    let (_, axis, border) = best;
    partition(items, |item| bin_of(axis, item) < border)
}
// END SOLUTION(part2.task1)
