//! Beyond the course: the microfacet model of rough surfaces.
//!
//! A rough surface consists of facets too small to see. The density of facets with the normal `h`
//! is the distribution D of Trowbridge and Reitz (1975), also called GGX (Walter, Marschner, Li,
//! Torrance: "Microfacet models for refraction through rough surfaces", EGSR 2007). Smith's G is
//! the fraction of these facets that is not hidden by others. Directions are unit vectors in the
//! local space of the surface; the normal is +z. `a` is the roughness α, in (0, 1].

use kit::math;
use kit::{Vec2, Vec3};
use std::f64::consts::{PI, TAU};

/// Smallest α. Smoother surfaces use it: the highlight is then 1e-4 radians wide, and formulas with
/// `α⁴` stay accurate.
pub(crate) const MIN_ALPHA: f64 = 1e-4;

/// The distribution D: the density of facets with the normal `h`, per area and steradian.
pub(crate) fn distribution(h: Vec3, a: f64) -> f64 {
    // h.z²(α² - 1) + 1, without cancellation at the peak.
    let d = h.x * h.x + h.y * h.y + h.z * h.z * a * a;
    a * a / (PI * d * d)
}

/// Smith's Λ: the fraction 1/(1 + Λ) of the facets is visible from `w`.
pub(crate) fn lambda(w: Vec3, a: f64) -> f64 {
    let tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    0.5 * ((1.0 + a * a * tan2).sqrt() - 1.0)
}

/// Samples the normal of a facet that is visible from `up`, a direction above the surface.
///
/// `u` is uniform in [0, 1)². The density is `D(h) · (up·h) / ((1 + Λ(up)) · up.z)`. The visible
/// facets are those of a hemisphere seen from a stretched `up`. There, their normals are the half
/// vectors of `up` and the directions of a spherical cap (Dupuy and Benyoub, "Sampling visible GGX
/// normals with spherical caps", HPG 2023).
pub(crate) fn sample_visible(up: Vec3, a: f64, u: Vec2) -> Option<Vec3> {
    let stretched = Vec3::new(a * up.x, a * up.y, up.z).normalize();
    let (sin_phi, cos_phi) = math::sin_cos(TAU * u.x);
    let z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let h = Vec3::new(r * cos_phi, r * sin_phi, z) + stretched;
    Vec3::new(a * h.x, a * h.y, h.z.max(0.0)).try_normalize()
}
