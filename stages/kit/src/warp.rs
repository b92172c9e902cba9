//! Uniform numbers in the unit square to points elsewhere, uniform as well.

use crate::math;
use crate::{Vec2, Vec3};
use std::f64::consts::{FRAC_1_PI, TAU};

/// Density of [`uniform_hemisphere`]: one over its 2π steradians.
pub const UNIFORM_HEMISPHERE_PDF: f64 = 0.5 * FRAC_1_PI;

/// A unit vector with `z >= 0`, uniform over the hemisphere, from `u` in [0, 1)².
///
/// Archimedes: the slices of a sphere between two planes have an area in proportion to their height, so
/// `z` is uniform.
#[inline]
pub fn uniform_hemisphere(u: Vec2) -> Vec3 {
    on_sphere(u.x, u.y)
}

/// A unit vector, uniform over the sphere, from `u` in [0, 1)². Its density is `1/(4π)`.
#[inline]
pub fn uniform_sphere(u: Vec2) -> Vec3 {
    on_sphere(1.0 - 2.0 * u.x, u.y)
}

/// Barycentric weights `(b1, b2)` of a point uniform over a triangle, from `u` in [0, 1)².
///
/// The part of a triangle within a share `s` of the way from `p0` to the far edge has the share `s²` of its area.
#[inline]
pub fn uniform_triangle(u: Vec2) -> Vec2 {
    let s = u.x.sqrt();
    Vec2::new(s * (1.0 - u.y), s * u.y)
}

/// The unit vector at height `z` and at `turns` of a turn around the z axis.
#[inline]
pub fn on_sphere(z: f64, turns: f64) -> Vec3 {
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = math::sin_cos(TAU * turns);
    Vec3::new(r * cos, r * sin, z)
}
