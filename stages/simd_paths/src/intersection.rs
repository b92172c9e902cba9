//! What rays hit: eight of them with a list of primitives in lanes, or many together with the tree
//! of the fallback.

use crate::beam::RayBundle;
use crate::columns::Columns;
use crate::lane_mask::lanes;
use crate::primitive_list::{PrimitiveList, Scratch};
use crate::ray_packet::{HIT_COLUMNS, HitPacket, RayPacket, hit_columns, prim_id};
use crate::vec3x8::LANES;
use crate::{Counts, PathMemory, PathScene, ScalarFallback};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{PrimId, Ray, TriangleHit};

/// Where the hits of eight rays come from.
#[derive(Clone, Copy)]
pub(crate) enum HitSource<'a> {
    /// All primitives that the rays may hit.
    List(&'a PrimitiveList),
    /// The closest hits, found for many rays before: those from this number on.
    Found(&'a TracedRays, usize),
}

/// Rays that are traced together, and what they hit.
#[derive(Clone, Debug, Default)]
pub(crate) struct TracedRays {
    /// The closest hit of each ray, in a scene with large primitives that are apart. In any other
    /// scene there are no rows, and all rays need the tree.
    hits: Columns<HIT_COLUMNS>,
    /// The rays that need the tree, and their numbers among all.
    rays: Vec<(Ray, Option<PrimId>)>,
    numbers: Vec<usize>,
    /// What the tree finds for them.
    found: Vec<Option<(PrimId, TriangleHit)>>,
    occluded: Vec<bool>,
}

impl TracedRays {
    /// Finds the closest hits of `bundle`.
    #[inline(never)]
    pub(crate) fn trace<S: Simd>(
        &mut self,
        simd: S,
        scene: &PathScene<'_>,
        bundle: &RayBundle<'_>,
        scratch: &mut Scratch,
        counts: &mut Counts,
        fallback: &mut dyn ScalarFallback,
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                self.hits.clear();
                self.clear_rays();
                for first in (0..bundle.count).step_by(LANES) {
                    let (rays, skip) = bundle.packet(simd, first);
                    let active = bundle.active(first);
                    let Some(large) = &scene.large else {
                        self.collect(&rays, skip, active, first);
                        continue;
                    };
                    counts.prim_tests += u64::from(active.count_ones()) * large.list.len() as u64;
                    let hits = large
                        .list
                        .closest(simd, &rays, active, skip, scratch, fallback);
                    let rays = RayPacket {
                        max_t: hits.t,
                        ..rays
                    };
                    let active = active & large.may_hit_others(simd, &rays);
                    self.collect(&rays, skip, active, first);
                    let all = mask64x8::splat(simd, true);
                    self.hits.push(hits.columns(), all);
                }
                fallback.closest_each(&self.rays, &mut self.found);
                if self.hits.count() == 0 {
                    return;
                }
                for (&number, found) in self.numbers.iter().zip(&self.found) {
                    if let Some((id, hit)) = *found
                        && self.is_first(number, id, hit.t)
                    {
                        self.hits.set(number, hit_columns(id, hit));
                    }
                }
            },
        )
    }

    /// The closest hits of eight rays from number `first`, after [`TracedRays::trace`]. `max_t` are
    /// the ends of their ranges.
    #[inline(always)]
    fn hits<S: Simd>(&self, simd: S, first: usize, max_t: f64x8<S>) -> HitPacket<S> {
        if self.hits.count() > 0 {
            return HitPacket::of(self.hits.load(simd, first));
        }
        let mut hits = HitPacket::none(simd, max_t);
        let found = &self.found[first..self.found.len().min(first + LANES)];
        for (lane, found) in found.iter().enumerate() {
            if let Some((id, hit)) = *found {
                hits.set(lane, id, hit);
            }
        }
        hits
    }

    /// Calls `block` with the number of each of the rays in `bundle` that hits anything.
    #[inline(never)]
    #[expect(clippy::too_many_arguments, reason = "inlined where it is used")]
    pub(crate) fn occluded<S: Simd>(
        &mut self,
        simd: S,
        scene: &PathScene<'_>,
        bundle: &RayBundle<'_>,
        scratch: &mut Scratch,
        counts: &mut Counts,
        fallback: &mut dyn ScalarFallback,
        mut block: impl FnMut(usize),
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                self.clear_rays();
                for first in (0..bundle.count).step_by(LANES) {
                    let (rays, skip) = bundle.packet(simd, first);
                    let mut active = bundle.active(first);
                    if let Some(large) = &scene.large {
                        let (blocked, tests) = large
                            .list
                            .occluded(simd, &rays, active, skip, scratch, fallback);
                        counts.prim_tests += tests;
                        for lane in lanes(blocked) {
                            block(first + lane);
                        }
                        active &= !blocked & large.may_hit_others(simd, &rays);
                    }
                    self.collect(&rays, skip, active, first);
                }
                fallback.occluded_each(&self.rays, &mut self.occluded);
                for (&number, &occluded) in self.numbers.iter().zip(&self.occluded) {
                    if occluded {
                        block(number);
                    }
                }
            },
        )
    }

    /// Whether a hit with primitive `id` at `t`, at most that of the hit of ray `number` so far,
    /// comes before it: at equal `t` the lowest id does.
    fn is_first(&self, number: usize, id: PrimId, t: f64) -> bool {
        let [prim, nearest, ..] = self.hits.row(number);
        t < nearest || prim_id(prim).is_none_or(|known| id < known)
    }

    fn clear_rays(&mut self) {
        self.rays.clear();
        self.numbers.clear();
    }

    /// Adds the rays in the lanes of `active`; the number of the first lane is `first`.
    #[inline(always)]
    fn collect<S: Simd>(&mut self, rays: &RayPacket<S>, skip: f64x8<S>, active: u64, first: usize) {
        for lane in lanes(active) {
            self.rays.push((rays.lane(lane), prim_id(skip[lane])));
            self.numbers.push(first + lane);
        }
    }
}

/// The closest hits in the lanes of `active` with any primitive but `skip`, from `source`.
#[inline(always)]
pub(crate) fn closest<S: Simd>(
    simd: S,
    source: HitSource<'_>,
    rays: &RayPacket<S>,
    active: u64,
    skip: f64x8<S>,
    memory: &mut PathMemory,
    fallback: &dyn ScalarFallback,
) -> HitPacket<S> {
    match source {
        HitSource::List(list) => {
            memory.counts.prim_tests += u64::from(active.count_ones()) * list.len() as u64;
            list.closest(simd, rays, active, skip, &mut memory.scratch, fallback)
        }
        HitSource::Found(traced, first) => traced.hits(simd, first, rays.max_t),
    }
}
