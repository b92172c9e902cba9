//! Questions and answers of Part 4: mirrors, glass and path tracing.

use crate::light::{BsdfSample, Material, Surroundings};
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

/// The result of a call.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum SpecularAnswer {
    /// A Fresnel reflectance.
    Share(f64),
    /// A direction, if there is one.
    Direction(Option<Xyz>),
    /// A sample, if there is one.
    Sample(Option<BsdfSample>),
}

/// A path whose surfaces, samples and direct light are given: no intersection or scattering code
/// runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ScriptedPath {
    /// The first ray.
    pub ray: Ray,
    /// The largest number of rays.
    pub max_depth: u32,
    /// The surface that each ray hits, in order; later rays miss.
    pub steps: Vec<Step>,
    /// The radiance along a ray that misses and goes up: its direction's y is above 0.
    pub background: Xyz,
    /// The radiance along other rays that miss.
    pub below: Xyz,
    /// Seed of the sampler.
    pub seed: u64,
}

impl ScriptedPath {
    /// The radiance along a ray with the world direction `d` that misses.
    pub fn background_along(&self, d: Xyz) -> Xyz {
        if d[1] > 0.0 {
            self.background
        } else {
            self.below
        }
    }

    /// The background as an environment map; `None` if it is black.
    pub fn surroundings(&self) -> Option<Surroundings> {
        let texels = vec![self.background, self.below];
        let is_black = texels.iter().all(|texel| *texel == [0.0; 3]);
        (!is_black).then_some(Surroundings { width: 1, texels })
    }
}

/// A surface on a path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Step {
    /// The hit point.
    pub p: Xyz,
    /// Its normal.
    pub n: Xyz,
    /// Its material.
    pub material: Material,
    /// The direct light that `direct` returns there.
    pub direct: Xyz,
    /// The sample that `Scattering::sample` returns there.
    pub sample: Option<BsdfSample>,
    /// The factor by which `roulette` multiplies the throughput; `None` ends the path.
    pub roulette: Option<f64>,
}

/// The calls that a path made, and its radiance.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PathAnswer {
    /// The radiance.
    pub radiance: Xyz,
    /// Rays that were traced.
    pub rays: Vec<Ray>,
    /// The calls of `direct`: surface, and direction to the viewer.
    pub direct: Vec<(u32, Xyz)>,
    /// The calls of `sample`: surface, local direction to the viewer, random numbers.
    pub samples: Vec<(u32, Xyz, Xyz)>,
    /// The calls of roulette: throughput, bounces, random number.
    pub roulette_calls: Vec<(Xyz, u32, f64)>,
}

/// Calls of `play_roulette`: each path with each of many numbers `u`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RouletteWork {
    /// Throughput and bounces.
    pub paths: Vec<(Xyz, u32)>,
    /// The numbers `u`.
    pub numbers: Vec<f64>,
}
