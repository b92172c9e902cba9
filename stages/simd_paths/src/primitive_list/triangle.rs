// BEGIN SOLUTION(part6.task2)
//! Tests eight rays against a triangle (Woop, Benthin, Wald, "Watertight Ray/Triangle
//! Intersection", JCGT 2013).

use super::PacketTest;
use crate::ray_packet::RayPacket;
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::Vec3;

/// A vertex projected along each of eight rays onto the plane z = 0. If `p` is the vertex relative
/// to the ray's origin, with the axes of [`AxisPermutedRays`], these are `p.x d.z - d.x p.z` and
/// `p.y d.z - d.y p.z` (x and y of the projected vertex, times `d.z`), and `p.z`.
pub(super) type ProjectedVertex = [[f64; LANES]; 3];

/// Eight rays whose axes are permuted cyclically, so that the z component of each direction has the
/// largest absolute value.
pub(super) struct AxisPermutedRays<S: Simd> {
    along_z: mask64x8<S>,
    along_y: mask64x8<S>,
    o: Vec3x8<S>,
    d: Vec3x8<S>,
}

/// If the determinant is smaller than this fraction of the size of its terms, cancellation has lost
/// too many of its digits.
const CANCELLATION: f64 = 1.0 / 1024.0;

/// If a product is smaller than this, the product of some of its factors may have underflowed.
const SMALLEST: f64 = 1e-290;

impl<S: Simd> AxisPermutedRays<S> {
    #[inline(always)]
    pub(super) fn new(rays: &RayPacket<S>) -> AxisPermutedRays<S> {
        let (x, y, z) = (rays.d.x.abs(), rays.d.y.abs(), rays.d.z.abs());
        let mut permuted = AxisPermutedRays {
            along_z: z.simd_ge(x) & z.simd_ge(y),
            along_y: y.simd_ge(x),
            o: rays.o,
            d: rays.d,
        };
        (permuted.o, permuted.d) = (permuted.permute(rays.o), permuted.permute(rays.d));
        permuted
    }

    #[inline(always)]
    fn permute(&self, v: Vec3x8<S>) -> Vec3x8<S> {
        let (z, y) = (self.along_z, self.along_y);
        Vec3x8 {
            x: z.select(v.x, y.select(v.z, v.y)),
            y: z.select(v.y, y.select(v.x, v.z)),
            z: z.select(v.z, y.select(v.y, v.x)),
        }
    }

    /// Projects `vertices` along the rays.
    #[inline(always)]
    pub(super) fn project(&self, simd: S, vertices: &[Vec3], projected: &mut Vec<ProjectedVertex>) {
        projected.resize(vertices.len(), ProjectedVertex::default());
        let d = self.d;
        for (vertex, projected) in vertices.iter().zip(projected) {
            let p = self.permute(Vec3x8::splat(simd, *vertex)) - self.o;
            (p.x * d.z - d.x * p.z).store_array(&mut projected[0]);
            (p.y * d.z - d.y * p.z).store_array(&mut projected[1]);
            p.z.store_array(&mut projected[2]);
        }
    }

    /// Tests a triangle for hits up to `max_t`. Performs the same floating-point operations as
    /// `intersect::test_triangle`. Lanes for which that function switches to its careful variant
    /// are undecided. Returns `None` if all lanes in `active` certainly miss.
    #[inline(always)]
    pub(super) fn test(
        &self,
        simd: S,
        [a, b, c]: [&ProjectedVertex; 3],
        rays: &RayPacket<S>,
        max_t: f64x8<S>,
        active: u64,
    ) -> Option<PacketTest<S>> {
        let (a, b, c) = (load(simd, a), load(simd, b), load(simd, c));
        let (cb, ac, ba) = (c.x * b.y, a.x * c.y, b.x * a.y);
        let u = cb - c.y * b.x;
        let v = ac - a.y * c.x;
        let w = ba - b.y * a.x;
        // Negative if `u`, `v` and `w` have different signs: the ray misses.
        let min_times_max = u.min(v.min(w)) * u.max(v.max(w));
        let zero = f64x8::splat(simd, 0.0);
        let candidates = active & !min_times_max.simd_lt(zero).to_bitmask();
        if candidates == 0 {
            return None;
        }
        let det = u + v + w;
        let numerator = u * a.z + v * b.z + w * c.z;
        let denominator = det * self.d.z;
        let terms = cb.abs() + ac.abs() + ba.abs();
        let is_certain = zero.simd_lt(min_times_max)
            & (terms * CANCELLATION).simd_lt(det.abs())
            & is_ordinary(simd, numerator)
            & is_ordinary(simd, denominator);
        let t = numerator / denominator;
        let hit = is_certain & rays.in_range(t, max_t);
        Some(PacketTest {
            hit: hit & mask64x8::from_bitmask(simd, candidates),
            undecided: candidates & !is_certain.to_bitmask(),
            t,
            v,
            w,
            det,
        })
    }
}

#[inline(always)]
fn load<S: Simd>(simd: S, vertex: &ProjectedVertex) -> Vec3x8<S> {
    Vec3x8 {
        x: f64x8::load_array_ref(simd, &vertex[0]),
        y: f64x8::load_array_ref(simd, &vertex[1]),
        z: f64x8::load_array_ref(simd, &vertex[2]),
    }
}

/// Whether a product of several factors has neither underflowed nor overflowed.
#[inline(always)]
fn is_ordinary<S: Simd>(simd: S, x: f64x8<S>) -> mask64x8<S> {
    let size = x.abs();
    f64x8::splat(simd, SMALLEST).simd_lt(size) & size.simd_lt(f64x8::splat(simd, f64::INFINITY))
}
// END SOLUTION(part6.task2)
