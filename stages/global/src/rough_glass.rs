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
mod tests {
    use super::*;
    use crate::{reflect, refract};
    use kit::statistics::{sidak, smallest_sure_bias, two_sided};
    use kit::{PixelSampler, Tally, chi_square, warp};

    fn glass(roughness: f64) -> RoughGlass {
        RoughGlass {
            reflectance: Some(Spectrum::WHITE),
            transmittance: Spectrum::WHITE,
            roughness,
            ior: 1.5,
        }
    }

    fn refraction(roughness: f64) -> RoughGlass {
        RoughGlass {
            reflectance: None,
            ..glass(roughness)
        }
    }

    fn views() -> [Vec3; 5] {
        [
            Vec3::Z,
            -Vec3::Z,
            Vec3::new(0.48, -0.6, 0.64),
            Vec3::new(-0.6, 0.48, -0.64),
            Vec3::new(0.0, 0.99, -0.141),
        ]
        .map(Vec3::normalize)
    }

    fn drawn(
        glass: RoughGlass,
        wo: Vec3,
        count: usize,
    ) -> impl Iterator<Item = Option<BsdfSample>> {
        let mut numbers = PixelSampler::new(0, 0, 13);
        (0..count).map(move |_| {
            let u = numbers.get_sample();
            glass.sample(wo, u, numbers.next_1d())
        })
    }

    /// Hard case 89. All false alarms together have a chance of 1e-6, a deviation of 10 % (root mean square) is sure to be
    /// seen; another roughness is. Smoother glass has a peak that is narrower than the cells are integrated by.
    #[test]
    fn samples_fall_where_the_pdf_says() {
        let alarm = sidak(1e-6, 20);
        for roughness in [0.7, 1.0] {
            for wo in views() {
                for glass in [glass(roughness), refraction(roughness)] {
                    let fit_to = |other: RoughGlass| {
                        let sample = |u, choice| glass.sample(wo, u, choice).map(|s| s.wi);
                        chi_square::fit_samples(50_000, 13, sample, |wi| other.pdf(wo, wi))
                    };
                    let fit = fit_to(glass);
                    assert!(fit.p > alarm, "{glass:?} from {wo}: {fit:?}");
                    assert!(fit.smallest_sure_deviation(alarm) < 0.1);
                    let other = RoughGlass {
                        roughness: 0.7 * roughness,
                        ..glass
                    };
                    assert!(fit_to(other).p < alarm, "{glass:?} from {wo}");
                }
            }
        }
    }

    /// Hard case 83. White glass never sends on more light than comes in, and all of it as it gets smooth. Radiance is counted
    /// without the squeeze of η².
    #[test]
    fn a_furnace_is_not_outshone() {
        let sent_on = |glass: RoughGlass, wo: Vec3| {
            let light = drawn(glass, wo, 20_000).map(|sample| {
                sample.map_or(0.0, |s| {
                    let eta = glass.index(wo);
                    let squeeze = if s.wi.z * wo.z < 0.0 { eta * eta } else { 1.0 };
                    s.weight().g / squeeze
                })
            });
            light.collect::<Tally>().mean()
        };
        for wo in views() {
            for roughness in [0.001, 0.1, 0.5, 1.0, 7.0] {
                let all = sent_on(glass(roughness), wo);
                assert!((0.3..=1.0 + 1e-9).contains(&all), "{roughness} {wo}: {all}");
            }
            assert!(sent_on(glass(0.001), wo) > 0.99);
        }
        assert!(sent_on(refraction(0.001), Vec3::Z) > 0.99);
        // Beyond the critical angle nothing passes.
        assert!(sent_on(refraction(0.001), views()[4]) < 0.01);
    }

    /// Light runs the same way back, but for the squeeze.
    #[test]
    fn light_runs_both_ways() {
        let mut numbers = PixelSampler::new(0, 0, 1);
        let mut passed = 0;
        for _ in 0..2000 {
            let [a, b] = [numbers.get_sample(), numbers.next_2d()].map(warp::uniform_sphere);
            let glass = glass(0.5);
            let (there, back) = (glass.f(a, b).g, glass.f(b, a).g);
            let eta = if a.z * b.z < 0.0 { glass.index(a) } else { 1.0 };
            passed += u32::from(there > 0.0 && eta != 1.0);
            assert!((there - back * eta * eta).abs() <= 1e-9 * there.abs());
        }
        assert!(passed > 100);
    }

    /// The estimate by samples equals the integral over all directions: f and pdf belong together. A bias of 20 % is sure to
    /// be seen.
    #[test]
    fn the_weight_of_samples_is_the_integral_of_f() {
        let alarm = sidak(1e-6, 5);
        for wo in views() {
            let glass = glass(0.6);
            let weights = drawn(glass, wo, 200_000).map(|s| s.map_or(0.0, |s| s.weight().g));
            let by_samples: Tally = weights.collect();
            let mut numbers = PixelSampler::new(0, 0, 3);
            let uniformly: Tally = (0..200_000)
                .map(|_| {
                    let wi = warp::uniform_sphere(numbers.get_sample());
                    glass.f(wo, wi).g * wi.z.abs() * 4.0 * std::f64::consts::PI
                })
                .collect();
            let p = two_sided(uniformly.z_between(&by_samples));
            assert!(p > alarm, "{} {}", by_samples.mean(), uniformly.mean());
            let sure = smallest_sure_bias(uniformly.standard_error(), alarm);
            assert!(sure < 0.2 * by_samples.mean(), "{wo}: {sure}");
        }
    }

    #[test]
    fn nearly_smooth_glass_is_nearly_smooth() {
        for wo in views() {
            let mut far = 0;
            for sample in drawn(glass(0.001), wo, 1000).flatten() {
                let smooth = if sample.wi.z * wo.z > 0.0 {
                    Some(reflect(wo))
                } else {
                    refract(wo, 1.5)
                };
                let off = smooth.map_or(2.0, |smooth| (sample.wi - smooth).length());
                far += u32::from(off > 0.1);
            }
            // GGX has long tails: a few facets in a thousand are turned by fifty times the roughness.
            assert!(far < 10, "{wo}: {far}");
        }
    }

    /// Hard case 75.
    #[test]
    fn in_the_plane_of_the_surface_nothing_leaves() {
        let glass = glass(0.5);
        assert_eq!(glass.sample(Vec3::X, Vec2::splat(0.5), 0.5), None);
        assert!(glass.f(Vec3::X, Vec3::Z).is_black() && glass.f(Vec3::Z, Vec3::X).is_black());
        assert_eq!(glass.pdf(Vec3::X, Vec3::Z), 0.0);
    }
}
// END SOLUTION(part4.task1)
