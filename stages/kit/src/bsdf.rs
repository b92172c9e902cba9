//! How light scatters at a surface: the words in which stages speak of it. The formulas are theirs.
//!
//! Directions are unit vectors in the local space of the surface's [`Frame`](crate::Frame) (the normal is +z)
//! and point away from the surface: `wo` to where the light goes, the viewer; `wi` to where it comes from.
//! The radiance that leaves is `Lo(wo) = ∫ f(wo, wi) · Li(wi) · |wi.z| dwi`.

use crate::{Material, Spectrum, Vec2, Vec3};

/// A direction drawn for incoming light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// Where light comes from: unit, in local space.
    pub wi: Vec3,
    /// Value of the BSDF, in 1/sr. If `delta` is set the factor in front of the delta function, such that
    /// `f · |wi.z| / pdf` is the share of the light that arrives.
    pub f: Spectrum,
    /// Probability density of `wi` with respect to solid angle, in 1/sr; if `delta` is set the probability
    /// of having chosen this direction among the few possible ones.
    pub pdf: f64,
    /// Whether `wi` is one of finitely many directions, as with a mirror.
    pub delta: bool,
}

impl BsdfSample {
    /// `f · |cos θ| / pdf`: the factor by which the radiance from `wi` counts in an estimate.
    #[inline]
    pub fn weight(&self) -> Spectrum {
        self.f * (self.wi.z.abs() / self.pdf)
    }
}

/// What surfaces do with light, material by material.
///
/// An integrator gets every answer from here: this is where the scattering functions of a scene come together,
/// and where they are counted.
pub trait Scattering {
    /// The BSDF `f(wo, wi)` in 1/sr. Black for mirrors and smooth glass: there is no chance that a direction
    /// chosen without them is the right one.
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum;

    /// The density with which [`Scattering::sample`] draws `wi`, in 1/sr. 0 for mirrors and smooth glass.
    fn pdf(&self, material: &Material, wo: Vec3, wi: Vec3) -> f64;

    /// Draws a direction for incoming light from `u`, uniform in [0, 1)², and `choice`, uniform in [0, 1), which
    /// decides between reflection and refraction. `None` if the surface lets no light leave along `wo`.
    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample>;
}
