//! Part 3: direct light.

use crate::light::{BsdfSample, LitWorld, Material};
use crate::work::{Ray, Xyz};
use serde::{Deserialize, Serialize};

/// One call of each of the Lambertian functions. Directions are in local space.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LambertProbe {
    /// Reflectance.
    pub reflectance: Xyz,
    /// To the viewer.
    pub wo: Xyz,
    /// To the light, for `lambert_f` and `lambert_pdf`.
    pub wi: Xyz,
    /// In the unit square, for `lambert_sample`.
    pub u: [f64; 2],
}

/// What they answered.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LambertAnswer {
    /// `lambert_f`.
    pub f: Xyz,
    /// `lambert_pdf`.
    pub pdf: f64,
    /// `lambert_sample`.
    pub sample: Option<BsdfSample>,
}

/// Which estimate of direct light to ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Strategy {
    /// `zero_bounce_radiance`.
    ZeroBounce,
    /// `estimate_direct_lighting_hemisphere`.
    Hemisphere,
    /// `estimate_direct_lighting_importance`.
    Lights,
}

/// Light at points of surfaces in a world whose answers are known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DirectWork {
    /// The world.
    pub world: LitWorld,
    /// Which estimate.
    pub strategy: Strategy,
    /// Where, call after call.
    pub points: Vec<ShadedPoint>,
    /// Samples a call.
    pub samples: u32,
    /// Seed of the samplers.
    pub seed: u64,
}

/// A point of a surface and who looks at it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShadedPoint {
    /// The point.
    pub p: Xyz,
    /// Its normal: shading and geometric.
    pub n: Xyz,
    /// No coordinate of the point is farther off than this.
    pub error: f64,
    /// What the surface is made of.
    pub material: Material,
    /// The unit world direction to the viewer.
    pub wo: Xyz,
}

/// What an estimate answered and asked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DirectAnswer {
    /// The radiance.
    pub radiance: Xyz,
    /// The rays that were traced, or asked about for shadow.
    pub rays: Vec<RecordedRay>,
}

/// A ray and what was answered.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordedRay {
    /// The ray.
    pub ray: Ray,
    /// Of a traced ray, the radiance that what it sees sends back along it.
    pub seen: Xyz,
    /// Whether something was in its range.
    pub hit: bool,
}
