// BEGIN SOLUTION(part6.task2)
//! Eight rays against a triangle.

use super::Verdict;
use crate::rays::Rays;
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::Vec3;

/// A corner as eight rays see it: where the line through it along each ray crosses the plane z = 0, seen from the ray's
/// origin and times the direction's z; and how far the corner is from that plane.
pub(super) type Seen = [[f64; LANES]; 3];

/// Eight rays as the test wants them: with axes renamed in a circle, so that each goes mostly along its z.
pub(super) struct Turned<S: Simd> {
    along_z: mask64x8<S>,
    along_y: mask64x8<S>,
    o: Vec3x8<S>,
    d: Vec3x8<S>,
}

/// Below this share of its terms the determinant has lost too many digits.
const CANCELLATION: f64 = 1.0 / 1024.0;

/// Products below may have underflowed on the way.
const SMALLEST: f64 = 1e-290;

impl<S: Simd> Turned<S> {
    #[inline(always)]
    pub(super) fn new(rays: &Rays<S>) -> Turned<S> {
        let (x, y, z) = (rays.d.x.abs(), rays.d.y.abs(), rays.d.z.abs());
        let mut turned = Turned {
            along_z: z.simd_ge(x) & z.simd_ge(y),
            along_y: y.simd_ge(x),
            o: rays.o,
            d: rays.d,
        };
        (turned.o, turned.d) = (turned.turn(rays.o), turned.turn(rays.d));
        turned
    }

    #[inline(always)]
    fn turn(&self, v: Vec3x8<S>) -> Vec3x8<S> {
        let (z, y) = (self.along_z, self.along_y);
        Vec3x8 {
            x: z.select(v.x, y.select(v.z, v.y)),
            y: z.select(v.y, y.select(v.x, v.z)),
            z: z.select(v.z, y.select(v.y, v.x)),
        }
    }

    /// Looks at each of `corners`.
    #[inline(always)]
    pub(super) fn look(&self, simd: S, corners: &[Vec3], seen: &mut Vec<Seen>) {
        seen.resize(corners.len(), Seen::default());
        let d = self.d;
        for (corner, seen) in corners.iter().zip(seen) {
            let p = self.turn(Vec3x8::splat(simd, *corner)) - self.o;
            (p.x * d.z - d.x * p.z).store_array(&mut seen[0]);
            (p.y * d.z - d.y * p.z).store_array(&mut seen[1]);
            p.z.store_array(&mut seen[2]);
        }
    }

    /// Tests a triangle by the arithmetic of the plain kernel, `intersect::test_triangle`, operation by operation, for
    /// hits up to `max_t`. Where that one goes on to its careful twin, the lane is unsure. `None` if surely none of the
    /// lanes in `asked` hits it.
    #[inline(always)]
    pub(super) fn test(
        &self,
        simd: S,
        [a, b, c]: [&Seen; 3],
        rays: &Rays<S>,
        max_t: f64x8<S>,
        asked: u64,
    ) -> Option<Verdict<S>> {
        let (a, b, c) = (load(simd, a), load(simd, b), load(simd, c));
        let (cb, ac, ba) = (c.x * b.y, a.x * c.y, b.x * a.y);
        let u = cb - c.y * b.x;
        let v = ac - a.y * c.x;
        let w = ba - b.y * a.x;
        let agreement = u.min(v.min(w)) * u.max(v.max(w));
        let zero = f64x8::splat(simd, 0.0);
        let candidates = asked & !agreement.simd_lt(zero).to_bitmask();
        if candidates == 0 {
            return None;
        }
        let det = u + v + w;
        let numerator = u * a.z + v * b.z + w * c.z;
        let denominator = det * self.d.z;
        let terms = cb.abs() + ac.abs() + ba.abs();
        let is_sound = zero.simd_lt(agreement)
            & (terms * CANCELLATION).simd_lt(det.abs())
            & is_ordinary(simd, numerator)
            & is_ordinary(simd, denominator);
        let t = numerator / denominator;
        let hit = is_sound & rays.in_range(t, max_t);
        Some(Verdict {
            hit: hit & mask64x8::from_bitmask(simd, candidates),
            unsure: candidates & !is_sound.to_bitmask(),
            t,
            v,
            w,
            det,
        })
    }
}

#[inline(always)]
fn load<S: Simd>(simd: S, seen: &Seen) -> Vec3x8<S> {
    Vec3x8 {
        x: f64x8::load_array_ref(simd, &seen[0]),
        y: f64x8::load_array_ref(simd, &seen[1]),
        z: f64x8::load_array_ref(simd, &seen[2]),
    }
}

/// Whether products of several factors have neither underflowed nor overflowed on the way.
#[inline(always)]
fn is_ordinary<S: Simd>(simd: S, x: f64x8<S>) -> mask64x8<S> {
    let size = x.abs();
    f64x8::splat(simd, SMALLEST).simd_lt(size) & size.simd_lt(f64x8::splat(simd, f64::INFINITY))
}
// END SOLUTION(part6.task2)
