//! The hits of many rays from one point, traced together: camera rays, for example.

// BEGIN SOLUTION(part6.task1)
use crate::tile::rays::TileRays;
use crate::tile::traversal;
use lanes::dispatch;
// END SOLUTION(part6.task1)

use crate::intersect::{ExactTest, TestCounts};
use crate::wide::{Subset, WideBvh};
use kit::{PrimId, Ray, TriangleHit, Vec3};

/// Rays from one point, in columns: ray number `i` has the direction `(d[0][i], d[1][i], d[2][i])`.
///
/// Rays that are close to each other are traced together, 64 at a time, in the order of the
/// columns: so eight by eight pixels should be next to each other.
#[derive(Clone, Copy, Debug)]
pub struct RayTile<'a> {
    /// The origin of all rays.
    pub o: Vec3,
    /// The directions by axis. The columns have the same length, which is the number of rays.
    pub d: [&'a [f64]; 3],
    /// The start of all ranges.
    pub min_t: f64,
    /// The ends of the ranges.
    pub max_t: TileEnds<'a>,
    /// For each ray the primitive that it cannot hit; empty if there are none.
    pub skips: &'a [Option<PrimId>],
}

/// The ends of the ranges of a [`RayTile`].
#[derive(Clone, Copy, Debug)]
pub enum TileEnds<'a> {
    /// That of every ray.
    All(f64),
    /// That of each ray.
    Each(&'a [f64]),
}

impl TileEnds<'_> {
    /// The end of the range of ray number `i`.
    #[inline(always)]
    fn of(&self, i: usize) -> f64 {
        match self {
            TileEnds::All(max_t) => *max_t,
            TileEnds::Each(ends) => ends[i],
        }
    }
}

impl<'a> RayTile<'a> {
    /// The number of rays.
    pub fn len(&self) -> usize {
        self.d[0].len()
    }

    /// Whether there is no ray.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Ray number `i`.
    #[inline(always)]
    pub fn ray(&self, i: usize) -> Ray {
        Ray {
            o: self.o,
            d: Vec3::new(self.d[0][i], self.d[1][i], self.d[2][i]),
            min_t: self.min_t,
            max_t: self.max_t.of(i),
        }
    }

    /// The primitive that ray number `i` cannot hit.
    #[inline(always)]
    pub fn skip(&self, i: usize) -> Option<PrimId> {
        self.skips.get(i).copied().flatten()
    }

    /// At most `count` rays from number `first` on.
    #[inline(always)]
    pub fn part(&self, first: usize, count: usize) -> RayTile<'a> {
        let last = (first + count).min(self.len());
        RayTile {
            d: self.d.map(|column| &column[first..last]),
            max_t: match self.max_t {
                TileEnds::Each(ends) => TileEnds::Each(&ends[first..last]),
                all => all,
            },
            skips: self.skips.get(first..last).unwrap_or(&[]),
            ..*self
        }
    }
}

/// The memory of [`WideBvh::closest_of_tile`], which a thread reuses from call to call.
#[derive(Clone, Debug, Default)]
pub struct TileMemory {
    // BEGIN SOLUTION(part6.task1)
    rays: Box<TileRays>,
    stack: Vec<traversal::Entry>,
    // STUB: // Add the fields that you need.
    // END SOLUTION(part6.task1)
}

impl WideBvh {
    /// Replaces the contents of `hits` by the closest hit of each of `rays`, in their order: those
    /// of [`WideBvh::closest`], bit for bit, with the restriction of [`WideBvh::closest_each`] if
    /// `subset` is not all.
    ///
    /// Rays that do not belong together, because their directions are far from each other or of
    /// extreme size, are traced one by one. Adds to `counts`; a node or a block that 64 rays test
    /// together counts once.
    pub fn closest_of_tile(
        &self,
        subset: Subset,
        rays: &RayTile,
        exact: &mut ExactTest,
        memory: &mut TileMemory,
        counts: &mut TestCounts,
        hits: &mut Vec<Option<(PrimId, TriangleHit)>>,
    ) {
        // BEGIN SOLUTION(part6.task1)
        hits.clear();
        for first in (0..rays.len()).step_by(crate::tile::SIZE) {
            let rays = &rays.part(first, crate::tile::SIZE);
            let TileMemory {
                rays: columns,
                stack,
            } = memory;
            dispatch!(self.level, simd => {
                traversal::trace(simd, self, subset, rays, columns, stack, exact, counts, hits);
            });
        }
        // STUB: kit::hole!("part6.task1", self, subset, rays, exact, memory, counts, hits)
        // END SOLUTION(part6.task1)
    }
}
