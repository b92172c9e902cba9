//! Materials by how the packets shade them.

use crate::specular::SpecularMaterial;
use kit::{Material, Spectrum};

/// How the packets shade a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MaterialClass {
    /// Scatters light as a diffuse surface, in lanes.
    Diffuse,
    /// Emits light and ends the path, in lanes.
    Emission,
    /// Reflects or refracts light into one direction, in lanes.
    Specular,
    /// Anything else, which the scalar fallback shades path by path.
    Other,
}

/// The class of a material and its colour: the reflectance if diffuse, the radiance if it emits.
pub(crate) fn classify(material: &Material) -> (MaterialClass, Spectrum) {
    match *material {
        Material::Diffuse { reflectance } => (MaterialClass::Diffuse, reflectance),
        Material::Emission { radiance } => (MaterialClass::Emission, radiance),
        _ if SpecularMaterial::of(material).is_some() => (MaterialClass::Specular, Spectrum::BLACK),
        _ => (MaterialClass::Other, Spectrum::BLACK),
    }
}
