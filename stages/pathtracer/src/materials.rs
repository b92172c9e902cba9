//! What each material does with light: the scattering functions of the stages, put together and counted.

use direct::{lambert_f, lambert_pdf, lambert_sample};
use global::{
    RoughGlass, glass_sample, glossy_f, glossy_pdf, glossy_sample, mirror_sample, refraction_sample,
};
use kit::effects::{Effect, EffectCounts};
use kit::{BsdfSample, Material, Scattering, Spectrum, Vec2, Vec3};
use std::cell::Cell;
use std::hint::black_box;

/// The scattering functions of parts 3 and 4, and those beyond the course.
#[derive(Debug)]
pub struct Materials {
    counts: [Cell<u64>; Effect::ALL.len()],
    /// What the texture of the surface at hand shows there; white without one.
    tint: Cell<Spectrum>,
    /// Whether effects run that nothing calls for. Their results are thrown away.
    forced: bool,
}

impl Materials {
    /// Materials that have not been asked anything yet; with `forced`, every sample runs every effect.
    pub fn new(forced: bool) -> Materials {
        Materials {
            counts: Default::default(),
            tint: Cell::new(Spectrum::WHITE),
            forced,
        }
    }

    /// What was asked so far.
    pub fn counts(&self) -> EffectCounts {
        EffectCounts::from(std::array::from_fn(|i| self.counts[i].get()))
    }

    /// Counts an operation of `effect`.
    #[inline]
    pub fn count(&self, effect: Effect) {
        self.count_more(effect, 1);
    }

    /// Counts `more` operations of `effect`.
    #[inline]
    pub fn count_more(&self, effect: Effect, more: u64) {
        self.counts[effect as usize].update(|count| count + more);
    }

    /// How matte surfaces are tinted now.
    pub(crate) fn tint(&self) -> Spectrum {
        self.tint.get()
    }

    /// From now on matte surfaces are tinted so, until they are told otherwise.
    #[inline]
    pub fn set_tint(&self, tint: Spectrum) {
        self.tint.set(tint);
    }

    /// The material as rough glass, if it is, which counts as an operation of its effect.
    #[inline]
    fn rough(&self, material: &Material) -> Option<RoughGlass> {
        let (reflectance, transmittance, roughness, ior, effect) = match *material {
            Material::Refraction {
                transmittance,
                roughness,
                ior,
            } => (None, transmittance, roughness, ior, Effect::Refraction),
            Material::Glass {
                reflectance,
                transmittance,
                roughness,
                ior,
            } => {
                let effect = Effect::Fresnel;
                (Some(reflectance), transmittance, roughness, ior, effect)
            }
            _ => return None,
        };
        if material.is_delta() {
            return None;
        }
        self.count(effect);
        Some(RoughGlass {
            reflectance,
            transmittance,
            roughness,
            ior,
        })
    }

    /// Runs what other materials would do, for nothing.
    fn run_all(&self, wo: Vec3, u: Vec2, choice: f64) {
        let white = Spectrum::WHITE;
        self.count(Effect::Mirror);
        black_box(mirror_sample(white, wo));
        self.count(Effect::Refraction);
        black_box(refraction_sample(white, 1.5, wo));
        self.count(Effect::Fresnel);
        black_box(glass_sample(white, white, 1.5, wo, choice));
        self.count(Effect::Glossy);
        black_box(glossy_sample(white, 10.0, wo, u));
    }
}

impl Scattering for Materials {
    #[inline]
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        match *material {
            Material::Diffuse { reflectance } => lambert_f(self.tint.get() * reflectance, wo, wi),
            Material::Glossy {
                reflectance,
                shininess,
            } => {
                self.count(Effect::Glossy);
                glossy_f(reflectance, shininess, wo, wi)
            }
            Material::Emission { .. } | Material::Mirror { .. } => Spectrum::BLACK,
            Material::Refraction { .. } | Material::Glass { .. } => self
                .rough(material)
                .map_or(Spectrum::BLACK, |glass| glass.f(wo, wi)),
        }
    }

    #[inline]
    fn pdf(&self, material: &Material, wo: Vec3, wi: Vec3) -> f64 {
        match *material {
            Material::Diffuse { .. } => lambert_pdf(wo, wi),
            Material::Glossy { shininess, .. } => {
                self.count(Effect::Glossy);
                glossy_pdf(shininess, wo, wi)
            }
            Material::Emission { .. } | Material::Mirror { .. } => 0.0,
            Material::Refraction { .. } | Material::Glass { .. } => {
                self.rough(material).map_or(0.0, |glass| glass.pdf(wo, wi))
            }
        }
    }

    #[inline]
    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
        if self.forced {
            self.run_all(wo, u, choice);
        }
        if let Some(glass) = self.rough(material) {
            return glass.sample(wo, u, choice);
        }
        match *material {
            Material::Diffuse { reflectance } => {
                lambert_sample(self.tint.get() * reflectance, wo, u)
            }
            Material::Emission { .. } => None,
            Material::Mirror { reflectance } => {
                self.count(Effect::Mirror);
                mirror_sample(reflectance, wo)
            }
            Material::Glossy {
                reflectance,
                shininess,
            } => {
                self.count(Effect::Glossy);
                glossy_sample(reflectance, shininess, wo, u)
            }
            Material::Refraction {
                transmittance, ior, ..
            } => {
                self.count(Effect::Refraction);
                refraction_sample(transmittance, ior, wo)
            }
            Material::Glass {
                reflectance,
                transmittance,
                ior,
                ..
            } => {
                self.count(Effect::Fresnel);
                glass_sample(reflectance, transmittance, ior, wo, choice)
            }
        }
    }
}
