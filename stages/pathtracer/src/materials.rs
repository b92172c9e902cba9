//! Scattering at surfaces: the BSDFs of the stages by material, with their operations counted.

use direct::{lambert_f, lambert_pdf, lambert_sample};
use global::{
    RoughGlass, glass_sample, glossy_f, glossy_pdf, glossy_sample, mirror_sample, refraction_sample,
};
use kit::effects::{Effect, EffectCounts};
use kit::shading_normal::Sides;
use kit::{BsdfSample, Material, Scattering, Scene, Spectrum, Vec2, Vec3};
use std::cell::Cell;
use std::hint::black_box;

/// Glass that is less rough spreads light by less than a degree or two: a sampled point of a lamp
/// is hardly ever in the reflection or refraction.
const NEARLY_SMOOTH: f64 = 0.03;

/// The first object in whose surface few samples meet lamps without `--mis`, so that a picture of
/// few samples is too dark: its name.
pub fn nearly_smooth(scene: &Scene) -> Option<&str> {
    let is_nearly_smooth = |material: &Material| match *material {
        Material::Glass { roughness, .. } | Material::Refraction { roughness, .. } => {
            roughness < NEARLY_SMOOTH && !material.is_delta()
        }
        Material::Glossy { shininess, .. } => shininess > 2.0 / (NEARLY_SMOOTH * NEARLY_SMOOTH),
        _ => false,
    };
    let mut objects = scene.objects.iter();
    let found = objects
        .find(|object| is_nearly_smooth(&scene.materials[object.material as usize].material))?;
    Some(&found.name)
}

/// Counts the operations of each effect in one tile.
#[derive(Debug)]
pub(crate) struct Materials {
    counts: [Cell<u64>; Effect::ALL.len()],
    /// Whether every effect runs, called for or not. The results of the others are discarded.
    forced: bool,
    /// Whether opaque surfaces have a soft terminator.
    soft: bool,
}

/// The materials at one point of a surface: the BSDFs of parts 3 and 4, and those beyond the
/// course.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MaterialsAt<'a> {
    materials: &'a Materials,
    place: Place,
}

/// What a material depends on besides directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// The texture colour, which diffuse surfaces multiply their reflectance by; else white.
    pub(crate) tint: Spectrum,
    pub(crate) sides: Sides,
}

impl Place {
    /// A surface without a texture, whose normals agree.
    pub(crate) const PLAIN: Place = Place {
        tint: Spectrum::WHITE,
        sides: Sides::FLAT,
    };
}

/// The materials along one path: at the last hit, whose place the owner of `place` sets.
pub(crate) struct PathMaterials<'a> {
    pub(crate) materials: &'a Materials,
    pub(crate) place: &'a Cell<Place>,
}

impl Materials {
    /// Counts from 0. With `forced`, every sample runs every effect; with `soft`, opaque surfaces
    /// have a soft terminator.
    pub(crate) fn new(forced: bool, soft: bool) -> Materials {
        Materials {
            counts: Default::default(),
            forced,
            soft,
        }
    }

    /// The materials at `place`.
    #[inline]
    pub(crate) fn at(&self, place: Place) -> MaterialsAt<'_> {
        MaterialsAt {
            materials: self,
            place,
        }
    }

    /// The operations so far.
    pub(crate) fn counts(&self) -> EffectCounts {
        EffectCounts::from(std::array::from_fn(|i| self.counts[i].get()))
    }

    /// Counts an operation of `effect`.
    #[inline]
    pub(crate) fn count(&self, effect: Effect) {
        self.count_more(effect, 1);
    }

    /// Counts `more` operations of `effect`.
    #[inline]
    pub(crate) fn count_more(&self, effect: Effect, more: u64) {
        self.counts[effect as usize].update(|count| count + more);
    }

    /// The parameters of rough glass; `None` for other materials. Counts an operation of its
    /// effect.
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

    /// Samples the other materials for the counts only.
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

impl MaterialsAt<'_> {
    /// `f` for light from `wi`, with a soft terminator if one is wanted.
    #[inline]
    fn softened(&self, f: Spectrum, material: &Material, wi: Vec3) -> Spectrum {
        if self.materials.soft && !material.is_delta() && !material.lets_light_through() {
            return f * self.place.sides.terminator(wi);
        }
        f
    }
}

impl Scattering for MaterialsAt<'_> {
    #[inline]
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        if self.place.sides.block(material, wo, wi) {
            return Spectrum::BLACK;
        }
        let f = match *material {
            Material::Diffuse { reflectance } => lambert_f(self.place.tint * reflectance, wo, wi),
            Material::Glossy {
                reflectance,
                shininess,
            } => {
                self.materials.count(Effect::Glossy);
                glossy_f(reflectance, shininess, wo, wi)
            }
            Material::Emission { .. } | Material::Mirror { .. } => Spectrum::BLACK,
            Material::Refraction { .. } | Material::Glass { .. } => self
                .materials
                .rough(material)
                .map_or(Spectrum::BLACK, |glass| glass.f(wo, wi)),
        };
        self.softened(f, material, wi)
    }

    #[inline]
    fn pdf(&self, material: &Material, wo: Vec3, wi: Vec3) -> f64 {
        match *material {
            Material::Diffuse { .. } => lambert_pdf(wo, wi),
            Material::Glossy { shininess, .. } => {
                self.materials.count(Effect::Glossy);
                glossy_pdf(shininess, wo, wi)
            }
            Material::Emission { .. } | Material::Mirror { .. } => 0.0,
            Material::Refraction { .. } | Material::Glass { .. } => self
                .materials
                .rough(material)
                .map_or(0.0, |glass| glass.pdf(wo, wi)),
        }
    }

    #[inline]
    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
        if self.materials.forced {
            self.materials.run_all(wo, u, choice);
        }
        if let Some(glass) = self.materials.rough(material) {
            return glass.sample(wo, u, choice);
        }
        let sample = match *material {
            Material::Diffuse { reflectance } => {
                lambert_sample(self.place.tint * reflectance, wo, u)
            }
            Material::Emission { .. } => None,
            Material::Mirror { reflectance } => {
                self.materials.count(Effect::Mirror);
                mirror_sample(reflectance, wo)
            }
            Material::Glossy {
                reflectance,
                shininess,
            } => {
                self.materials.count(Effect::Glossy);
                glossy_sample(reflectance, shininess, wo, u)
            }
            Material::Refraction {
                transmittance, ior, ..
            } => {
                self.materials.count(Effect::Refraction);
                refraction_sample(transmittance, ior, wo)
            }
            Material::Glass {
                reflectance,
                transmittance,
                ior,
                ..
            } => {
                self.materials.count(Effect::Fresnel);
                glass_sample(reflectance, transmittance, ior, wo, choice)
            }
        };
        let mut sample = sample?;
        sample.f = self.softened(sample.f, material, sample.wi);
        (!self.place.sides.block(material, wo, sample.wi)).then_some(sample)
    }
}

impl Scattering for PathMaterials<'_> {
    #[inline]
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        self.materials.at(self.place.get()).f(material, wo, wi)
    }

    #[inline]
    fn pdf(&self, material: &Material, wo: Vec3, wi: Vec3) -> f64 {
        self.materials.at(self.place.get()).pdf(material, wo, wi)
    }

    #[inline]
    fn sample(&self, material: &Material, wo: Vec3, u: Vec2, choice: f64) -> Option<BsdfSample> {
        let materials = self.materials.at(self.place.get());
        materials.sample(material, wo, u, choice)
    }
}
