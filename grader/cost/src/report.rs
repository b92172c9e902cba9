//! What `grader cost` says: the data behind the table, the JSON and the page.
//!
//! Every number is finite. Counts "a million" are scaled to a million rays. Times are the machine's and differ from
//! run to run; everything else depends on the seed alone.

use super::picture::Pictures;
use super::trees::Trees;
use serde::{Deserialize, Serialize};

/// A whole run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Where it ran.
    pub machine: Machine,
    /// What the rays were drawn from.
    pub seed: u64,
    /// Whether fewer rays and rounds were taken.
    pub quick: bool,
    /// A family of kernels a shape.
    pub families: Vec<Family>,
    /// Trees, if they were asked for.
    pub bvh: Option<Trees>,
    /// Pictures, if they were asked for.
    pub pictures: Option<Pictures>,
}

/// What the times are times of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// The processor's name.
    pub cpu: String,
    /// Threads it runs at once. Kernels are timed on one.
    pub cores: usize,
    /// The compiler's version.
    pub rustc: String,
    /// What the compiler was allowed to use of the processor, such as `sse2`.
    pub target_features: Vec<String>,
    /// Whether the processor has a fused multiply-add, used where a kernel asks for it at run time.
    pub has_fma: bool,
}

/// The shapes whose kernels are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Shape {
    /// Part 1, task 3.
    Triangle,
    /// Part 1, task 4.
    Sphere,
    /// Part 2, task 2.
    Box,
}

impl Shape {
    /// In the order of the course.
    pub const ALL: [Shape; 3] = [Shape::Triangle, Shape::Sphere, Shape::Box];

    /// In lower case, as on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Shape::Triangle => "triangle",
            Shape::Sphere => "sphere",
            Shape::Box => "box",
        }
    }
}

/// All kernels for one shape.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Family {
    /// The shape.
    pub shape: Shape,
    /// What the rays of each column are, in the order of [`Row::by_ray_family`].
    pub columns: Vec<Column>,
    /// The kernels: the textbook's in `f64` first, the student's last.
    pub rows: Vec<Row>,
    /// Why there is no row of the student's, if there is none.
    pub student_missing: Option<String>,
}

/// A family of rays, in words.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// Which.
    pub family: RayFamily,
    /// What is hard about it for this shape.
    pub about: String,
}

/// How rays lie to the shapes that they are tested against: what can be hard about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum RayFamily {
    /// Nothing: hits and misses in equal parts. Times are measured on these.
    #[serde(rename = "ordinary")]
    Ordinary,
    /// Aimed at an edge; of a sphere, at the rim.
    #[serde(rename = "edge")]
    Edge,
    /// Aimed at a vertex; of a box, at a corner.
    #[serde(rename = "vertex")]
    Vertex,
    /// A triangle whose vertices are nearly on one line; a box that is flat.
    #[serde(rename = "sliver")]
    Sliver,
    /// A triangle with one very short edge; a box like a rod.
    #[serde(rename = "needle")]
    Needle,
    /// Nearly in the plane of the triangle or a face of the box; nearly beside the sphere.
    #[serde(rename = "grazing")]
    Grazing,
    /// All far from the world's origin; a sphere far from the ray's.
    #[serde(rename = "far offset")]
    FarOffset,
    /// Everything is very small.
    #[serde(rename = "tiny scale")]
    TinyScale,
    /// Everything is very large.
    #[serde(rename = "huge scale")]
    HugeScale,
    /// The ray starts inside the shape.
    #[serde(rename = "inside")]
    Inside,
    /// The ray starts on the shape, as a shadow ray does.
    #[serde(rename = "on the surface")]
    OnTheSurface,
}

impl RayFamily {
    /// All, in the order of the columns.
    pub const ALL: [RayFamily; 11] = [
        RayFamily::Ordinary,
        RayFamily::Edge,
        RayFamily::Vertex,
        RayFamily::Sliver,
        RayFamily::Needle,
        RayFamily::Grazing,
        RayFamily::FarOffset,
        RayFamily::TinyScale,
        RayFamily::HugeScale,
        RayFamily::Inside,
        RayFamily::OnTheSurface,
    ];

    /// In words, as in the JSON.
    pub fn name(self) -> &'static str {
        match self {
            RayFamily::Ordinary => "ordinary",
            RayFamily::Edge => "edge",
            RayFamily::Vertex => "vertex",
            RayFamily::Sliver => "sliver",
            RayFamily::Needle => "needle",
            RayFamily::Grazing => "grazing",
            RayFamily::FarOffset => "far offset",
            RayFamily::TinyScale => "tiny scale",
            RayFamily::HugeScale => "huge scale",
            RayFamily::Inside => "inside",
            RayFamily::OnTheSurface => "on the surface",
        }
    }
}

/// In what numbers a kernel works.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Precision {
    /// Single: 24 bits. The oracle judges the rounded inputs, so that only the kernel's own roundings count.
    #[serde(rename = "f32")]
    F32,
    /// Double: 53 bits.
    #[serde(rename = "f64")]
    F64,
    /// Shapes and rays are stored in single, and computed with in double. Judged like `f32`.
    #[serde(rename = "f32 in f64")]
    F32InF64,
}

impl Precision {
    /// As in the JSON.
    pub fn name(self) -> &'static str {
        match self {
            Precision::F32 => "f32",
            Precision::F64 => "f64",
            Precision::F32InF64 => "f32 in f64",
        }
    }
}

/// One kernel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Its name; rows of one name differ in precision.
    pub name: String,
    /// In what numbers it works.
    pub precision: Precision,
    /// Where it is from.
    pub paper: String,
    /// Whether it is the student's own.
    pub student: bool,
    /// Whether it is the one that times are compared to.
    pub textbook: bool,
    /// Of decision, `t` and hit point of one ordinary ray.
    pub time: Timing,
    /// What it computes for one ordinary ray, on average; not known of a student's.
    pub operations: Option<Operations>,
    /// Rays from inside closed meshes, aimed at edges and vertices, that get out without a hit. Triangles only.
    pub leaks_per_million: Option<f64>,
    /// How right it is, a family of rays each.
    pub by_ray_family: Vec<Accuracy>,
}

/// Nanoseconds, and how they compare. All kernels take turns, round by round; a spread is the distance between the
/// quartiles of the rounds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Median of the rounds.
    pub ns_median: f64,
    /// Spread of the rounds.
    pub ns_spread: f64,
    /// Median of the rounds' ratios to the textbook's kernel of the same round; 1 where there is none to compare to.
    pub ratio_to_textbook: f64,
    /// Spread of these ratios.
    pub ratio_spread: f64,
    /// Whether the ratio is no farther from 1 than the rounds scatter: no difference can be told.
    pub inside_noise: bool,
}

/// Operations of one test on average. Differences count as sums, `abs` and changes of sign as nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Operations {
    /// Sums and differences.
    pub add: f64,
    /// Products.
    pub mul: f64,
    /// Quotients.
    pub div: f64,
    /// Square roots.
    pub sqrt: f64,
    /// Fused multiply-adds.
    pub fma: f64,
    /// Comparisons, minima and maxima among them.
    pub compare: f64,
}

impl Operations {
    /// All together.
    pub fn total(&self) -> f64 {
        self.add + self.mul + self.div + self.sqrt + self.fma + self.compare
    }
}

/// How right a kernel is on one family of rays. A decision is wrong if the exact oracle says so and a robust kernel
/// in `f64` would be sure; what even that may round to either side is counted apart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accuracy {
    /// Which rays.
    pub family: RayFamily,
    /// How many.
    pub rays: usize,
    /// A hit was answered where there is none.
    pub false_hits_per_million: f64,
    /// A hit was missed.
    pub false_misses_per_million: f64,
    /// Rays that are undecidable in `f64`: neither answer is wrong.
    pub undecidable_per_million: f64,
    /// Of these, answers that differ from the exact one.
    pub lost_in_doubt_per_million: f64,
    /// Hits whose `t` is farther off than [`Accuracy::forward_bound`] allows.
    pub beyond_bound_per_million: f64,
    /// How far off `t` is, over rays that truly hit and are answered as hits; of a box, over both ends of the
    /// interval. `None` without such rays.
    pub t: Option<Errors>,
    /// How far the hit point is from the true one, by its worst coordinate; relative to the largest coordinate of the
    /// shape. `None` for boxes.
    pub position: Option<Errors>,
    /// How far the hit point is off the surface, relative to the largest coordinate of the shape: what makes shadow
    /// rays hit the surface that they start on. `None` for boxes.
    pub off_surface: Option<Errors>,
    /// The distribution of the relative error of `t`: (error, share of hits with at most this), by rising share. The
    /// first errors may be 0.
    pub cdf: Vec<(f64, f64)>,
    /// The same of what a robust kernel of this precision may be off, ray by ray: its forward error bound.
    pub forward_bound: Vec<(f64, f64)>,
}

impl Accuracy {
    /// Decisions that are wrong, either way.
    pub fn wrong_per_million(&self) -> f64 {
        self.false_hits_per_million + self.false_misses_per_million
    }
}

/// An error in two units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// In units in the last place of the kernel's own answers (`f32` or `f64`), at the true value.
    pub ulp: Quantiles,
    /// As a share of the true value, 1 at most: then no digit is right.
    pub relative: Quantiles,
}

impl Errors {
    /// Leading bits that are right on half of the rays at least: `-log2` of the median relative error, and at most
    /// the 53 that there are.
    pub fn correct_bits(&self) -> f64 {
        (-self.relative.p50.log2()).clamp(0.0, 53.0) + 0.0
    }
}

/// A distribution in three numbers (nearest rank).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Quantiles {
    /// Half are at most this.
    pub p50: f64,
    /// 999 of 1000 are at most this.
    pub p999: f64,
    /// All are at most this.
    pub max: f64,
}
