// BEGIN SOLUTION(part6.task2)
//! What eight rays hit: with a list of primitives in lanes, else ray by ray with the tree of the
//! fallback.

use crate::lane_mask::lanes;
use crate::primitive_list::PrimitiveList;
use crate::ray_packet::{HitPacket, RayPacket, prim_id};
use crate::{ScalarFallback, Workspace};
use fearless_simd::{Simd, f64x8};

/// The closest hits in the lanes of `active` with any primitive but `skip`.
#[inline(always)]
pub(crate) fn closest<S: Simd>(
    simd: S,
    list: Option<&PrimitiveList>,
    rays: &RayPacket<S>,
    active: u64,
    skip: f64x8<S>,
    workspace: &mut Workspace,
    fallback: &mut dyn ScalarFallback,
) -> HitPacket<S> {
    if let Some(list) = list {
        workspace.counts.prim_tests += u64::from(active.count_ones()) * list.len() as u64;
        return list.closest(simd, rays, active, skip, &mut workspace.scratch, fallback);
    }
    let mut hits = HitPacket::none(simd, rays.max_t);
    for lane in lanes(active) {
        if let Some((id, hit)) = fallback.closest(&rays.lane(lane), prim_id(skip[lane])) {
            hits.set(lane, id, hit);
        }
    }
    hits
}

/// The lanes in `active` whose ray hits any primitive but `skip`.
#[inline(always)]
pub(crate) fn occluded<S: Simd>(
    simd: S,
    list: Option<&PrimitiveList>,
    rays: &RayPacket<S>,
    active: u64,
    skip: f64x8<S>,
    workspace: &mut Workspace,
    fallback: &mut dyn ScalarFallback,
) -> u64 {
    if let Some(list) = list {
        let scratch = &mut workspace.scratch;
        let (blocked, tests) = list.occluded(simd, rays, active, skip, scratch, fallback);
        workspace.counts.prim_tests += tests;
        return blocked;
    }
    lanes(active)
        .filter(|&lane| fallback.occluded(&rays.lane(lane), prim_id(skip[lane])))
        .map(|lane| 1 << lane)
        .sum()
}
// END SOLUTION(part6.task2)
