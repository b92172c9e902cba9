//! Questions and answers of Part 5: adaptive sampling.

use crate::work::Xyz;
use serde::{Deserialize, Serialize};

/// A call of a stopping rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StopCall {
    /// The samples so far, as runs of equal luminances: count and luminance.
    pub runs: Vec<(u32, f64)>,
    /// Error that is good enough, as a share of the mean.
    pub tolerance: f64,
    /// The result of the plain rule, if the waiting rule calls it.
    pub rule: bool,
}

/// The result of a stopping rule.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StopAnswer {
    /// Whether to stop.
    pub stop: bool,
    /// The calls of the plain rule by the waiting rule: count and mean of the samples, and the
    /// tolerance.
    pub rule_calls: Vec<(u64, f64, f64)>,
}

/// The stopping rule of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum StopRule {
    /// A scripted rule that returns true from this number of samples on.
    From(u64),
    /// `has_converged`.
    Plain,
}

/// A pixel whose samples are given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AdaptivePixel {
    /// Film width and height.
    pub film: [u32; 2],
    /// Column and row.
    pub pixel: [u32; 2],
    /// The largest number of samples.
    pub ns_aa: u32,
    /// Samples between two calls of the rule.
    pub batch: u32,
    /// Error that is good enough, as a share of the mean.
    pub tolerance: f64,
    /// Seed of the sampler.
    pub seed: u64,
    /// The radiances that `trace_ray` returns, repeated in a cycle.
    pub stream: Vec<Xyz>,
    /// The rule.
    pub rule: StopRule,
}

/// The calls and the result of an adaptive pixel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AdaptiveAnswer {
    /// The points with which `camera_ray` was called.
    pub points: Vec<[f64; 2]>,
    /// The number of traced rays.
    pub traced: u32,
    /// The number of traced rays that `camera_ray` did not return.
    pub foreign: u32,
    /// The calls of the rule: count, mean and variance of the luminances, and the tolerance.
    pub rule_calls: Vec<(u64, f64, f64, f64)>,
    /// The pixel's radiance.
    pub radiance: Xyz,
    /// The pixel's count of samples.
    pub samples: u32,
}
