//! Eight rays and their hits.

use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{PrimId, TriangleHit};

/// Eight rays.
pub(crate) type RayPacket<S> = lanes::Ray<f64x8<S>>;

/// The hits of eight rays.
#[derive(Clone, Copy)]
pub(crate) struct HitPacket<S: Simd> {
    /// The number of the primitive; [`NONE`] for a miss.
    pub(crate) prim: f64x8<S>,
    /// The hit's `t`; for a miss the end of the range.
    pub(crate) t: f64x8<S>,
    /// The barycentric weights of the second and third vertex, times `det`. The division waits
    /// until the closest hit is known.
    pub(crate) v: f64x8<S>,
    pub(crate) w: f64x8<S>,
    pub(crate) det: f64x8<S>,
}

/// The number of fields of a [`HitPacket`].
pub(crate) const HIT_COLUMNS: usize = 5;

/// One lane of [`HitPacket::columns`]: a hit with primitive `id` that the fallback found.
#[inline(always)]
pub(crate) fn hit_columns(id: PrimId, hit: TriangleHit) -> [f64; HIT_COLUMNS] {
    [f64::from(id.0), hit.t, hit.b1, hit.b2, 1.0]
}

/// The number that stands for no primitive.
pub(crate) const NONE: f64 = -1.0;

impl<S: Simd> HitPacket<S> {
    /// Misses, for rays that end at `max_t`.
    #[inline(always)]
    pub(crate) fn none(simd: S, max_t: f64x8<S>) -> HitPacket<S> {
        HitPacket {
            prim: f64x8::splat(simd, NONE),
            t: max_t,
            v: f64x8::splat(simd, 0.0),
            w: f64x8::splat(simd, 0.0),
            det: f64x8::splat(simd, 1.0),
        }
    }

    /// The lanes that miss.
    #[inline(always)]
    pub(crate) fn is_none(&self) -> mask64x8<S> {
        self.prim.simd_lt(f64x8::splat(self.prim.simd, 0.0))
    }

    /// Sets the hit of one lane, found by the fallback.
    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, id: PrimId, hit: TriangleHit) {
        let fields = [
            &mut self.prim,
            &mut self.t,
            &mut self.v,
            &mut self.w,
            &mut self.det,
        ];
        for (field, number) in fields.into_iter().zip(hit_columns(id, hit)) {
            field[lane] = number;
        }
    }

    /// All fields.
    #[inline(always)]
    pub(crate) fn columns(&self) -> [f64x8<S>; HIT_COLUMNS] {
        [self.prim, self.t, self.v, self.w, self.det]
    }

    /// The hits with these [`HitPacket::columns`].
    #[inline(always)]
    pub(crate) fn of([prim, t, v, w, det]: [f64x8<S>; HIT_COLUMNS]) -> HitPacket<S> {
        HitPacket { prim, t, v, w, det }
    }

    /// The hit in a lane that does not miss, with its weights from `weights`.
    pub(crate) fn lane(&self, lane: usize, weights: &[f64x8<S>; 2]) -> TriangleHit {
        TriangleHit {
            t: self.t[lane],
            b1: weights[0][lane],
            b2: weights[1][lane],
        }
    }

    /// The barycentric weights of the second and third vertex; 0 for spheres.
    #[inline(always)]
    pub(crate) fn weights(&self) -> [f64x8<S>; 2] {
        [self.v / self.det, self.w / self.det]
    }
}

/// The primitive with this number; `None` for [`NONE`].
#[inline(always)]
pub(crate) fn prim_id(number: f64) -> Option<PrimId> {
    (number >= 0.0).then_some(PrimId(number as u32))
}
