//! What surfaces are made of: the numbers of a scene file, no light transport.

use crate::Spectrum;

/// A surface's way of scattering light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// Matte: the same radiance in every direction (Lambert).
    Diffuse {
        /// Share of light that leaves again, per channel, in [0, 1].
        reflectance: Spectrum,
    },
    /// Gives light and reflects none.
    Emission {
        /// Emitted radiance, the same in every direction of the front side.
        radiance: Spectrum,
    },
    /// A perfect mirror.
    Mirror {
        /// Share of light that leaves again, per channel, in [0, 1].
        reflectance: Spectrum,
    },
    /// A rough mirror.
    Glossy {
        /// Share of light that leaves again, per channel, in [0, 1].
        reflectance: Spectrum,
        /// Phong exponent, `>= 0`: larger is sharper.
        shininess: f64,
    },
    /// A boundary that refracts without reflecting.
    Refraction {
        /// Share of light that passes, per channel, in [0, 1].
        transmittance: Spectrum,
        /// Microfacet roughness, `>= 0`; 0 is smooth.
        roughness: f64,
        /// Index of refraction of the inside over that of the outside.
        ior: f64,
    },
    /// A boundary that reflects and refracts by Fresnel's equations.
    Glass {
        /// Tint of what is reflected, per channel, in [0, 1].
        reflectance: Spectrum,
        /// Tint of what passes, per channel, in [0, 1].
        transmittance: Spectrum,
        /// Microfacet roughness, `>= 0`; 0 is smooth.
        roughness: f64,
        /// Index of refraction of the inside over that of the outside.
        ior: f64,
    },
}

/// From this roughness on glass is rough: less spreads light by less than a pixel of any camera here shows, a twentieth of a
/// degree. Glass of index 1 is not there, however rough.
const ROUGH: f64 = 1e-3;

impl Material {
    /// The radiance that the surface gives by itself.
    pub fn emission(&self) -> Spectrum {
        match self {
            Material::Emission { radiance } => *radiance,
            _ => Spectrum::BLACK,
        }
    }

    /// Whether light goes from one side of the surface to the other.
    pub fn lets_light_through(&self) -> bool {
        matches!(self, Material::Refraction { .. } | Material::Glass { .. })
    }

    /// Whether light leaves in finitely many directions only, so that no direction chosen without the surface is
    /// ever the right one: [`Scattering::f`](crate::Scattering::f) is black and only sampling finds them.
    pub fn is_delta(&self) -> bool {
        match *self {
            Material::Mirror { .. } => true,
            Material::Refraction { roughness, ior, .. }
            | Material::Glass { roughness, ior, .. } => roughness < ROUGH || ior == 1.0,
            _ => false,
        }
    }
}
