// BEGIN SOLUTION(part6.task2)
//! Where eight rays hit, as shading sees it.

use crate::PathScene;
use crate::facts::Facts;
use crate::rays::{Hits, NONE, Rays};
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::Triangle;

/// Eight places on surfaces. What `intersect` records of a hit, and what [`kit::Surface`] makes of that, by their
/// arithmetic, operation by operation.
pub(crate) struct Surfaces<S: Simd> {
    /// The primitives' numbers.
    pub(crate) prim: f64x8<S>,
    pub(crate) p: Vec3x8<S>,
    /// Shading normals.
    pub(crate) n: Vec3x8<S>,
    /// Geometric normals as the hit has them, and on the side of the vertex normals.
    pub(crate) hit_ng: Vec3x8<S>,
    pub(crate) ng: Vec3x8<S>,
    pub(crate) uv: [f64x8<S>; 2],
    /// Reflectance of what scatters, radiance of what emits.
    pub(crate) colour: Vec3x8<S>,
    /// How far rays are moved off, along `ng`.
    distance: f64x8<S>,
    is_flat: mask64x8<S>,
}

/// As in `intersect`: vertex normals that cancel to less than this say nothing.
const CANCELLED_NORMAL: f64 = 1e-12;

impl<S: Simd> Surfaces<S> {
    /// Those at `hits`, whose primitives are `ids`; any at all in lanes without a hit. `alive` are the lanes that count.
    #[inline(always)]
    pub(crate) fn at(
        simd: S,
        scene: &PathScene<'_>,
        rays: &Rays<S>,
        hits: &Hits<S>,
        ids: &[usize; LANES],
        alive: u64,
    ) -> Surfaces<S> {
        let facts: [&Facts; LANES] = std::array::from_fn(|lane| &scene.facts[ids[lane]]);
        let count = scene.lit.scene.triangles.len();
        let hit_ng = Vec3x8::gather(simd, |lane| facts[lane].ng.to_array());
        let side = f64x8::from_fn(simd, |lane| facts[lane].side);
        let mut surfaces = Surfaces {
            prim: hits.prim,
            p: rays.o,
            n: hit_ng,
            hit_ng,
            ng: hit_ng * side,
            uv: hits.weights(),
            colour: Vec3x8::gather(simd, |lane| {
                scene.deeds[facts[lane].material as usize].1.to_array()
            }),
            distance: f64x8::from_fn(simd, |lane| facts[lane].distance),
            is_flat: hits.prim.simd_lt(f64x8::splat(simd, count as f64)),
        };
        if count > 0 {
            surfaces.be_flat(simd, scene, ids);
        }
        if alive & !surfaces.is_flat.to_bitmask() != 0 && !scene.lit.scene.spheres.is_empty() {
            surfaces.be_round(simd, scene, rays, hits, ids);
        }
        surfaces
    }

    /// All lanes are on triangles.
    #[inline(always)]
    fn be_flat(&mut self, simd: S, scene: &PathScene<'_>, ids: &[usize; LANES]) {
        let triangles = &scene.lit.scene.triangles;
        let last = triangles.len() - 1;
        let of: [&Triangle; LANES] = std::array::from_fn(|lane| &triangles[ids[lane].min(last)]);
        let p0 = Vec3x8::gather(simd, |lane| of[lane].p0.to_array());
        let e1 = Vec3x8::gather(simd, |lane| of[lane].p1.to_array()) - p0;
        let e2 = Vec3x8::gather(simd, |lane| of[lane].p2.to_array()) - p0;
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
        let is_sound = f64x8::splat(simd, CANCELLED_NORMAL).simd_lt(length)
            & length.simd_lt(f64x8::splat(simd, f64::INFINITY));
        self.n = normal.over(length).or(is_sound, self.hit_ng);
    }

    /// Lanes that are not on triangles are on spheres.
    #[inline(always)]
    fn be_round(
        &mut self,
        simd: S,
        scene: &PathScene<'_>,
        rays: &Rays<S>,
        hits: &Hits<S>,
        ids: &[usize; LANES],
    ) {
        let count = scene.lit.scene.triangles.len();
        let spheres = &scene.lit.scene.spheres;
        let of = |lane: usize| &spheres[ids[lane].max(count) - count];
        let center = Vec3x8::gather(simd, |lane| of(lane).center.to_array());
        let radius = f64x8::from_fn(simd, |lane| of(lane).radius);
        let from_center = ((rays.o - center) + rays.d * hits.t).over(radius);
        let n = from_center * (f64x8::splat(simd, 1.0) / from_center.length());
        let flat = self.is_flat;
        self.p = self.p.or(flat, center + n * radius);
        self.n = self.n.or(flat, n);
        self.hit_ng = self.hit_ng.or(flat, n);
        self.ng = self.ng.or(flat, n);
        let error = Vec3x8::gather(simd, |lane| scene.facts[ids[lane]].error.to_array());
        let size = Vec3x8 {
            x: n.x.abs(),
            y: n.y.abs(),
            z: n.z.abs(),
        };
        self.distance = flat.select(self.distance, error.dot(size));
    }

    /// The origins of rays that leave along `w`, and the primitives that these leave for good.
    #[inline(always)]
    pub(crate) fn leave(&self, simd: S, w: Vec3x8<S>) -> (Vec3x8<S>, f64x8<S>) {
        let zero = f64x8::splat(simd, 0.0);
        let behind = w.dot(self.ng).simd_lt(zero);
        let distance = behind.select(-self.distance, self.distance);
        let away = self.is_flat | zero.simd_lt(w.dot(self.hit_ng));
        let left = away.select(self.prim, f64x8::splat(simd, NONE));
        (self.p + self.ng * distance, left)
    }

    /// `w`, of which `w.z` is the part along the normal, from the surfaces' local space into the world's: [`kit::Frame`].
    #[inline(always)]
    pub(crate) fn to_world(&self, simd: S, w: Vec3x8<S>) -> Vec3x8<S> {
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
        s * w.x + t * w.y + n * w.z
    }
}
// END SOLUTION(part6.task2)
