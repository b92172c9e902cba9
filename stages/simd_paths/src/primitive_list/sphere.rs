//! Tests eight rays against a sphere.

use super::PacketTest;
use crate::ray_packet::RayPacket;
use crate::vec3x8::Vec3x8;
use fearless_simd::{Simd, f64x8, mask64x8, prelude::*};
use lanes::sphere::SphereEquation;

/// Tests a sphere for hits up to `max_t`. `None` if all lanes in `active` miss for certain.
#[inline(always)]
pub(super) fn test<S: Simd>(
    simd: S,
    sphere: &kit::Sphere,
    rays: &RayPacket<S>,
    max_t: f64x8<S>,
    active: u64,
) -> Option<PacketTest<S>> {
    let sphere = lanes::Sphere {
        center: Vec3x8::splat(simd, sphere.center),
        radius: f64x8::splat(simd, sphere.radius),
    };
    let equation = SphereEquation::of(rays, &sphere);
    let sound = equation.is_sound().to_bitmask();
    let undecided = active & !sound;
    let candidates = active & sound & equation.has_roots().to_bitmask();
    if candidates | undecided == 0 {
        return None;
    }
    let rays = RayPacket { max_t, ..*rays };
    let [near, far] = equation.roots();
    let t = rays.in_range(near).select(near, far);
    let zero = f64x8::splat(simd, 0.0);
    Some(PacketTest {
        hit: mask64x8::from_bitmask(simd, candidates) & rays.in_range(t),
        undecided,
        t,
        v: zero,
        w: zero,
        det: f64x8::splat(simd, 1.0),
    })
}
