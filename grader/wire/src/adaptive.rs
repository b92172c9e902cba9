//! Part 5: as many samples as a pixel needs.

use crate::work::Xyz;
use serde::{Deserialize, Serialize};

/// A question to a stopping rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StopCall {
    /// The samples so far: runs of a count and a luminance.
    pub runs: Vec<(u32, f64)>,
    /// Error that is good enough, as a share of the mean.
    pub tolerance: f64,
    /// What the plain rule answers, if the mended one asks it.
    pub rule: bool,
}

/// What a stopping rule answered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StopAnswer {
    /// Whether to stop.
    pub stop: bool,
    /// What the mended rule asked the plain one: count and mean of the samples, and the tolerance.
    pub rule_calls: Vec<(u64, f64, f64)>,
}

/// The rule that a pixel is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum StopRule {
    /// A stand-in that says yes from this count on.
    From(u64),
    /// `has_converged`.
    Plain,
}

/// A pixel whose samples are written down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AdaptivePixel {
    /// Film width and height.
    pub film: [u32; 2],
    /// Column and row.
    pub pixel: [u32; 2],
    /// The most samples.
    pub ns_aa: u32,
    /// Samples between two looks at the rule.
    pub batch: u32,
    /// Error that is good enough, as a share of the mean.
    pub tolerance: f64,
    /// Seed of the sampler.
    pub seed: u64,
    /// What `trace_ray` answers, over and over.
    pub stream: Vec<Xyz>,
    /// The rule.
    pub rule: StopRule,
}

/// What an adaptive pixel did.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AdaptiveAnswer {
    /// Points that the camera was asked for.
    pub points: Vec<[f64; 2]>,
    /// How many rays were traced.
    pub traced: u32,
    /// How many of them the camera had not made.
    pub foreign: u32,
    /// What the rule was asked: count, mean and variance of the luminances, and the tolerance.
    pub rule_calls: Vec<(u64, f64, f64, f64)>,
    /// The pixel's radiance.
    pub radiance: Xyz,
    /// The pixel's count of samples.
    pub samples: u32,
}
