//! Materials: the parameters from a scene file, without light transport.

use crate::Spectrum;

/// How a surface scatters or emits light.
///
/// ```
/// use kit::{Material, Spectrum};
/// let lamp = Material::Emission { radiance: Spectrum::grey(5.0) };
/// assert_eq!(lamp.emission(), Spectrum::grey(5.0));
/// assert!(!lamp.lets_light_through());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// Diffuse (Lambertian): the same radiance in every direction.
    Diffuse {
        /// Fraction of the light that is reflected, per channel, in [0, 1].
        reflectance: Spectrum,
    },
    /// Emits light and reflects none.
    Emission {
        /// Emitted radiance, the same in every direction of the front side.
        radiance: Spectrum,
    },
    /// A perfect mirror.
    Mirror {
        /// Fraction of the light that is reflected, per channel, in [0, 1].
        reflectance: Spectrum,
    },
    /// A glossy (rough) mirror.
    Glossy {
        /// Fraction of the light that is reflected, per channel, in [0, 1].
        reflectance: Spectrum,
        /// Phong exponent, `>= 0`. Larger values give sharper reflections.
        shininess: f64,
    },
    /// A dielectric boundary that refracts and does not reflect.
    Refraction {
        /// Fraction of the light that is transmitted, per channel, in [0, 1].
        transmittance: Spectrum,
        /// Microfacet roughness, `>= 0`; 0 is a smooth boundary.
        roughness: f64,
        /// Index of refraction of the inside divided by that of the outside.
        ior: f64,
    },
    /// A dielectric boundary that reflects and refracts by the Fresnel equations.
    Glass {
        /// Colour of the reflection, per channel, in [0, 1].
        reflectance: Spectrum,
        /// Colour of the transmission, per channel, in [0, 1].
        transmittance: Spectrum,
        /// Microfacet roughness, `>= 0`; 0 is a smooth boundary.
        roughness: f64,
        /// Index of refraction of the inside divided by that of the outside.
        ior: f64,
    },
}

/// Smallest roughness of rough glass. A smaller one spreads light by less than a twentieth of a
/// degree, which is less than a pixel of any camera here.
const MIN_ROUGHNESS: f64 = 1e-3;

impl Material {
    /// The emitted radiance; black if the material does not emit.
    pub fn emission(&self) -> Spectrum {
        match self {
            Material::Emission { radiance } => *radiance,
            _ => Spectrum::BLACK,
        }
    }

    /// Whether light passes from one side of the surface to the other.
    pub fn lets_light_through(&self) -> bool {
        matches!(self, Material::Refraction { .. } | Material::Glass { .. })
    }

    /// Whether the BSDF is a delta distribution: light leaves in finitely many directions only.
    /// [`Scattering::f`](crate::Scattering::f) is then black, and only
    /// [`Scattering::sample`](crate::Scattering::sample) finds these directions. Glass with an
    /// index of refraction of 1 counts as such whatever its roughness, because light passes it
    /// unchanged.
    pub fn is_delta(&self) -> bool {
        match *self {
            Material::Mirror { .. } => true,
            Material::Refraction { roughness, ior, .. }
            | Material::Glass { roughness, ior, .. } => roughness < MIN_ROUGHNESS || ior == 1.0,
            _ => false,
        }
    }
}
