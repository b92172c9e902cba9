// BEGIN SOLUTION(part6.task2)
//! What rays hit: eight of them with a list of primitives in lanes, or many together with the tree
//! of the fallback.

use crate::beam::{RangeEnds, RayBundle};
use crate::primitive_list::PrimitiveList;
use crate::ray_packet::{HitPacket, RayPacket, prim_id};
use crate::{ScalarFallback, Workspace};
use fearless_simd::{Simd, f64x8};
use kit::{PrimId, Ray, TriangleHit, Vec3};

/// Where the hits of eight rays come from.
#[derive(Clone, Copy)]
pub(crate) enum HitSource<'a> {
    /// All primitives that the rays may hit.
    List(&'a PrimitiveList),
    /// The closest hits, which the fallback has found: one element per lane, from the first on.
    Found(&'a [Option<(PrimId, TriangleHit)>]),
}

/// Rays that the fallback traces together, and what they hit.
#[derive(Clone, Debug, Default)]
pub(crate) struct TracedRays {
    rays: Vec<(Ray, Option<PrimId>)>,
    hits: Vec<Option<(PrimId, TriangleHit)>>,
    occluded: Vec<bool>,
}

impl TracedRays {
    /// Finds the closest hits of `rays`.
    pub(crate) fn trace(&mut self, rays: &RayBundle<'_>, fallback: &mut dyn ScalarFallback) {
        self.collect(rays);
        fallback.closest_each(&self.rays, &mut self.hits);
    }

    /// The closest hits of the rays from number `first`, at most `most`, after
    /// [`TracedRays::trace`].
    #[inline(always)]
    pub(crate) fn hits(&self, first: usize, most: usize) -> HitSource<'_> {
        HitSource::Found(&self.hits[first..self.hits.len().min(first + most)])
    }

    /// Whether each of `rays` hits anything.
    pub(crate) fn occluded(
        &mut self,
        rays: &RayBundle<'_>,
        fallback: &mut dyn ScalarFallback,
    ) -> &[bool] {
        self.collect(rays);
        fallback.occluded_each(&self.rays, &mut self.occluded);
        &self.occluded
    }

    fn collect(&mut self, rays: &RayBundle<'_>) {
        let (o, d) = (&rays.o, &rays.d);
        self.rays.clear();
        self.rays.extend((0..rays.count).map(|i| {
            let ray = Ray {
                o: Vec3::new(o[0][i], o[1][i], o[2][i]),
                d: Vec3::new(d[0][i], d[1][i], d[2][i]),
                min_t: rays.min_t,
                max_t: match rays.max_t {
                    RangeEnds::All(max_t) => max_t,
                    RangeEnds::Each(ends) => ends[i],
                },
            };
            (ray, prim_id(rays.skip[i]))
        }));
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
    workspace: &mut Workspace,
    fallback: &dyn ScalarFallback,
) -> HitPacket<S> {
    match source {
        HitSource::List(list) => {
            workspace.counts.prim_tests += u64::from(active.count_ones()) * list.len() as u64;
            list.closest(simd, rays, active, skip, &mut workspace.scratch, fallback)
        }
        HitSource::Found(found) => {
            let mut hits = HitPacket::none(simd, rays.max_t);
            for (lane, hit) in found.iter().enumerate() {
                if let Some((id, hit)) = *hit {
                    hits.set(lane, id, hit);
                }
            }
            hits
        }
    }
}
// END SOLUTION(part6.task2)
