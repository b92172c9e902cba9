//! Scattering at one point, as the stages compute it: for drawings of lobes.

use crate::materials::{Materials, Place};
use kit::{BsdfSample, Material, Scattering, Vec2, Vec3};

/// The density with which the stages sample `wi`, in 1/sr; 0 for mirrors and smooth glass.
/// Directions are unit vectors in the local space of the surface.
pub fn pdf(material: &Material, wo: Vec3, wi: Vec3) -> f64 {
    let materials = Materials::new(false, false);
    materials.at(Place::PLAIN).pdf(material, wo, wi)
}

/// A direction that the stages sample from `u` and `choice`, both uniform in [0, 1).
pub fn sample(material: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
    let materials = Materials::new(false, false);
    materials.at(Place::PLAIN).sample(material, wo, u, choice)
}
