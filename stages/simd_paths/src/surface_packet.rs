// BEGIN SOLUTION(part6.task2)
//! Eight points on surfaces, as shading needs them.

use crate::lanes::lanes;
use crate::ray_packet::{HitPacket, NONE, RayPacket};
use crate::vec3x8::{LANES, Vec3x8};
use crate::{PathScene, ScalarFallback};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::surface::POSITION_ERROR;
use kit::{Hit, PrimId, Triangle, Vec2};

/// Eight points on surfaces. Repeats the arithmetic of `intersect::record_triangle`,
/// `intersect::intersect_sphere` and [`kit::Surface`] operation by operation.
pub(crate) struct SurfacePacket<S: Simd> {
    /// The numbers of the primitives.
    pub(crate) prim: f64x8<S>,
    pub(crate) p: Vec3x8<S>,
    /// Shading normals.
    pub(crate) n: Vec3x8<S>,
    /// Geometric normals of the hits.
    pub(crate) hit_ng: Vec3x8<S>,
    /// Geometric normals on the side of the vertex normals.
    pub(crate) ng: Vec3x8<S>,
    pub(crate) uv: [f64x8<S>; 2],
    /// The reflectance if diffuse, the radiance if it emits.
    pub(crate) color: Vec3x8<S>,
    /// How far along `ng` the origins of rays are moved off the surface.
    distance: f64x8<S>,
    is_flat: mask64x8<S>,
}

/// As in `intersect::record_triangle`: the bounds below which it computes a normal with more care.
const CANCELLATION: f64 = 1.0 / 1024.0;
const SMALLEST: f64 = 1e-290;

/// As in `intersect::record_triangle`: vertex normals whose sum is shorter cancel.
const CANCELLED_NORMAL: f64 = 1e-12;

impl<S: Simd> SurfacePacket<S> {
    /// The surfaces at `hits`, in the lanes of `hit`. `ids` are the primitives.
    #[inline(always)]
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
        let count = scene.lit.scene.triangles.len();
        let mut surfaces = SurfacePacket {
            prim: hits.prim,
            p: rays.o,
            n: rays.d,
            hit_ng: rays.d,
            ng: rays.d,
            uv: hits.weights(),
            color,
            distance: hits.t,
            is_flat: hits.prim.simd_lt(f64x8::splat(simd, count as f64)),
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
        surfaces
    }

    /// Sets one lane to the surface at `hit`.
    fn set(&mut self, lane: usize, scene: &PathScene<'_>, hit: &Hit) {
        let surface = scene.lit.surface(hit);
        self.p.set(lane, surface.p.to_array());
        self.n.set(lane, hit.n.to_array());
        self.hit_ng.set(lane, hit.ng.to_array());
        self.ng.set(lane, surface.ng.to_array());
        self.distance[lane] = surface.error.dot(surface.ng.abs());
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
        let normal = e1.cross(e2);
        let length2 = normal.dot(normal);
        let smallest = e1.dot(e1) * e2.dot(e2) * (CANCELLATION * CANCELLATION);
        let is_sound = smallest.simd_lt(length2)
            & f64x8::splat(simd, SMALLEST).simd_lt(length2)
            & length2.simd_lt(f64x8::splat(simd, f64::INFINITY));
        self.hit_ng = normal / length2.sqrt();

        let [b1, b2] = self.uv;
        self.p = p0 + e1 * b1 + e2 * b2;
        let n0 = Vec3x8::gather(simd, |lane| of[lane].n0.to_array());
        let (mut n1, mut n2) = (n0, n0);
        if !scene.is_faceted {
            n1 = Vec3x8::gather(simd, |lane| of[lane].n1.to_array());
            n2 = Vec3x8::gather(simd, |lane| of[lane].n2.to_array());
        }
        let b0 = f64x8::splat(simd, 1.0) - b1 - b2;
        let normal = n0 * b0 + n1 * b1 + n2 * b2;
        let length = normal.length();
        let is_defined = f64x8::splat(simd, CANCELLED_NORMAL).simd_lt(length)
            & length.simd_lt(f64x8::splat(simd, f64::INFINITY));
        self.n = (normal / length).masked_or(is_defined, self.hit_ng);

        let behind = self.hit_ng.dot(n0 + n1 + n2);
        let behind = behind.simd_lt(f64x8::splat(simd, 0.0));
        self.ng = (-self.hit_ng).masked_or(behind, self.hit_ng);
        let error = p0.abs().max(p1.abs()).max(p2.abs()) * f64x8::splat(simd, POSITION_ERROR);
        self.distance = error.dot(self.ng.abs());
        is_sound.to_bitmask()
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
        let center = Vec3x8::gather(simd, |lane| of(lane).center.to_array());
        let radius = f64x8::from_fn(simd, |lane| of(lane).radius);
        let from_center = ((rays.o - center) + rays.d * hits.t) / radius;
        let inverse = f64x8::splat(simd, 1.0) / from_center.length();
        let n = from_center * inverse;
        let flat = self.is_flat;
        self.p = self.p.masked_or(flat, center + n * radius);
        self.n = self.n.masked_or(flat, n);
        self.hit_ng = self.hit_ng.masked_or(flat, n);
        self.ng = self.ng.masked_or(flat, n);
        let largest = center.abs()
            + Vec3x8 {
                x: radius,
                y: radius,
                z: radius,
            };
        let error = largest * f64x8::splat(simd, POSITION_ERROR);
        self.distance = flat.select(self.distance, error.dot(n.abs()));
        let is_sound = f64x8::splat(simd, 0.0).simd_lt(inverse)
            & inverse.simd_lt(f64x8::splat(simd, f64::INFINITY));
        is_sound.to_bitmask()
    }

    /// The hit in a lane.
    pub(crate) fn hit(&self, lane: usize, hits: &HitPacket<S>) -> Hit {
        Hit {
            t: hits.t[lane],
            p: self.p.lane(lane),
            n: self.n.lane(lane),
            ng: self.hit_ng.lane(lane),
            uv: Vec2::new(self.uv[0][lane], self.uv[1][lane]),
            prim: PrimId(self.prim[lane] as u32),
        }
    }

    /// The origins of rays that leave along `w`, and the primitives that these rays skip.
    #[inline(always)]
    pub(crate) fn leave(&self, simd: S, w: Vec3x8<S>) -> (Vec3x8<S>, f64x8<S>) {
        let zero = f64x8::splat(simd, 0.0);
        let behind = w.dot(self.ng).simd_lt(zero);
        let distance = behind.select(-self.distance, self.distance);
        let outward = self.is_flat | zero.simd_lt(w.dot(self.hit_ng));
        let skip = outward.select(self.prim, f64x8::splat(simd, NONE));
        (self.p + self.ng * distance, skip)
    }

    /// Transforms `w` from local space, where z is the normal, to world space, as [`kit::Frame`]
    /// does.
    #[inline(always)]
    pub(crate) fn to_world(&self, simd: S, w: Vec3x8<S>) -> Vec3x8<S> {
        let [s, t] = self.tangents(simd);
        s * w.x + t * w.y + self.n * w.z
    }

    /// Transforms `w` from world space to local space, as [`kit::Frame`] does.
    #[inline(always)]
    pub(crate) fn to_local(&self, simd: S, w: Vec3x8<S>) -> Vec3x8<S> {
        let [s, t] = self.tangents(simd);
        Vec3x8 {
            x: w.dot(s),
            y: w.dot(t),
            z: w.dot(self.n),
        }
    }

    /// The axes x and y of the local space.
    #[inline(always)]
    fn tangents(&self, simd: S) -> [Vec3x8<S>; 2] {
        let one = f64x8::splat(simd, 1.0);
        let n = self.n;
        let sign = one.copysign(n.z);
        let a = -one / (sign + n.z);
        let b = n.x * n.y * a;
        let s = Vec3x8 {
            x: one + sign * n.x * n.x * a,
            y: sign * b,
            z: -sign * n.x,
        };
        let t = Vec3x8 {
            x: b,
            y: sign + n.y * n.y * a,
            z: -n.y,
        };
        [s, t]
    }
}
// END SOLUTION(part6.task2)
