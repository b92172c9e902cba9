// BEGIN SOLUTION(part6.task2)
//! Eight rays, and where they hit.

use crate::vec3x8::Vec3x8;
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{PrimId, Ray, TriangleHit};

/// Eight rays, as [`Ray`] has one.
#[derive(Clone, Copy)]
pub(crate) struct Rays<S: Simd> {
    pub(crate) o: Vec3x8<S>,
    pub(crate) d: Vec3x8<S>,
    pub(crate) min_t: f64x8<S>,
    pub(crate) max_t: f64x8<S>,
}

impl<S: Simd> Rays<S> {
    /// The ray in a lane.
    #[inline(always)]
    pub(crate) fn lane(&self, lane: usize) -> Ray {
        Ray {
            o: self.o.lane(lane),
            d: self.d.lane(lane),
            min_t: self.min_t[lane],
            max_t: self.max_t[lane],
        }
    }

    /// The lanes whose `t` is in the ray's range, cut at `max_t`.
    #[inline(always)]
    pub(crate) fn in_range(&self, t: f64x8<S>, max_t: f64x8<S>) -> mask64x8<S> {
        self.min_t.simd_le(t) & t.simd_le(max_t)
    }
}

/// Where eight rays hit.
#[derive(Clone, Copy)]
pub(crate) struct Hits<S: Simd> {
    /// The primitive's number; [`NONE`] where nothing is hit.
    pub(crate) prim: f64x8<S>,
    /// Where on the ray; the end of its range where nothing is hit.
    pub(crate) t: f64x8<S>,
    /// The weights of a triangle's second and third vertex, times `det`: to divide is dear, and most hits are of no use
    /// once a closer one is found.
    pub(crate) v: f64x8<S>,
    pub(crate) w: f64x8<S>,
    pub(crate) det: f64x8<S>,
}

/// The number of no primitive.
pub(crate) const NONE: f64 = -1.0;

impl<S: Simd> Hits<S> {
    /// No hits of rays that end at `max_t`.
    #[inline(always)]
    pub(crate) fn none(simd: S, max_t: f64x8<S>) -> Hits<S> {
        Hits {
            prim: f64x8::splat(simd, NONE),
            t: max_t,
            v: f64x8::splat(simd, 0.0),
            w: f64x8::splat(simd, 0.0),
            det: f64x8::splat(simd, 1.0),
        }
    }

    /// The lanes without a hit.
    #[inline(always)]
    pub(crate) fn is_none(&self) -> mask64x8<S> {
        self.prim.simd_lt(f64x8::splat(self.prim.simd, 0.0))
    }

    /// The hit of one lane, found elsewhere.
    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, id: PrimId, hit: TriangleHit) {
        self.prim[lane] = f64::from(id.0);
        self.t[lane] = hit.t;
        self.v[lane] = hit.b1;
        self.w[lane] = hit.b2;
        self.det[lane] = 1.0;
    }

    /// The hit in a lane that has one, whose weights are in `weights`.
    pub(crate) fn lane(&self, lane: usize, weights: &[f64x8<S>; 2]) -> TriangleHit {
        TriangleHit {
            t: self.t[lane],
            b1: weights[0][lane],
            b2: weights[1][lane],
        }
    }

    /// The weights of the second and the third vertex; a sphere's are 0.
    #[inline(always)]
    pub(crate) fn weights(&self) -> [f64x8<S>; 2] {
        [self.v / self.det, self.w / self.det]
    }
}

/// The primitive of that number, if it is one.
#[inline(always)]
pub(crate) fn prim(number: f64) -> Option<PrimId> {
    (number >= 0.0).then_some(PrimId(number as u32))
}
// END SOLUTION(part6.task2)
