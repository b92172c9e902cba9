//! Intersection of eight rays with a list of primitives: faster than a tree if there are few.

mod nearby;
mod sphere;
#[cfg(test)]
mod tests;
mod triangle;

use crate::ScalarFallback;
use crate::lane_mask::lanes;
use crate::ray_packet::{HitPacket, RayPacket};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{PrimId, Primitive, Ray, Scene, Sphere, Vec3};
use std::ops::Range;
use triangle::{AxisPermutedRays, ProjectedVertex};

pub(crate) use nearby::NearbyPrimitives;

/// Primitives of a scene, with ascending numbers. Triangles share their vertices, so each vertex is
/// projected once.
#[derive(Clone, Debug, Default)]
pub(crate) struct PrimitiveList {
    vertices: Vec<Vec3>,
    triangles: Vec<ListedTriangle>,
    /// Their numbers in the scene, and the spheres.
    spheres: Vec<(u32, Sphere)>,
}

#[derive(Clone, Copy, Debug)]
struct ListedTriangle {
    /// The number in the scene.
    id: u32,
    vertices: [u32; 3],
}

/// The limits of a list. A whole scene of this size has no nodes in `simd_bvh` either, but the tree
/// traces one ray at a time: a Cornell box with two spheres takes 1.9 times as long with it (user
/// time of `pathtracer -s 16 -l 1 -m 5`, median of seven pairs).
const MAX_TRIANGLES: usize = 16;
const MAX_SPHERES: usize = 8;

/// Memory that a thread reuses: the projected vertices.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scratch(Vec<ProjectedVertex>);

/// The result of testing eight rays against one primitive.
struct PacketTest<S: Simd> {
    /// The lanes with a certain hit, at `t`.
    hit: mask64x8<S>,
    /// The lanes, one bit each, that need the scalar kernel: rounding errors may be too large.
    undecided: u64,
    t: f64x8<S>,
    /// The barycentric weights of the second and third vertex, times `det`.
    v: f64x8<S>,
    w: f64x8<S>,
    det: f64x8<S>,
}

impl PrimitiveList {
    /// The primitives of `scene` that `is_listed` accepts; `None` if they are too many.
    pub(crate) fn of(scene: &Scene, is_listed: impl Fn(PrimId) -> bool) -> Option<PrimitiveList> {
        let count = scene.triangles.len() as u32;
        let listed = |ids: Range<u32>, most: usize| {
            let ids = ids.map(PrimId).filter(|&id| is_listed(id));
            let ids: Vec<PrimId> = ids.take(most + 1).collect();
            (ids.len() <= most).then_some(ids)
        };
        let triangles = listed(0..count, MAX_TRIANGLES)?;
        let spheres = listed(count..scene.len() as u32, MAX_SPHERES)?;
        Some(PrimitiveList::with(scene, &[triangles, spheres].concat()))
    }

    /// Primitives number `ids` of `scene`, in ascending order.
    pub(crate) fn with(scene: &Scene, ids: &[PrimId]) -> PrimitiveList {
        let mut list = PrimitiveList::default();
        for &id in ids {
            match scene.primitive(id) {
                Primitive::Triangle(t) => {
                    let vertices = [t.p0, t.p1, t.p2].map(|p| list.number(p));
                    list.triangles.push(ListedTriangle { id: id.0, vertices });
                }
                Primitive::Sphere(sphere) => list.spheres.push((id.0, *sphere)),
            }
        }
        list
    }

    /// The number of the vertex `p`, which is added if it is new.
    fn number(&mut self, p: Vec3) -> u32 {
        let bits = |v: Vec3| v.to_array().map(f64::to_bits);
        let known = self.vertices.iter().position(|&v| bits(v) == bits(p));
        known.unwrap_or_else(|| {
            self.vertices.push(p);
            self.vertices.len() - 1
        }) as u32
    }

    /// Removes all primitives.
    fn clear(&mut self) {
        self.vertices.clear();
        self.triangles.clear();
        self.spheres.clear();
    }

    /// Puts the primitives in ascending order.
    fn sort(&mut self) {
        self.triangles.sort_unstable_by_key(|triangle| triangle.id);
        self.spheres.sort_unstable_by_key(|&(id, _)| id);
    }

    /// The number of primitives.
    pub(crate) fn len(&self) -> usize {
        self.triangles.len() + self.spheres.len()
    }

    /// The numbers in the scene of all primitives.
    pub(crate) fn ids(&self) -> impl Iterator<Item = u32> {
        let triangles = self.triangles.iter().map(|triangle| triangle.id);
        triangles.chain(self.spheres.iter().map(|&(id, _)| id))
    }

    /// The closest hits in the lanes of `active` with any primitive but `skip`; at equal `t` the
    /// one with the lowest number.
    #[inline(never)]
    pub(crate) fn closest<S: Simd>(
        &self,
        simd: S,
        rays: &RayPacket<S>,
        active: u64,
        skip: f64x8<S>,
        scratch: &mut Scratch,
        fallback: &dyn ScalarFallback,
    ) -> HitPacket<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let mut hits = HitPacket::none(simd, rays.max_t);
                if self.len() == 0 {
                    return hits;
                }
                let permuted = AxisPermutedRays::new(rays);
                permuted.project(simd, &self.vertices, &mut scratch.0);
                for &ListedTriangle { id, vertices } in &self.triangles {
                    let active = active & may_hit(id, skip);
                    let vertices = vertices.map(|i| &scratch.0[i as usize]);
                    if let Some(test) = permuted.test(simd, vertices, rays, hits.t, active) {
                        hits.keep_closer(id, &test, rays, fallback);
                    }
                }
                for (id, sphere) in &self.spheres {
                    let active = active & may_hit(*id, skip);
                    if let Some(test) = sphere::test(simd, sphere, rays, hits.t, active) {
                        hits.keep_closer(*id, &test, rays, fallback);
                    }
                }
                hits
            },
        )
    }

    /// The lanes of `active`, one bit each, that hit any primitive but `skip`; and the number of
    /// tests.
    #[inline(never)]
    pub(crate) fn occluded<S: Simd>(
        &self,
        simd: S,
        rays: &RayPacket<S>,
        active: u64,
        skip: f64x8<S>,
        scratch: &mut Scratch,
        fallback: &dyn ScalarFallback,
    ) -> (u64, u64) {
        simd.vectorize(
            #[inline(always)]
            || {
                if self.len() == 0 {
                    return (0, 0);
                }
                let permuted = AxisPermutedRays::new(rays);
                permuted.project(simd, &self.vertices, &mut scratch.0);
                let (mut open, mut tests) = (active, 0);
                for &ListedTriangle { id, vertices } in &self.triangles {
                    if open == 0 {
                        break;
                    }
                    tests += u64::from(open.count_ones());
                    let active = open & may_hit(id, skip);
                    let vertices = vertices.map(|i| &scratch.0[i as usize]);
                    if let Some(test) = permuted.test(simd, vertices, rays, rays.max_t, active) {
                        open &= !test.blocked(id, rays, fallback);
                    }
                }
                for (id, sphere) in &self.spheres {
                    if open == 0 {
                        break;
                    }
                    tests += u64::from(open.count_ones());
                    let active = open & may_hit(*id, skip);
                    if let Some(test) = sphere::test(simd, sphere, rays, rays.max_t, active) {
                        open &= !test.blocked(*id, rays, fallback);
                    }
                }
                (active & !open, tests)
            },
        )
    }
}

/// The lanes, one bit each, whose rays do not skip primitive number `id`.
#[inline(always)]
fn may_hit<S: Simd>(id: u32, skip: f64x8<S>) -> u64 {
    let number = f64x8::splat(skip.simd, f64::from(id));
    skip.simd_ne(number).to_bitmask()
}

impl<S: Simd> PacketTest<S> {
    /// The lanes, one bit each, in which primitive number `id`, which was tested, blocks the ray.
    #[inline(always)]
    fn blocked(&self, id: u32, rays: &RayPacket<S>, fallback: &dyn ScalarFallback) -> u64 {
        let mut blocked = self.hit.to_bitmask();
        for lane in lanes(self.undecided) {
            let is_hit = fallback.test(PrimId(id), &rays.lane(lane)).is_some();
            blocked |= u64::from(is_hit) << lane;
        }
        blocked
    }
}

impl<S: Simd> HitPacket<S> {
    /// Replaces hits by closer ones with primitive number `id`, which was tested for hits up to
    /// these. Numbers ascend, so at equal `t` the lowest stays.
    #[inline(always)]
    fn keep_closer(
        &mut self,
        id: u32,
        test: &PacketTest<S>,
        rays: &RayPacket<S>,
        fallback: &dyn ScalarFallback,
    ) {
        let number = f64x8::splat(self.t.simd, f64::from(id));
        let closer = test.hit & (test.t.simd_lt(self.t) | self.is_none());
        self.prim = closer.select(number, self.prim);
        self.t = closer.select(test.t, self.t);
        self.v = closer.select(test.v, self.v);
        self.w = closer.select(test.w, self.w);
        self.det = closer.select(test.det, self.det);
        for lane in lanes(test.undecided) {
            let ray = Ray {
                max_t: self.t[lane],
                ..rays.lane(lane)
            };
            if let Some(hit) = fallback.test(PrimId(id), &ray)
                && (hit.t < self.t[lane] || self.prim[lane] < 0.0)
            {
                self.set(lane, PrimId(id), hit);
            }
        }
    }
}
