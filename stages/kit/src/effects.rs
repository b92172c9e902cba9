//! Which effects of light transport a scene calls for, and which object, light or setting does so.
//!
//! A renderer has to simulate only these. Leaving out the others changes no picture.

use crate::{Light, LitScene, Material};

/// An effect of light transport that a scene may call for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Effect {
    /// Direct light: shadow rays and hemisphere rays.
    DirectLight,
    /// Light along rays that miss everything: skies and environment maps.
    Background,
    /// Indirect light: rays that leave a surface in a direction drawn from its BSDF.
    Bounces,
    /// Perfect mirrors.
    Mirror,
    /// Boundaries that refract light and reflect none.
    Refraction,
    /// Glass, which reflects and refracts by Fresnel's equations.
    Fresnel,
    /// Rough mirrors.
    Glossy,
    /// Textures on surfaces.
    Texture,
    /// Depth of field: a thin lens instead of a pinhole.
    Lens,
}

impl Effect {
    /// All effects, in the order of a table.
    pub const ALL: [Effect; 9] = [
        Effect::DirectLight,
        Effect::Background,
        Effect::Bounces,
        Effect::Mirror,
        Effect::Refraction,
        Effect::Fresnel,
        Effect::Glossy,
        Effect::Texture,
        Effect::Lens,
    ];

    /// The effect's name in a table.
    pub fn name(self) -> &'static str {
        match self {
            Effect::DirectLight => "direct light",
            Effect::Background => "background",
            Effect::Bounces => "bounces",
            Effect::Mirror => "mirror",
            Effect::Refraction => "refraction",
            Effect::Fresnel => "glass (Fresnel)",
            Effect::Glossy => "glossy",
            Effect::Texture => "textures",
            Effect::Lens => "lens",
        }
    }

    /// The name of the operation that is counted when the effect is simulated.
    pub fn operation(self) -> &'static str {
        match self {
            Effect::DirectLight => "rays towards light",
            Effect::Background => "rays that miss all",
            Effect::Bounces => "bounces",
            Effect::Mirror => "reflections",
            Effect::Refraction => "refractions",
            Effect::Fresnel => "Fresnel terms",
            Effect::Glossy => "microfacet terms",
            Effect::Texture => "texture lookups",
            Effect::Lens => "lens samples",
        }
    }
}

/// The number of operations of each effect.
///
/// ```
/// use kit::effects::{Effect, EffectCounts};
/// let mut counts = [0; Effect::ALL.len()];
/// counts[Effect::Lens as usize] = 7;
/// let counts = EffectCounts::from(counts);
/// assert_eq!((counts + counts).of(Effect::Lens), 14);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EffectCounts([u64; Effect::ALL.len()]);

impl From<[u64; Effect::ALL.len()]> for EffectCounts {
    /// From the counts in the order of [`Effect::ALL`].
    fn from(counts: [u64; Effect::ALL.len()]) -> EffectCounts {
        EffectCounts(counts)
    }
}

impl EffectCounts {
    /// The number of operations of `effect`.
    pub fn of(&self, effect: Effect) -> u64 {
        self.0[effect as usize]
    }
}

impl std::ops::Add for EffectCounts {
    type Output = EffectCounts;
    fn add(self, other: EffectCounts) -> EffectCounts {
        EffectCounts(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}

impl std::iter::Sum for EffectCounts {
    fn sum<I: Iterator<Item = EffectCounts>>(counts: I) -> EffectCounts {
        counts.fold(EffectCounts::default(), std::ops::Add::add)
    }
}

/// What calls for an effect.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause {
    /// An object of the scene, by name.
    Object(String),
    /// A light of the scene, by name.
    Light(String),
    /// A setting of the renderer.
    Setting(Setting),
}

/// A setting of the renderer that calls for an effect, with its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// [`EffectSettings::max_depth`].
    MaxDepth(u32),
    /// [`EffectSettings::lens_radius`].
    LensRadius(f64),
    /// [`EffectSettings::environment`].
    Environment,
}

/// An effect and what calls for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirement {
    /// The effect.
    pub effect: Effect,
    /// What calls for it. Empty if nothing does.
    pub causes: Vec<Cause>,
}

impl Requirement {
    /// Whether anything calls for the effect.
    pub fn is_called_for(&self) -> bool {
        !self.causes.is_empty()
    }
}

/// The settings of a renderer that may call for effects.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EffectSettings {
    /// The largest number of rays on a path: 0 is emission only, 1 is direct light.
    pub max_depth: u32,
    /// Radius of the lens in scene units; 0 is a pinhole.
    pub lens_radius: f64,
    /// Whether there is an environment map that is not from the scene file.
    pub environment: bool,
}

impl LitScene {
    /// For every effect, in the order of [`Effect::ALL`], what in the scene or the settings calls
    /// for it.
    pub fn effects(&self, settings: EffectSettings) -> Vec<Requirement> {
        Effect::ALL
            .into_iter()
            .map(|effect| Requirement {
                effect,
                causes: self.causes(effect, settings),
            })
            .collect()
    }

    fn causes(&self, effect: Effect, settings: EffectSettings) -> Vec<Cause> {
        let objects =
            |calls: fn(&Material) -> bool| self.objects_with(|_, material| calls(material));
        let lights = |calls: fn(&Light) -> bool| {
            let lights = self
                .scene
                .lights
                .iter()
                .filter(move |named| calls(&named.light));
            lights.map(|named| Cause::Light(named.name.clone()))
        };
        let environment = settings
            .environment
            .then_some(Cause::Setting(Setting::Environment));
        let depth = settings.max_depth;
        match effect {
            Effect::DirectLight if depth == 0 => Vec::new(),
            Effect::DirectLight => lights(|light| !matches!(light, Light::Area { .. }))
                .chain(objects(|m| !m.emission().is_black()))
                .chain(environment)
                .collect(),
            Effect::Background => lights(|light| matches!(light, Light::Hemisphere { .. }))
                .chain(environment)
                .collect(),
            Effect::Lens if settings.lens_radius > 0.0 => {
                vec![Cause::Setting(Setting::LensRadius(settings.lens_radius))]
            }
            Effect::Lens => Vec::new(),
            // Surfaces show something only if they are lit.
            _ if depth == 0 || !self.has_light() => Vec::new(),
            Effect::Bounces if depth == 1 => Vec::new(),
            Effect::Bounces => vec![Cause::Setting(Setting::MaxDepth(depth))],
            Effect::Mirror if depth == 1 => Vec::new(),
            Effect::Mirror => objects(|m| matches!(m, Material::Mirror { .. })),
            // Direct light shows rough glass; smooth glass needs a second ray.
            Effect::Refraction if depth == 1 => {
                objects(|m| matches!(m, Material::Refraction { .. }) && !m.is_delta())
            }
            Effect::Refraction => objects(|m| matches!(m, Material::Refraction { .. })),
            Effect::Fresnel if depth == 1 => {
                objects(|m| matches!(m, Material::Glass { .. }) && !m.is_delta())
            }
            Effect::Fresnel => objects(|m| matches!(m, Material::Glass { .. })),
            Effect::Glossy => objects(|m| matches!(m, Material::Glossy { .. })),
            Effect::Texture => {
                let textures = &self.scene.textures;
                self.objects_with(|material, _| textures.of_material(material).is_some())
            }
        }
    }

    /// The objects with at least one primitive whose material, given by number and value, `calls`
    /// for an effect.
    fn objects_with(&self, calls: impl Fn(u32, &Material) -> bool) -> Vec<Cause> {
        let scene = &self.scene;
        let mut has_primitives = vec![false; scene.objects.len()];
        for &object in &scene.object_of {
            has_primitives[object as usize] = true;
        }
        let objects = scene.objects.iter().zip(has_primitives);
        objects
            .filter(|(o, has_primitives)| {
                *has_primitives && calls(o.material, &scene.materials[o.material as usize].material)
            })
            .map(|(o, _)| Cause::Object(o.name.clone()))
            .collect()
    }
}
