//! Part 4: mirrors, glass and light that bounces.

use crate::light::{BsdfSample, Material};
use crate::work::{Ray, Xyz};
use serde::{Deserialize, Serialize};

/// One call of a function of `part4.task1`. Directions are in local space.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SpecularCall {
    /// `fresnel_dielectric`.
    Fresnel {
        /// Cosine to the normal.
        cos_i: f64,
        /// Index of the side that light comes from over that of the other.
        eta: f64,
    },
    /// `reflect`.
    Reflect {
        /// To the viewer.
        wo: Xyz,
    },
    /// `refract`.
    Refract {
        /// To the viewer.
        wo: Xyz,
        /// Index of the inside over that of the outside.
        ior: f64,
    },
    /// `mirror_sample`.
    Mirror {
        /// Tint of what is reflected.
        reflectance: Xyz,
        /// To the viewer.
        wo: Xyz,
    },
    /// `refraction_sample`.
    Refraction {
        /// Tint of what passes.
        transmittance: Xyz,
        /// Index of the inside over that of the outside.
        ior: f64,
        /// To the viewer.
        wo: Xyz,
    },
    /// `glass_sample`.
    Glass {
        /// Tint of what is reflected.
        reflectance: Xyz,
        /// Tint of what passes.
        transmittance: Xyz,
        /// Index of the inside over that of the outside.
        ior: f64,
        /// To the viewer.
        wo: Xyz,
        /// In [0, 1).
        choice: f64,
    },
}

/// What such a call answered.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SpecularAnswer {
    /// A share of the light.
    Share(f64),
    /// A direction, if there is one.
    Direction(Option<Xyz>),
    /// A sample, if there is one.
    Sample(Option<BsdfSample>),
}

/// A path whose every turn is written down: no intersection, no scattering, no light is computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScriptedPath {
    /// The ray that begins it.
    pub ray: Ray,
    /// The most rays.
    pub max_depth: u32,
    /// The surfaces that rays hit, call after call; then they hit nothing.
    pub steps: Vec<Step>,
    /// The radiance of what a ray sees that hits nothing.
    pub background: Xyz,
    /// Seed of the sampler.
    pub seed: u64,
}

/// A surface on a path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// Where it is hit.
    pub p: Xyz,
    /// Its normal.
    pub n: Xyz,
    /// What it is made of.
    pub material: Material,
    /// What `direct` answers there.
    pub direct: Xyz,
    /// What `Scattering::sample` answers there.
    pub sample: Option<BsdfSample>,
    /// What `roulette` multiplies the throughput by; `None` ends the path.
    pub roulette: Option<f64>,
}

/// What a path asked its neighbours, and the radiance in the end.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PathAnswer {
    /// The radiance.
    pub radiance: Xyz,
    /// Rays that were traced.
    pub rays: Vec<Ray>,
    /// Surfaces that direct light was asked of, and the direction to the viewer.
    pub direct: Vec<(u32, Xyz)>,
    /// Surfaces that a direction was drawn at: the local direction to the viewer and the random
    /// numbers.
    pub samples: Vec<(u32, Xyz, Xyz)>,
    /// Games of roulette: throughput, bounces, random number.
    pub roulette_calls: Vec<(Xyz, u32, f64)>,
}

/// A call of `play_roulette` for each of many numbers `u`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RouletteWork {
    /// Throughput and bounces.
    pub paths: Vec<(Xyz, u32)>,
    /// For each of them, each of these.
    pub numbers: Vec<f64>,
}
