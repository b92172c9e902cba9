//! Eight points on surfaces, as shading needs them.

use crate::lane_mask::lanes;
use crate::ray_packet::{HitPacket, NONE, RayPacket};
use crate::vec3x8::{LANES, Vec3x8};
use crate::{PathScene, ScalarFallback};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::{Hit, PrimId, Triangle, Vec2};
use lanes::record;
use lanes::surface::Departure;

/// Eight points on surfaces.
pub(crate) struct SurfacePacket<S: Simd> {
    /// The numbers of the primitives.
    pub(crate) prim: f64x8<S>,
    /// The points, and where rays leave them.
    pub(crate) departure: Departure<f64x8<S>>,
    /// Shading normals, on the viewer's side.
    pub(crate) n: Vec3x8<S>,
    /// Geometric normals of the hits.
    pub(crate) hit_ng: Vec3x8<S>,
    pub(crate) uv: [f64x8<S>; 2],
    /// The reflectance if diffuse, the radiance if it emits.
    pub(crate) color: Vec3x8<S>,
    is_flat: mask64x8<S>,
    /// Where `n` has been mirrored, because it faced away from the viewer.
    turned: mask64x8<S>,
}

impl<S: Simd> SurfacePacket<S> {
    /// The surfaces at `hits`, in the lanes of `hit`. `ids` are the primitives.
    #[inline(never)]
    #[expect(clippy::too_many_arguments, reason = "inlined where it is used")]
    pub(crate) fn at(
        simd: S,
        scene: &PathScene<'_>,
        rays: &RayPacket<S>,
        hits: &HitPacket<S>,
        ids: &[usize; LANES],
        hit: u64,
        color: Vec3x8<S>,
        fallback: &dyn ScalarFallback,
    ) -> SurfacePacket<S> {
        simd.vectorize(
            #[inline(always)]
            || {
                let count = scene.lit.scene.triangles.len();
                let mut surfaces = SurfacePacket {
                    prim: hits.prim,
                    departure: Departure {
                        p: rays.o,
                        ng: rays.d,
                        distance: hits.t,
                    },
                    n: rays.d,
                    hit_ng: rays.d,
                    uv: hits.weights(),
                    color,
                    is_flat: hits.prim.simd_lt(f64x8::splat(simd, count as f64)),
                    turned: mask64x8::splat(simd, false),
                };
                let flat = surfaces.is_flat.to_bitmask();
                let mut sound = 0;
                if count > 0 {
                    sound = flat & surfaces.fill_triangles(simd, scene, ids);
                }
                if hit & !flat != 0 {
                    sound |= !flat & surfaces.fill_spheres(simd, scene, rays, hits, ids);
                }
                for lane in lanes(hit & !sound) {
                    let hit = hits.lane(lane, &surfaces.uv);
                    let id = PrimId(ids[lane] as u32);
                    surfaces.set(lane, scene, &fallback.record(id, &rays.lane(lane), hit));
                }
                surfaces.turn_normals(simd, rays.d);
                surfaces
            },
        )
    }

    /// Mirrors the shading normals that face away from a viewer on the other side of the surface,
    /// at the plane across the directions `d` of the rays.
    #[inline(always)]
    fn turn_normals(&mut self, simd: S, d: Vec3x8<S>) {
        let along = self.n.dot(d);
        let zero = f64x8::splat(simd, 0.0);
        let faces_away = (along * self.departure.ng.dot(d)).simd_lt(zero);
        let turned = self.n - d * (along * 2.0);
        self.n = turned.masked_or(faces_away, self.n);
        self.turned = faces_away;
    }

    /// Sets one lane to the surface at `hit`.
    fn set(&mut self, lane: usize, scene: &PathScene<'_>, hit: &Hit) {
        let surface = scene.lit.surface(hit);
        self.n.set(lane, hit.n.to_array());
        self.hit_ng.set(lane, hit.ng.to_array());
        self.departure.p.set(lane, surface.p.to_array());
        self.departure.ng.set(lane, surface.ng.to_array());
        self.departure.distance[lane] = surface.error.dot(surface.ng.abs());
    }

    /// Fills all lanes as if they were on triangles. Returns the lanes, one bit each, whose result
    /// is accurate: those of degenerate triangles are not.
    #[inline(always)]
    fn fill_triangles(&mut self, simd: S, scene: &PathScene<'_>, ids: &[usize; LANES]) -> u64 {
        let triangles = &scene.lit.scene.triangles;
        let last = triangles.len() - 1;
        let of: [&Triangle; LANES] = std::array::from_fn(|lane| &triangles[ids[lane].min(last)]);
        let p0 = Vec3x8::gather(simd, |lane| of[lane].p0.to_array());
        let p1 = Vec3x8::gather(simd, |lane| of[lane].p1.to_array());
        let p2 = Vec3x8::gather(simd, |lane| of[lane].p2.to_array());
        let (e1, e2) = (p1 - p0, p2 - p0);
        let (hit_ng, is_accurate) = record::geometric_normal(e1, e2);
        let n0 = Vec3x8::gather(simd, |lane| of[lane].n0.to_array());
        let (mut n1, mut n2) = (n0, n0);
        if !scene.is_faceted {
            n1 = Vec3x8::gather(simd, |lane| of[lane].n1.to_array());
            n2 = Vec3x8::gather(simd, |lane| of[lane].n2.to_array());
        }
        let p = record::triangle_point(p0, e1, e2, self.uv);
        self.hit_ng = hit_ng;
        self.n = record::shading_normal([n0, n1, n2], self.uv, hit_ng);
        self.departure = Departure::from_triangle(p, hit_ng, [p0, p1, p2], [n0, n1, n2]);
        is_accurate.to_bitmask()
    }

    /// Fills the lanes that are on spheres. Returns the lanes, one bit each, whose result is
    /// accurate: those of spheres so small that their points round to the centre are not.
    #[inline(always)]
    fn fill_spheres(
        &mut self,
        simd: S,
        scene: &PathScene<'_>,
        rays: &RayPacket<S>,
        hits: &HitPacket<S>,
        ids: &[usize; LANES],
    ) -> u64 {
        let count = scene.lit.scene.triangles.len();
        let spheres = &scene.lit.scene.spheres;
        let of = |lane: usize| &spheres[ids[lane].max(count) - count];
        let sphere = lanes::Sphere {
            center: Vec3x8::gather(simd, |lane| of(lane).center.to_array()),
            radius: f64x8::from_fn(simd, |lane| of(lane).radius),
        };
        let (n, is_defined) = record::sphere_normal(rays, &sphere, hits.t);
        let departure = Departure::from_sphere(record::sphere_point(&sphere, n), n, &sphere);
        let flat = self.is_flat;
        self.n = self.n.masked_or(flat, n);
        self.hit_ng = self.hit_ng.masked_or(flat, n);
        self.departure = self.departure.masked_or(flat, departure);
        is_defined.to_bitmask()
    }

    /// The hit in a lane.
    pub(crate) fn hit(&self, lane: usize, hits: &HitPacket<S>) -> Hit {
        Hit {
            t: hits.t[lane],
            p: self.departure.p.lane(lane),
            n: self.n.lane(lane),
            ng: self.hit_ng.lane(lane),
            uv: Vec2::new(self.uv[0][lane], self.uv[1][lane]),
            prim: PrimId(self.prim[lane] as u32),
        }
    }

    /// Whether the shading normal in a lane depends on the viewer.
    pub(crate) fn is_turned(&self, lane: usize) -> bool {
        self.turned.to_bitmask() >> lane & 1 == 1
    }

    /// The origins of rays that leave along `w`, and the primitives that these rays skip.
    #[inline(always)]
    pub(crate) fn leave(&self, simd: S, w: Vec3x8<S>) -> (Vec3x8<S>, f64x8<S>) {
        let zero = f64x8::splat(simd, 0.0);
        let outward = self.is_flat | zero.simd_lt(w.dot(self.hit_ng));
        let skip = outward.select(self.prim, f64x8::splat(simd, NONE));
        (self.departure.origin(w), skip)
    }
}
