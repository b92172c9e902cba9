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

impl Material {
    /// The radiance that the surface gives by itself.
    pub fn emission(&self) -> Spectrum {
        match self {
            Material::Emission { radiance } => *radiance,
            _ => Spectrum::BLACK,
        }
    }

    /// Whether light leaves in finitely many directions only, so that no direction chosen without the surface is
    /// ever the right one: [`Scattering::f`](crate::Scattering::f) is black and only sampling finds them.
    pub fn is_delta(&self) -> bool {
        matches!(
            self,
            Material::Mirror { .. } | Material::Refraction { .. } | Material::Glass { .. }
        )
    }
}
