// BEGIN SOLUTION(part6.task2)
//! Tests eight rays against a sphere.

use super::PacketTest;
use crate::ray_packet::RayPacket;
use crate::vec3x8::Vec3x8;
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use kit::Sphere;

/// As in `intersect::test_sphere`, which explains them.
const CLOSE_CALL: f64 = 1.0 / 1024.0;
const FAR: f64 = (1_u64 << 40) as f64;
const SMALLEST: f64 = 1e-100;
const LARGEST: f64 = 1e100;

/// Tests a sphere for hits up to `max_t`. Repeats the arithmetic of `intersect::test_sphere`
/// operation by operation; where that switches to its careful variant, the lane is undecided.
/// `None` if all lanes in `active` miss for certain.
#[inline(always)]
pub(super) fn test<S: Simd>(
    simd: S,
    sphere: &Sphere,
    rays: &RayPacket<S>,
    max_t: f64x8<S>,
    active: u64,
) -> Option<PacketTest<S>> {
    let (d, r2) = (rays.d, sphere.radius * sphere.radius);
    let f = rays.o - Vec3x8::splat(simd, sphere.center);
    let a = d.dot(d);
    let b = -f.dot(d);
    let f2 = f.dot(f);
    let c = f2 - r2;
    let beside = f + d * (b / a);
    let disc = f64x8::splat(simd, r2) - beside.dot(beside);
    let close = f64x8::splat(simd, CLOSE_CALL * r2);
    let is_sound = close.simd_lt(disc.abs())
        & close.simd_lt(c.abs())
        & f2.simd_lt(f64x8::splat(simd, FAR * r2))
        & f64x8::splat(simd, SMALLEST).simd_lt(a)
        & a.simd_lt(f64x8::splat(simd, LARGEST));
    let is_ordinary = SMALLEST < r2 && r2 < LARGEST && sphere.radius > 0.0;
    let sound = if is_ordinary {
        is_sound.to_bitmask()
    } else {
        0
    };
    let zero = f64x8::splat(simd, 0.0);
    let undecided = active & !sound;
    let candidates = active & sound & zero.simd_le(disc).to_bitmask();
    if candidates | undecided == 0 {
        return None;
    }
    let root = (a * disc).sqrt();
    let goes_away = b.simd_lt(zero);
    let q = goes_away.select(b - root, b + root);
    let (by_sum, by_product) = (q / a, c / q);
    let near = goes_away.select(by_sum, by_product);
    let far = goes_away.select(by_product, by_sum);
    let t = rays.in_range(near, max_t).select(near, far);
    Some(PacketTest {
        hit: mask64x8::from_bitmask(simd, candidates) & rays.in_range(t, max_t),
        undecided,
        t,
        v: zero,
        w: zero,
        det: f64x8::splat(simd, 1.0),
    })
}
// END SOLUTION(part6.task2)
