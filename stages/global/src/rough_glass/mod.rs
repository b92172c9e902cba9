//! Beyond the course: rough glass.
//!
//! A boundary of `microfacets`, each of which reflects and refracts as smooth glass does (Walter, Marschner, Li,
//! Torrance: "Microfacet models for refraction through rough surfaces", EGSR 2007, equations 20 and 21). With the index
//! η of the side of `wo` over that of the side of `wi`, facets that face `h` send light from `wi` to `wo`:
//!
//! ```text
//! reflected   F · D(h) · G · (wo·h) / |cos θo cos θi| · 1 / (4 wo·h)                        h ~ wo + wi
//! refracted   (1 - F) · D(h) · G · (wo·h) / |cos θo cos θi| · η² |wi·h| / (η wo·h + wi·h)²  h ~ -(η wo + wi)
//! ```
//!
//! The last factor of each is how much `h` turns with `wi`, for radiance times η² on the way through (see
//! [`crate::refraction_sample`]). Light that meets more than one facet is lost. Directions are unit vectors in the local
//! space of the surface, the normal is +z and on the outside.

use crate::fresnel_dielectric;
// BEGIN SOLUTION(part4.task1)
use crate::microfacets::visible;
// END SOLUTION(part4.task1)

use crate::microfacets::{SMOOTHEST, facing, hidden};
use kit::{BsdfSample, Spectrum, Vec2, Vec3};

/// A rough boundary between two materials. Its index of refraction is not 1, where there is no boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughGlass {
    /// Tint of what is reflected; `None` if nothing is, and all that can be is refracted.
    pub reflectance: Option<Spectrum>,
    /// Tint of what passes.
    pub transmittance: Spectrum,
    /// Walter's α of GGX: about the slope of the facets. Above 1 counts as 1.
    pub roughness: f64,
    /// Index of refraction of the inside over that of the outside.
    pub ior: f64,
}

/// How light gets from `wi` to `wo`.
struct Way {
    /// Where the facets face that send it.
    h: Vec3,
    /// Cosine between `wo` and `h`, above 0.
    cos_o: f64,
    /// The share of light that goes this way.
    share: f64,
    /// Solid angle of `h` over that of `wi`.
    turns: f64,
    /// What arrives of the light, but for the share.
    arrives: Spectrum,
}

impl RoughGlass {
    /// The BSDF in 1/sr, for `wi` on either side.
    pub fn f(&self, wo: Vec3, wi: Vec3) -> Spectrum {
        self.way(wo, wi)
            .map_or(Spectrum::BLACK, |way| self.f_of(&way, wo, wi))
    }

    /// The density with which [`RoughGlass::sample`] draws `wi`, in 1/sr.
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f64 {
        self.way(wo, wi).map_or(0.0, |way| self.pdf_of(&way, wo))
    }

    /// Draws a facet that is seen from `wo` by `u`, uniform in [0, 1)², and by `choice`, uniform in [0, 1), whether it
    /// reflects or refracts. `None` if `wo` lies in the plane of the surface, or if the light goes from the facet to another
    /// one: it is lost.
    pub fn sample(&self, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
        // BEGIN SOLUTION(part4.task1)
        if wo.z == 0.0 {
            return None;
        }
        let up = above(wo, wo);
        let h = visible(up, self.alpha(), u)?;
        let (cos_o, eta) = (up.dot(h), self.index(wo));
        let reflects = choice < self.share(cos_o, eta);
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
        let wi = above(wo, up_wi.normalize());
        let way = self.way(wo, wi)?;
        let (f, pdf) = (self.f_of(&way, wo, wi), self.pdf_of(&way, wo));
        (pdf > 0.0 && pdf.is_finite() && f.is_finite()).then_some(BsdfSample {
            wi,
            f,
            pdf,
            delta: false,
        })
        // STUB: kit::hole!("part4.task1", self, wo, u, choice)
        // END SOLUTION(part4.task1)
    }

    fn f_of(&self, way: &Way, wo: Vec3, wi: Vec3) -> Spectrum {
        let a = self.alpha();
        let seen = 1.0 / ((1.0 + hidden(wo, a)) * (1.0 + hidden(wi, a)));
        let light = way.share * facing(way.h, a) * seen * way.cos_o * way.turns;
        way.arrives * (light / (wo.z * wi.z).abs())
    }

    fn pdf_of(&self, way: &Way, wo: Vec3) -> f64 {
        let a = self.alpha();
        let drawn = facing(way.h, a) * way.cos_o / ((1.0 + hidden(wo, a)) * wo.z.abs());
        way.share * drawn * way.turns
    }

    fn alpha(&self) -> f64 {
        self.roughness.clamp(SMOOTHEST, 1.0)
    }

    /// The index of the side of `wo` over that of the other side.
    fn index(&self, wo: Vec3) -> f64 {
        if wo.z > 0.0 { 1.0 / self.ior } else { self.ior }
    }

    /// The share of light that a facet reflects.
    fn share(&self, cos: f64, eta: f64) -> f64 {
        self.reflectance
            .map_or(0.0, |_| fresnel_dielectric(cos, eta))
    }

    fn way(&self, wo: Vec3, wi: Vec3) -> Option<Way> {
        let eta = self.index(wo);
        let (up, up_wi) = (above(wo, wo), above(wo, wi));
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
        let h = above(h, h);
        let (cos_o, cos_i) = (up.dot(h), up_wi.dot(h));
        if cos_o <= 0.0 || (cos_i > 0.0) != reflects {
            return None;
        }
        let share = self.share(cos_o, eta);
        Some(if reflects {
            Way {
                h,
                cos_o,
                share,
                turns: 0.25 / cos_o,
                arrives: self.reflectance?,
            }
        } else {
            let apart = eta * cos_o + cos_i;
            Way {
                h,
                cos_o,
                share: 1.0 - share,
                turns: cos_i.abs() / (apart * apart),
                arrives: self.transmittance * (eta * eta),
            }
        })
    }
}

/// `w` seen with the side of `side` up.
fn above(side: Vec3, w: Vec3) -> Vec3 {
    if side.z < 0.0 { -w } else { w }
}

// BEGIN SOLUTION(part4.task1)
#[cfg(test)]
mod tests;
// END SOLUTION(part4.task1)
