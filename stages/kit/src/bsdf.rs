//! The interface between integrators and scattering functions (BSDFs).
//!
//! Directions are unit vectors in the local space of the surface's [`Frame`](crate::Frame), where
//! the normal is +z. Both point away from the surface: `wo` towards the viewer, `wi` towards the
//! incoming light. The reflected radiance is `Lo(wo) = ∫ f(wo, wi) · Li(wi) · |wi.z| dwi`.

use crate::{Material, Spectrum, Vec2, Vec3};

/// A sampled direction of incoming light.
///
/// ```
/// use kit::{BsdfSample, Spectrum, Vec3};
/// let mirror = BsdfSample {
///     wi: Vec3::new(0.6, 0.0, 0.8),
///     f: Spectrum::grey(0.9 / 0.8),
///     pdf: 1.0,
///     delta: true,
/// };
/// assert!((mirror.weight() - Spectrum::grey(0.9)).max_channel().abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// Direction towards the incoming light: unit, in local space.
    pub wi: Vec3,
    /// Value of the BSDF, in 1/sr. If `delta` is set: the factor in front of the delta function,
    /// scaled so that `f · |wi.z| / pdf` is the fraction of the incoming light that is scattered.
    pub f: Spectrum,
    /// Probability density of `wi` with respect to solid angle, in 1/sr. If `delta` is set: the
    /// probability with which this direction was chosen among the possible ones.
    pub pdf: f64,
    /// Whether `wi` comes from a delta distribution (one of finitely many directions), as with a
    /// mirror.
    pub delta: bool,
}

impl BsdfSample {
    /// `f · |cos θ| / pdf`: the weight of the radiance from `wi` in an estimate.
    #[inline]
    pub fn weight(&self) -> Spectrum {
        self.f * (self.wi.z.abs() / self.pdf)
    }
}

/// The scattering functions of all materials.
///
/// Integrators evaluate and sample BSDFs only through this trait. Implementations combine the
/// functions of the stages and count the calls.
pub trait Scattering {
    /// Evaluates the BSDF `f(wo, wi)`, in 1/sr. Black for mirrors and smooth glass: the probability
    /// that an independently chosen `wi` is the reflected or refracted direction is 0.
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum;

    /// The density with which [`Scattering::sample`] samples `wi`, in 1/sr. 0 for mirrors and
    /// smooth glass.
    fn pdf(&self, material: &Material, wo: Vec3, wi: Vec3) -> f64;

    /// Samples a direction of incoming light from `u`, uniform in [0, 1)², and `choice`, uniform in
    /// [0, 1), which selects reflection or refraction. `None` if the surface scatters no light into
    /// `wo`.
    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample>;
}
