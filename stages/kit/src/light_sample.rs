//! A direction towards a light, and what comes from there.

use crate::{Spectrum, Vec3};

/// A direction sampled towards a light from a given point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit direction to the light, in world space.
    pub wi: Vec3,
    /// Distance to the light along `wi`; infinite for directional lights, skies and environment
    /// maps.
    pub distance: f64,
    /// Density of `wi` with respect to solid angle, in 1/sr; 1 for delta lights (lights without
    /// area).
    pub pdf: f64,
    /// Radiance that arrives along `wi` if nothing blocks it. For delta lights: the irradiance on a
    /// surface that faces the light.
    pub radiance: Spectrum,
}

/// Unit direction and distance from `p` to `q`; `None` if they are the same point.
pub(crate) fn towards(p: Vec3, q: Vec3) -> Option<(Vec3, f64)> {
    let d = q - p;
    let distance = d.length();
    (distance > 0.0 && distance.is_finite()).then(|| (d / distance, distance))
}
