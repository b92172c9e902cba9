//! Mirrors and smooth glass, as `global::mirror_sample`, `refraction_sample` and `glass_sample`, in
//! the local space of the surface, where z is the normal.

use crate::real::{Mask, Real};
use crate::vec3::Vec3;

/// A material that scatters light into one or two directions only.
///
/// ```
/// use lanes::{Vec3, specular::SpecularMaterial};
/// let [zero, one] = [0.0, 1.0].map(|c: f64| Vec3 { x: c, y: c, z: c });
/// let mirror = SpecularMaterial {
///     reflectance: one,
///     transmittance: zero,
///     ior: 1.5,
///     has_fresnel: false,
///     mirrors: 1.0,
/// };
/// let sample = mirror.sample(Vec3 { x: 0.6, y: 0.0, z: 0.8 }, 0.9);
/// assert!(sample.exists && sample.wi.x == -0.6 && sample.wi.z == 0.8);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SpecularMaterial<R: Real> {
    /// The share of the light that is reflected if the surface reflects it all.
    pub reflectance: Vec3<R>,
    /// The share that is transmitted if the surface transmits it all.
    pub transmittance: Vec3<R>,
    /// The refractive index below the surface.
    pub ior: R,
    /// Whether Fresnel's equations divide the light; else [`SpecularMaterial::mirrors`] does.
    pub has_fresnel: R::Mask,
    /// Without Fresnel's equations: 1 for a mirror, 0 for a surface that only refracts.
    pub mirrors: R,
}

/// A sampled direction.
#[derive(Clone, Copy, Debug)]
pub struct SpecularSample<R: Real> {
    /// Whether there is one.
    pub exists: R::Mask,
    /// The unit direction.
    pub wi: Vec3<R>,
    /// The weight of the path along it: `f · |cos θ| / pdf`.
    pub weight: Vec3<R>,
}

impl<R: Real> SpecularMaterial<R> {
    /// Samples a direction for the viewer's direction `wo`; `choice` in [0, 1) chooses between
    /// reflection and refraction.
    ///
    /// A mirror is glass with a Fresnel reflectance of 1, and a surface that only refracts one with
    /// 0: products with 1 change no bits.
    #[inline(always)]
    pub fn sample(&self, wo: Vec3<R>, choice: R) -> SpecularSample<R> {
        let (zero, one) = (choice.constant(0.0), choice.constant(1.0));
        let eta = zero.less(wo.z).choose(one / self.ior, self.ior);
        let fresnel = fresnel_dielectric(wo.z, eta);
        let share = self.has_fresnel.choose(fresnel, self.mirrors);
        let is_reflected = choice.less(share);
        let pdf = is_reflected.choose(share, one - share);

        // 1 - η² sin² θo.
        let cos2_i = eta * eta * wo.z * wo.z + (one - eta) * (one + eta);
        let refracted = Vec3 {
            x: -eta * wo.x,
            y: -eta * wo.y,
            z: -cos2_i.sqrt().copysign(wo.z),
        };
        let refracted = refracted * (one / refracted.length());
        let reflected = Vec3 {
            x: -wo.x,
            y: -wo.y,
            z: wo.z,
        };
        let wi = reflected.masked_or(is_reflected, refracted);

        let cos = wi.z.abs();
        let f = (self.reflectance / cos)
            .masked_or(is_reflected, self.transmittance * (eta * eta / cos));
        let is_in_plane = wo.z.equals(zero);
        let is_total = !is_reflected & cos2_i.at_most(zero);
        SpecularSample {
            exists: !(is_in_plane | is_total),
            wi,
            weight: f * pdf * (cos / pdf),
        }
    }
}

/// The share of the light that is reflected, as `global::fresnel_dielectric`; `eta` is the relative
/// refractive index.
#[inline(always)]
pub fn fresnel_dielectric<R: Real>(cos: R, eta: R) -> R {
    let (zero, one) = (cos.constant(0.0), cos.constant(1.0));
    let cos_i = cos.abs().min(one);
    let cos2_t = eta * eta * cos_i * cos_i + (one - eta) * (one + eta);
    let cos_t = cos2_t.sqrt();
    let parallel = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    let perpendicular = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let share = (parallel * parallel + perpendicular * perpendicular) * cos.constant(0.5);
    let is_total = cos_i.equals(zero) | cos2_t.at_most(zero);
    is_total.choose(one, share)
}
