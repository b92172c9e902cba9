//! Questions and answers of Part 3: direct light.

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

/// The results of the Lambertian functions for one probe.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LambertAnswer {
    /// `lambert_f`.
    pub f: Xyz,
    /// `lambert_pdf`.
    pub pdf: f64,
    /// `lambert_sample`.
    pub sample: Option<BsdfSample>,
}

/// Which function estimates direct light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Strategy {
    /// `zero_bounce_radiance`.
    ZeroBounce,
    /// `estimate_direct_lighting_hemisphere`.
    Hemisphere,
    /// `estimate_direct_lighting_importance`.
    Lights,
}

/// Points of surfaces at which direct light is estimated, in a scripted world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DirectWork {
    /// The world.
    pub world: LitWorld,
    /// Which function to call.
    pub strategy: Strategy,
    /// The point of each call.
    pub points: Vec<ShadedPoint>,
    /// Samples per call.
    pub samples: u32,
    /// Seed of the samplers.
    pub seed: u64,
}

/// A point of a surface and the direction to the viewer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ShadedPoint {
    /// The point.
    pub p: Xyz,
    /// Its shading normal.
    pub n: Xyz,
    /// Its geometric normal; on a flat surface the same.
    pub ng: Xyz,
    /// Upper bound of the error of each coordinate of the point.
    pub error: f64,
    /// The material of the surface.
    pub material: Material,
    /// The unit world direction to the viewer.
    pub wo: Xyz,
}

/// The result of an estimate and the rays that it traced.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DirectAnswer {
    /// The radiance.
    pub radiance: Xyz,
    /// The traced rays or shadow rays.
    pub rays: Vec<RecordedRay>,
}

/// A traced ray and its result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordedRay {
    /// The ray.
    pub ray: Ray,
    /// The radiance that arrives along a traced ray; black for a shadow ray.
    pub seen: Xyz,
    /// Whether the ray hit something in its range.
    pub hit: bool,
}
