//! Beyond the course: what rough surfaces are made of.
//!
//! A rough surface is made of facets too small to see. How many of them face the direction `h` is the distribution D of
//! Trowbridge and Reitz (1975), also called GGX (Walter, Marschner, Li, Torrance: "Microfacet models for refraction
//! through rough surfaces", EGSR 2007); how many of those are hidden by others is Smith's G. Directions are unit vectors in
//! the local space of the surface, the normal is +z; `a` is the roughness α, in (0, 1].

use kit::math;
use kit::{Vec2, Vec3};
use std::f64::consts::{PI, TAU};

/// Smoother surfaces count as this rough: their highlight is a ten-thousandth of a radian wide, and formulas with `α⁴`
/// below keep their digits.
pub(crate) const SMOOTHEST: f64 = 1e-4;

/// The density of facets that face `h`, per area and steradian.
pub(crate) fn facing(h: Vec3, a: f64) -> f64 {
    // h.z²(α² - 1) + 1, without the cancellation at the peak.
    let d = h.x * h.x + h.y * h.y + h.z * h.z * a * a;
    a * a / (PI * d * d)
}

/// Smith's Λ: 1/(1 + Λ) of the facets are seen from `w`.
pub(crate) fn hidden(w: Vec3, a: f64) -> f64 {
    let tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    0.5 * ((1.0 + a * a * tan2).sqrt() - 1.0)
}

/// A facet drawn among those that are seen from `up`, a direction above the surface: where it faces. `u` is uniform in
/// [0, 1)². Its density is `D(h) · (up·h) / ((1 + Λ(up)) · up.z)`.
///
/// The facets seen are those of a hemisphere seen from a stretched `up`, and there they lie half-way between `up` and a
/// spherical cap (Dupuy and Benyoub, "Sampling visible GGX normals with spherical caps", HPG 2023).
pub(crate) fn visible(up: Vec3, a: f64, u: Vec2) -> Option<Vec3> {
    let stretched = Vec3::new(a * up.x, a * up.y, up.z).normalize();
    let (sin_phi, cos_phi) = math::sin_cos(TAU * u.x);
    let z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let h = Vec3::new(r * cos_phi, r * sin_phi, z) + stretched;
    Vec3::new(a * h.x, a * h.y, h.z.max(0.0)).try_normalize()
}
