//! Mappings from the unit square to other domains that keep samples uniform.

use crate::math;
use crate::{Vec2, Vec3};
use std::f64::consts::{FRAC_1_PI, TAU};

/// Density of [`uniform_hemisphere`] in 1/sr: one divided by its 2π steradians.
pub const UNIFORM_HEMISPHERE_PDF: f64 = 0.5 * FRAC_1_PI;

/// A unit vector with `z >= 0`, uniform over the hemisphere, from `u` in [0, 1)².
///
/// `z` is uniform, because the area of a sphere between two parallel planes is in proportion to
/// their distance (Archimedes).
#[inline]
pub fn uniform_hemisphere(u: Vec2) -> Vec3 {
    on_sphere(u.x, u.y)
}

/// A unit vector, uniform over the sphere, from `u` in [0, 1)². The density is `1/(4π)`.
#[inline]
pub fn uniform_sphere(u: Vec2) -> Vec3 {
    on_sphere(1.0 - 2.0 * u.x, u.y)
}

/// Barycentric weights `(b1, b2)` of a point uniform over a triangle, from `u` in [0, 1)².
///
/// Scaling a triangle by `s` towards `p0` scales its area by `s²`, so `s` is the square root of a
/// uniform number.
///
/// ```
/// use kit::{Vec2, warp};
/// let b = warp::uniform_triangle(Vec2::new(0.25, 0.5));
/// assert_eq!(b, Vec2::new(0.25, 0.25));
/// ```
#[inline]
pub fn uniform_triangle(u: Vec2) -> Vec2 {
    let s = u.x.sqrt();
    Vec2::new(s * (1.0 - u.y), s * u.y)
}

/// The unit vector with the given `z`, rotated from the x axis by `turns` full turns about the z
/// axis.
#[inline]
pub fn on_sphere(z: f64, turns: f64) -> Vec3 {
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = math::sin_cos(TAU * turns);
    Vec3::new(r * cos, r * sin, z)
}
