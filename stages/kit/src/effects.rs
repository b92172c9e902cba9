//! What a scene asks of a renderer, and who in it asks.
//!
//! Only what is called for need be simulated. The rest costs nothing, and leaving it out changes no picture.

use crate::{LitScene, Material};

/// A part of light transport that a scene may or may not need.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Effect {
    /// Shadow rays and hemisphere rays: light that comes straight from its source.
    DirectLight,
    /// Light from where nothing is hit: skies and environment maps.
    Background,
    /// Rays that go on from a surface.
    Bounces,
    /// Perfect mirrors.
    Mirror,
    /// Boundaries that bend light without reflecting any.
    Refraction,
    /// Fresnel's equations: glass.
    Fresnel,
    /// Rough mirrors.
    Glossy,
    /// Pictures on surfaces.
    Texture,
    /// Depth of field.
    Lens,
}

impl Effect {
    /// All of them, in the order in which they are listed.
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

    /// What it is called in a table.
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

    /// What is counted when it is simulated.
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

/// How often each effect was simulated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EffectCounts([u64; Effect::ALL.len()]);

impl From<[u64; Effect::ALL.len()]> for EffectCounts {
    /// In the order of [`Effect::ALL`].
    fn from(counts: [u64; Effect::ALL.len()]) -> EffectCounts {
        EffectCounts(counts)
    }
}

impl EffectCounts {
    /// How many operations there were.
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

/// Whether an effect is called for, and by what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// The effect.
    pub effect: Effect,
    /// What calls for it: objects, lights and flags by name. Empty if nothing does.
    pub because: Vec<String>,
}

impl Call {
    /// Whether anything calls for it.
    pub fn is_called_for(&self) -> bool {
        !self.because.is_empty()
    }
}

/// What was asked for beside the scene: flags that call for effects.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Asked {
    /// The ray depth, `-m`.
    pub max_depth: u32,
    /// Radius of the lens; 0 is a pinhole.
    pub lens_radius: f64,
    /// Whether the environment comes from a flag, `-e`.
    pub environment: bool,
}

impl LitScene {
    /// For every effect, in the order of [`Effect::ALL`], what in the scene or among the flags calls for it.
    pub fn effects(&self, asked: Asked) -> Vec<Call> {
        Effect::ALL
            .into_iter()
            .map(|effect| Call {
                effect,
                because: self.callers(effect, asked),
            })
            .collect()
    }

    fn callers(&self, effect: Effect, asked: Asked) -> Vec<String> {
        let objects =
            |calls: fn(&Material) -> bool| self.objects_with(|_, material| calls(material));
        let lights = |calls: fn(&crate::Light) -> bool| {
            let lights = self
                .scene
                .lights
                .iter()
                .filter(move |named| calls(&named.light));
            lights.map(|named| format!("light {}", named.name))
        };
        let environment = asked.environment.then(|| "flag -e".to_owned());
        match effect {
            Effect::DirectLight if asked.max_depth == 0 => Vec::new(),
            Effect::DirectLight => lights(|light| !matches!(light, crate::Light::Area { .. }))
                .chain(objects(|m| !m.emission().is_black()))
                .chain(environment)
                .collect(),
            Effect::Background => lights(|light| matches!(light, crate::Light::Hemisphere { .. }))
                .chain(environment)
                .collect(),
            Effect::Bounces if asked.max_depth >= 2 && self.has_light() => {
                vec![format!("flag -m {}", asked.max_depth)]
            }
            // Without light or a second ray no bounce finds anything.
            Effect::Mirror if asked.max_depth < 2 || !self.has_light() => Vec::new(),
            Effect::Bounces => Vec::new(),
            Effect::Mirror => objects(|m| matches!(m, Material::Mirror { .. })),
            Effect::Refraction | Effect::Fresnel | Effect::Glossy
                if asked.max_depth == 0 || !self.has_light() =>
            {
                Vec::new()
            }
            // Direct light shows rough glass, and only a second ray what smooth glass shows.
            Effect::Refraction if asked.max_depth == 1 => {
                objects(|m| matches!(m, Material::Refraction { .. }) && !m.is_delta())
            }
            Effect::Fresnel if asked.max_depth == 1 => {
                objects(|m| matches!(m, Material::Glass { .. }) && !m.is_delta())
            }
            Effect::Refraction => objects(|m| matches!(m, Material::Refraction { .. })),
            Effect::Fresnel => objects(|m| matches!(m, Material::Glass { .. })),
            Effect::Glossy => objects(|m| matches!(m, Material::Glossy { .. })),
            Effect::Texture if asked.max_depth == 0 || !self.has_light() => Vec::new(),
            Effect::Texture => {
                let textures = &self.scene.textures;
                self.objects_with(|material, _| textures.of_material(material).is_some())
            }
            Effect::Lens if asked.lens_radius > 0.0 => vec!["flag --lens-radius".to_owned()],
            Effect::Lens => Vec::new(),
        }
    }

    /// The names of the objects whose material calls: its number, and what it is.
    fn objects_with(&self, calls: impl Fn(u32, &Material) -> bool) -> Vec<String> {
        let scene = &self.scene;
        let mut shown = vec![false; scene.objects.len()];
        for &object in &scene.object_of {
            shown[object as usize] = true;
        }
        let objects = scene.objects.iter().zip(shown);
        objects
            .filter(|(o, shown)| {
                *shown && calls(o.material, &scene.materials[o.material as usize].material)
            })
            .map(|(o, _)| format!("object {}", o.name))
            .collect()
    }
}
