//! The scattering of surfaces that the driver gives.

use kit::{BsdfSample, Material, Scattering, Spectrum, Vec2, Vec3};

pub(crate) struct Given<'a>(pub(crate) &'a dyn Scattering);

impl Scattering for Given<'_> {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        self.0.f(material, wo, wi)
    }

    fn pdf(&self, material: &Material, wo: Vec3, wi: Vec3) -> f64 {
        self.0.pdf(material, wo, wi)
    }

    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
        self.0.sample(material, wo, u, choice)
    }
}
