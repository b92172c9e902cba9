//! Beyond the course: rough glass.
//!
//! A boundary of microfacets, each of which reflects and refracts like smooth glass. Equations 20
//! and 21 of Walter, Marschner, Li, Torrance: "Microfacet models for refraction through rough
//! surfaces", EGSR 2007. η is the index of refraction of the side of `wo` divided by that of the
//! side of `wi`. The BSDF of facets with the normal `h` is:
//!
//! ```text
//! reflected   F · D(h) · G · (wo·h) / |cos θo cos θi| · 1 / (4 wo·h)
//! refracted   (1 - F) · D(h) · G · (wo·h) / |cos θo cos θi| · η² |wi·h| / (η wo·h + wi·h)²
//!
//! reflected   h ~ wo + wi
//! refracted   h ~ -(η wo + wi)
//! ```
//!
//! The last factor of each is the Jacobian of `h` with respect to `wi`, for refracted radiance
//! times η² (see [`crate::refraction_sample`]). Light that hits more than one facet is lost.
//! Directions are unit vectors in the local space of the surface; the normal is +z and points to
//! the outside.

use crate::fresnel_dielectric;
// BEGIN SOLUTION(part4.task1)
use crate::microfacets::sample_visible;
// END SOLUTION(part4.task1)

use crate::microfacets::{MIN_ALPHA, distribution, lambda};
use kit::{BsdfSample, Spectrum, Vec2, Vec3};

/// A rough boundary between two dielectrics. Its index of refraction is not 1, because there would
/// be no boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughGlass {
    /// Colour of the reflection. `None` if nothing is reflected, and all light that can be is
    /// refracted.
    pub reflectance: Option<Spectrum>,
    /// Colour of the transmission.
    pub transmittance: Spectrum,
    /// Walter's α of GGX, about the slope of the facets. Values above 1 count as 1.
    pub roughness: f64,
    /// Index of refraction of the inside divided by that of the outside.
    pub ior: f64,
}

/// A reflection or refraction at a facet, from `wi` to `wo`.
struct FacetEvent {
    /// Normal of the facet.
    h: Vec3,
    /// Cosine of the angle between `wo` and `h`, above 0.
    cos_o: f64,
    /// Fraction of the light that is reflected, or refracted.
    fraction: f64,
    /// The Jacobian: solid angle of `h` divided by that of `wi`.
    jacobian: f64,
    /// Colour and radiance scale of the event, without `fraction`.
    tint: Spectrum,
}

impl RoughGlass {
    /// The BSDF in 1/sr, for `wi` on either side.
    pub fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.event(wo, wi)
            .map_or(Spectrum::BLACK, |event| self.f_of(&event, wo, wi))
    }

    /// The density with which [`RoughGlass::sample`] samples `wi`, in 1/sr.
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f64 {
        self.event(wo, wi)
            .map_or(0.0, |event| self.pdf_of(&event, wo))
    }

    /// Samples a direction: samples a facet that is visible from `wo` with `u`, uniform in [0, 1)²,
    /// and selects reflection or refraction with `choice`, uniform in [0, 1).
    ///
    /// `None` if `wo` is in the plane of the surface, or if the direction leads to another facet:
    /// that light is lost.
    pub fn sample(&self, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
        // BEGIN SOLUTION(part4.task1)
        if wo.z == 0.0 {
            return None;
        }
        let up = flipped(wo, wo);
        let h = sample_visible(up, self.alpha(), u)?;
        let (cos_o, eta) = (up.dot(h), self.index(wo));
        let reflects = choice < self.fresnel(cos_o, eta);
        let up_wi = if reflects {
            2.0 * cos_o * h - up
        } else {
            let cos2_i = 1.0 - eta * eta * (1.0 - cos_o * cos_o);
            if cos2_i <= 0.0 {
                return None;
            }
            (eta * cos_o - cos2_i.sqrt()) * h - eta * up
        };
        if (up_wi.z > 0.0) != reflects {
            return None;
        }
        let wi = flipped(wo, up_wi.normalize());
        let event = self.event(wo, wi)?;
        let (f, pdf) = (self.f_of(&event, wo, wi), self.pdf_of(&event, wo));
        (pdf > 0.0 && pdf.is_finite() && f.is_finite()).then_some(BsdfSample {
            wi,
            f,
            pdf,
            delta: false,
        })
        // STUB: kit::hole!("part4.task1", self, wo, u, choice)
        // END SOLUTION(part4.task1)
    }

    fn f_of(&self, event: &FacetEvent, wo: Vec3, wi: Vec3) -> Spectrum {
        let a = self.alpha();
        let masking = 1.0 / ((1.0 + lambda(wo, a)) * (1.0 + lambda(wi, a)));
        let light =
            event.fraction * distribution(event.h, a) * masking * event.cos_o * event.jacobian;
        event.tint * (light / (wo.z * wi.z).abs())
    }

    fn pdf_of(&self, event: &FacetEvent, wo: Vec3) -> f64 {
        let a = self.alpha();
        let facet_pdf =
            distribution(event.h, a) * event.cos_o / ((1.0 + lambda(wo, a)) * wo.z.abs());
        event.fraction * facet_pdf * event.jacobian
    }

    fn alpha(&self) -> f64 {
        self.roughness.clamp(MIN_ALPHA, 1.0)
    }

    /// The index of refraction of the side of `wo` divided by that of the other side.
    fn index(&self, wo: Vec3) -> f64 {
        if wo.z > 0.0 { 1.0 / self.ior } else { self.ior }
    }

    /// The fraction of light that a facet reflects.
    fn fresnel(&self, cos: f64, eta: f64) -> f64 {
        self.reflectance
            .map_or(0.0, |_| fresnel_dielectric(cos, eta))
    }

    fn event(&self, wo: Vec3, wi: Vec3) -> Option<FacetEvent> {
        let eta = self.index(wo);
        let (up, up_wi) = (flipped(wo, wo), flipped(wo, wi));
        let reflects = up_wi.z > 0.0;
        if up.z == 0.0 || up_wi.z == 0.0 {
            return None;
        }
        let h = if reflects {
            up + up_wi
        } else {
            eta * up + up_wi
        }
        .try_normalize()?;
        let h = flipped(h, h);
        let (cos_o, cos_i) = (up.dot(h), up_wi.dot(h));
        if cos_o <= 0.0 || (cos_i > 0.0) != reflects {
            return None;
        }
        let reflected = self.fresnel(cos_o, eta);
        Some(if reflects {
            FacetEvent {
                h,
                cos_o,
                fraction: reflected,
                jacobian: 0.25 / cos_o,
                tint: self.reflectance?,
            }
        } else {
            let denominator = eta * cos_o + cos_i;
            FacetEvent {
                h,
                cos_o,
                fraction: 1.0 - reflected,
                jacobian: cos_i.abs() / (denominator * denominator),
                tint: self.transmittance * (eta * eta),
            }
        })
    }
}

/// `w`, mirrored to `-w` if `side` is below the surface.
fn flipped(side: Vec3, w: Vec3) -> Vec3 {
    if side.z < 0.0 { -w } else { w }
}

// BEGIN SOLUTION(part4.task1)
#[cfg(test)]
mod tests;
// END SOLUTION(part4.task1)
