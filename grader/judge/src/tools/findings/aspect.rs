//! The parts of an answer that are judged separately.

use serde::{Deserialize, Serialize};

/// A part of an answer that is judged separately.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aspect {
    /// How often the student's code calls `camera_ray` and `trace_ray`, each time for another
    /// sample.
    Calls,
    /// Where the samples lie in the pixel.
    Placement,
    /// How samples are distributed.
    Spread,
    /// Whether the samples of a pixel differ from those of other pixels, and from those with
    /// another seed.
    Independence,
    /// The radiance of a pixel or an estimate.
    Radiance,
    /// The origin of a camera ray.
    Origin,
    /// The direction of a camera ray.
    Direction,
    /// The length of a camera ray's direction.
    UnitLength,
    /// The range of a camera ray.
    Range,
    /// Hit or miss.
    // Reports and signatures have had this name from the start.
    #[serde(rename = "decision")]
    HitOrMiss,
    /// Whether there is a sample, or a direction.
    SampleOrNone,
    /// The index of the primitive.
    Primitive,
    /// Distance along the ray.
    T,
    /// Barycentric weights.
    Barycentrics,
    /// The surface parameters of a shape that has none: (0, 0).
    Parameters,
    /// The hit point.
    Position,
    /// The shading normal.
    Normal,
    /// The geometric normal.
    GeometricNormal,
    /// The ray after the call.
    RayAfter,
    /// The interval inside a box.
    Interval,
    /// Whether the nodes form a tree whose leaves hold every primitive once.
    Structure,
    /// Whether the box of each node contains the primitives below it.
    Bounds,
    /// Whether leaves hold at most `max_leaf_size` primitives.
    LeafSize,
    /// Whether the same input gives the same tree.
    Repeatable,
    /// The number of tests compared with that of the reference.
    Work,
    /// Whether the tree saves tests at all.
    Savings,
    /// How the time to build a tree grows with its size.
    BuildTime,
    /// The value of a BSDF.
    Bsdf,
    /// A density, or the probability of a choice.
    Pdf,
    /// The direction of a sample.
    SampledDirection,
    /// The other fields of a sample: its value, density and delta flag.
    SampleRecord,
    /// The number of traced rays.
    Rays,
    /// The mean of many estimates.
    Mean,
    /// The Fresnel reflectance of a boundary.
    Fresnel,
    /// The throughput of a path.
    Throughput,
    /// The arguments of calls to other functions, such as direct light or the stopping rule.
    Questions,
    /// Whether a path continues.
    Survival,
    /// Whether a pixel has enough samples.
    Stop,
}

impl Aspect {
    /// Whether the aspect is the one without which no other of the same answer is judged.
    pub fn is_decision(self) -> bool {
        matches!(self, Aspect::HitOrMiss | Aspect::SampleOrNone)
    }

    /// Whether others of the same answer are judged only in part, or not at all, where the aspect
    /// is wrong: what is missing cannot be judged.
    pub fn hides_others(self) -> bool {
        self.is_decision()
            || matches!(
                self,
                Aspect::Calls | Aspect::Rays | Aspect::Structure | Aspect::Survival
            )
    }

    /// Whether only an answer that is a hit, or a sample, has the aspect. A false miss lacks it, so
    /// a case about the aspect is also about hit or miss.
    pub(crate) fn needs_a_hit(self) -> bool {
        matches!(
            self,
            Aspect::Primitive
                | Aspect::T
                | Aspect::Barycentrics
                | Aspect::Parameters
                | Aspect::Position
                | Aspect::Normal
                | Aspect::GeometricNormal
                | Aspect::Interval
                | Aspect::SampledDirection
                | Aspect::SampleRecord
        )
    }

    /// Whether the aspect is one of all answers of a case together. Its faults are recorded at one
    /// call, but no call is to blame alone.
    pub fn is_of_all_calls(self) -> bool {
        matches!(
            self,
            Aspect::Mean
                | Aspect::Spread
                | Aspect::Work
                | Aspect::Savings
                | Aspect::BuildTime
                | Aspect::Structure
                | Aspect::Bounds
                | Aspect::LeafSize
                | Aspect::Repeatable
        )
    }

    /// Whether a statistical test of many random answers judges the aspect.
    pub fn is_of_chance(self) -> bool {
        matches!(self, Aspect::Mean | Aspect::Spread)
    }

    /// Whether the [label](Aspect::label) is a plural.
    pub fn is_plural(self) -> bool {
        matches!(
            self,
            Aspect::Calls
                | Aspect::Placement
                | Aspect::Range
                | Aspect::Barycentrics
                | Aspect::Bounds
                | Aspect::Savings
                | Aspect::SampleRecord
                | Aspect::Questions
        )
    }

    /// The name of the aspect in reports.
    pub fn label(self) -> &'static str {
        match self {
            Aspect::Calls => "samples taken",
            Aspect::Placement => "sample positions",
            Aspect::Spread => "sample distribution",
            Aspect::Independence => "independence of samples",
            Aspect::Radiance => "radiance",
            Aspect::Origin => "ray origin",
            Aspect::Direction => "ray direction",
            Aspect::UnitLength => "unit length",
            Aspect::Range => "min_t and max_t",
            Aspect::HitOrMiss => "hit or miss",
            Aspect::SampleOrNone => "whether there is a sample",
            Aspect::Primitive => "primitive",
            Aspect::T => "t",
            Aspect::Barycentrics => "barycentric weights",
            Aspect::Parameters => "uv",
            Aspect::Position => "hit point",
            Aspect::Normal => "normal",
            Aspect::GeometricNormal => "geometric normal",
            Aspect::RayAfter => "ray after the call",
            Aspect::Interval => "interval",
            Aspect::Structure => "tree structure",
            Aspect::Bounds => "bounding boxes",
            Aspect::LeafSize => "leaf size",
            Aspect::Repeatable => "same tree on a second build",
            Aspect::Work => "number of tests",
            Aspect::Savings => "saved tests",
            Aspect::BuildTime => "growth of the build time",
            Aspect::Bsdf => "BSDF",
            Aspect::Pdf => "pdf",
            Aspect::SampledDirection => "sampled direction",
            Aspect::SampleRecord => "fields of the sample",
            Aspect::Rays => "number of rays",
            Aspect::Mean => "mean of estimates",
            Aspect::Fresnel => "Fresnel reflectance",
            Aspect::Throughput => "throughput",
            Aspect::Questions => "arguments of calls",
            Aspect::Survival => "which paths continue",
            Aspect::Stop => "when to stop",
        }
    }
}
