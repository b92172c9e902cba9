//! A leaf of up to eight spheres: finds those that a ray misses for certain.

use crate::layout::LANES;
use fearless_simd::{Simd, f64x8, prelude::*};
use kit::{PrimId, Ray, Sphere};
use lanes::Vec3;

/// Up to eight spheres, one per lane.
#[derive(Clone, Debug)]
#[repr(C, align(64))]
pub(crate) struct SphereBlock {
    /// Centres by axis. Lanes without a sphere repeat the first one.
    centers: [[f64; LANES]; 3],
    /// Squared radii.
    r2: [f64; LANES],
    ids: [u32; LANES],
    count: u32,
}

/// A ray misses for certain if its squared distance from the centre is more than this many squared
/// radii. The margin is 2⁻⁸.
const MISS_DISTANCE: f64 = 1.0 + 1.0 / 256.0;

/// Up to this squared distance in squared radii (2²⁰ radii), squared distances have an error of at
/// most 2⁻¹² of the squared radius.
const FAR: f64 = (1_u64 << 40) as f64;

/// A product of four lengths above this has not underflowed.
const SMALLEST: f64 = 1e-200;

impl SphereBlock {
    /// A block of the spheres `prims`, one to eight. `spheres[0]` is primitive number `first`.
    pub(crate) fn of(spheres: &[Sphere], first: usize, prims: &[PrimId]) -> SphereBlock {
        let id = |lane: usize| prims.get(lane).unwrap_or(&prims[0]).0;
        let sphere = |lane: usize| &spheres[id(lane) as usize - first];
        SphereBlock {
            centers: std::array::from_fn(|axis| {
                std::array::from_fn(|lane| sphere(lane).center[axis])
            }),
            r2: std::array::from_fn(|lane| sphere(lane).radius * sphere(lane).radius),
            ids: std::array::from_fn(id),
            count: prims.len() as u32,
        }
    }

    #[inline(always)]
    pub(crate) fn id(&self, lane: usize) -> PrimId {
        PrimId(self.ids[lane])
    }

    /// The lanes, one bit each, that the ray may hit in its range. It misses the others for
    /// certain, by a margin far above the rounding errors here and in the scalar kernel.
    ///
    /// With `f = o - center` the squared distance from the line to the centre is `(|f|²|d|² -
    /// (f·d)²) / |d|²`. A ray that starts outside and points away has no hit at positive `t`.
    #[inline(always)]
    pub(crate) fn candidates<S: Simd>(&self, simd: S, ray: &Ray) -> u32 {
        let Ray { o, d, .. } = *ray;
        let a = f64x8::splat(simd, d.dot(d));
        let f = Vec3 {
            x: f64x8::splat(simd, o.x) - f64x8::load_array_ref(simd, &self.centers[0]),
            y: f64x8::splat(simd, o.y) - f64x8::load_array_ref(simd, &self.centers[1]),
            z: f64x8::splat(simd, o.z) - f64x8::load_array_ref(simd, &self.centers[2]),
        };
        let d = Vec3::splat(simd, d);
        let r2 = f64x8::load_array_ref(simd, &self.r2);
        let (along, f2) = (f.dot(d), f.dot(f));
        let bound = r2 * MISS_DISTANCE;
        let passes_by = (a * bound).simd_lt(a * f2 - along * along);
        let points_away = f64x8::splat(simd, 0.0).simd_lt(along) & bound.simd_lt(f2);
        let starts_at_origin = if ray.min_t >= 0.0 { u32::MAX } else { 0 };
        let is_sound = f2.simd_lt(r2 * FAR)
            & f64x8::splat(simd, SMALLEST).simd_lt(a * a * (r2 * r2))
            & (a * f2).simd_lt(f64x8::splat(simd, f64::INFINITY));
        let misses =
            passes_by.to_bitmask() as u32 | points_away.to_bitmask() as u32 & starts_at_origin;
        let filled = (1 << self.count) - 1;
        filled & !(misses & is_sound.to_bitmask() as u32)
    }
}
